"""Grades one submitted notebook: puts damaged cells right, runs it, judges it, writes its outputs."""
