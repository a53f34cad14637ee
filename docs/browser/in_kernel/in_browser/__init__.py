"""What a browser's Python needs before a notebook runs in it: the kernel calls `start` first."""


def start() -> None:
    """Mend what is different in a browser."""
    from in_browser import clock, linear_algebra, packages, streams

    clock.mend()
    streams.mend()
    linear_algebra.mend()
    packages.mend()
