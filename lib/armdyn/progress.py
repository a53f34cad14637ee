"""Shows a progress bar for runs longer than a second, if somebody is there to see it."""

import builtins
import contextlib
import sys

from tqdm import tqdm

DELAY = 1.0  # s


class _Bar(tqdm):
    monitor_interval = 0  # no watching thread: it would outlive the run


def progress_bar(total: float, wanted: bool):
    """A context whose value counts simulated time, s, by `.update(dt)`; without a bar it is None.

    The bar appears on stderr after a second, and disappears when the run ends. It appears only if
    stderr is a terminal, or a notebook in which somebody works. TQDM_DISABLE=1 in the environment
    switches it off.
    """
    if not wanted or not (_is_terminal(sys.stderr) or _is_notebook(sys.stderr)):
        return contextlib.nullcontext()
    return _Bar(
        total=total,
        delay=DELAY,
        leave=False,
        bar_format="simulated {n:.3g} of {total:.3g} s |{bar:30}| {elapsed} < {remaining}",
    )


def _is_terminal(stream) -> bool:
    return stream is not None and not stream.closed and stream.isatty()


def _is_notebook(stream) -> bool:
    """Whether the stream is a Jupyter kernel's, whose front end can answer questions.

    Programs that run notebooks (nbconvert, nbval, graders) say that they cannot. They would store or
    compare what a bar writes, and some take any line on stderr for an error.
    """
    if type(stream).__module__.partition(".")[0] != "ipykernel":
        return False
    try:
        # IPython itself puts this name there, so that it need not be imported.
        request = vars(builtins)["get_ipython"]().kernel.get_parent("shell")
        return bool(request["content"]["allow_stdin"])
    except (AttributeError, KeyError, TypeError):
        return False
