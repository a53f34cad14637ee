"""Checks, verdicts and grading of the course's problems."""
