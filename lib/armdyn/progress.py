"""Shows a progress bar for runs longer than a second, if somebody is there to see it."""

import builtins
import contextlib
import sys
import uuid

from tqdm import tqdm

DELAY = 1.0  # s


class _Bar(tqdm):
    monitor_interval = 0  # no watching thread: it would outlive the run


class _Line:
    """A file that is one line of a notebook's cell, written again and again, and empty in the end.

    JupyterLab shows what comes on stderr on red, and would keep the red line when the bar is gone.
    """

    encoding = "utf-8"  # or the bar is made of #

    def __init__(self):
        self._line = ""
        self._place = {"display_id": uuid.uuid4().hex}
        self._begun = False

    def write(self, text: str) -> None:
        line = text.strip()  # of the return, and of blanks over what was there
        if not text or line == self._line:
            return
        # IPython itself puts this name there, so that it need not be imported.
        vars(builtins)["get_ipython"]().display_pub.publish(
            {"text/plain": line}, transient=self._place, update=self._begun
        )
        self._line, self._begun = line, True

    def flush(self) -> None:
        """Nothing waits."""


def progress_bar(total: float, wanted: bool):
    """A context whose value counts simulated time, s, by `.update(dt)`; without a bar it is None.

    The bar appears after a second, and disappears when the run ends. It appears only if stderr is a
    terminal, or in a notebook in which somebody works. TQDM_DISABLE=1 in the environment switches it
    off.
    """
    in_notebook = wanted and _is_notebook(sys.stderr)
    if not wanted or not (in_notebook or _is_terminal(sys.stderr)):
        return contextlib.nullcontext()
    return _Bar(
        total=total,
        file=_Line() if in_notebook else None,
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
        request = vars(builtins)["get_ipython"]().kernel.get_parent("shell")
        return bool(request["content"]["allow_stdin"])
    except (AttributeError, KeyError, TypeError):
        return False
