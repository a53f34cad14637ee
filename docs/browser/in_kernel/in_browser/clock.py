"""The processor's clock, which stands still in a browser."""

import time


def mend() -> None:
    """Let processor time be time that passes: the kernel's thread does nothing else meanwhile."""
    time.process_time = time.perf_counter
    time.process_time_ns = time.perf_counter_ns
