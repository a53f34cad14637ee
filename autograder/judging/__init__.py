"""From the numbers that came back to a verdict: what is right, and which mistake is not."""
