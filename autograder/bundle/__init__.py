"""Makes what a class is given: lessons, released problems, and a package that holds no answers."""


class BundleError(ValueError):
    """No archive can be made; the message says why."""
