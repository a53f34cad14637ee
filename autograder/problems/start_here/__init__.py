"""The first lesson's own check."""
