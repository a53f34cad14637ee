"""Many notebooks: side by side, resumed, recorded."""
