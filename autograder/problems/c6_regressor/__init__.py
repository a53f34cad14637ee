"""c6: the regressor and identification."""
