"""c8: a controller."""
