"""Judges the numbers that come back from a student's function, and names the mistake in them."""
