"""Closes a year of the course: `autograder archive`."""
