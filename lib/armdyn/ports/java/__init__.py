"""Java with EJML."""
