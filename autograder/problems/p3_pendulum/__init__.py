"""p3: the pendulum."""
