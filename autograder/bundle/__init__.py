"""Makes what a class is given: lessons, released problems, and a package that holds no answers."""
