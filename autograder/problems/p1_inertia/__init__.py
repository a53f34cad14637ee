"""p1: the inertia matrix of the planar 2R arm."""
