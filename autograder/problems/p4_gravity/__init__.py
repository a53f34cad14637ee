"""p4: gravity."""
