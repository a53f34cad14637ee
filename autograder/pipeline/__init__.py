"""Grades many notebooks side by side, records them, and goes on after a stop."""
