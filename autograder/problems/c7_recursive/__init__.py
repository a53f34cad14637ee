"""c7: recursive Newton–Euler, and what it gives out of any library."""
