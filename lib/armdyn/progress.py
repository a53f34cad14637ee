"""A progress bar for runs past a second, where someone is there to see it."""

import contextlib
import sys

from tqdm import tqdm

DELAY = 1.0  # s


class _Bar(tqdm):
    monitor_interval = 0  # no watching thread: it would outlive the run


def progress_bar(total: float, wanted: bool):
    """A context whose value counts simulated time, in s, by `.update(dt)`; None without a bar.

    A bar appears on stderr after a second, only where stderr is a terminal or a notebook, and goes
    when the run ends. The environment's TQDM_DISABLE=1 switches it off too.
    """
    if not wanted or not _seen(sys.stderr):
        return contextlib.nullcontext()
    return _Bar(
        total=total,
        delay=DELAY,
        leave=False,
        bar_format="simulated {n:.3g} of {total:.3g} s |{bar:30}| {elapsed} < {remaining}",
    )


def _seen(stream) -> bool:
    """Whether the stream is a terminal, or a Jupyter kernel's, which says it is none."""
    if type(stream).__module__.partition(".")[0] == "ipykernel":
        return True
    return stream is not None and not stream.closed and stream.isatty()
