"""Writes the problem of a mechanism: its notebook in nbgrader's source form, and its picture."""
