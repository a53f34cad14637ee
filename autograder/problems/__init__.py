"""The checks of each problem, one file a problem."""
