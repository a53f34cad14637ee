"""p2: Coriolis terms, energy and skew-symmetry."""
