"""Runs student code, shut off from everything else on the machine."""
