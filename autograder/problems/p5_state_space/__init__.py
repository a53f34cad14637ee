"""p5: state space and simulation."""
