"""Says in a sentence why an nbgrader command stops, where the reason is known, and not in a traceback.

nbgrader's commands and the formgrader's buttons write a traceback for every error, such as a student's
damaged file or a locked gradebook. For an error that nobody foresaw, it stays.
"""

import logging
import re
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from autograder.meant import meant
from autograder.protocol import one_line
from autograder.terminal import plain, say

TRACEBACK = "Traceback (most recent call last)"
# What nbgrader says of every error of the database, also of one that no upgrade mends.
UPGRADE = "There was an error accessing the nbgrader database"
SEE_ABOVE = "Please see the the above traceback"
NOT_FOUND = re.compile(r"(?:No notebooks were matched by '|Assignment not found at: )(.+?)'?$")
NEAR = "Did you mean: %s"


def why(error: BaseException) -> str:
    """The reason, for somebody who does not know the code; "" if it is not known."""
    from autograder.nbgrader_glue.locked import why_unusable
    from autograder.nbgrader_glue.submitted import RefusedError
    from autograder.notebook.reading import UnreadableError
    from autograder.roster import RosterError
    from autograder.term_calendar import CalendarError

    if not isinstance(error, Exception):
        return ""
    if said := why_unusable(error):
        return said
    if isinstance(error, OSError) and error.strerror:
        where = f"{one_line(str(error.filename), 300)}: " if error.filename else ""
        return f"{where}{error.strerror}"
    ours = (CalendarError, OSError, RefusedError, RosterError, UnreadableError)
    return plain(str(error)) if isinstance(error, ours + logged()) else ""


def logged() -> tuple[type[Exception], ...]:
    """What nbgrader raises once it has logged the reason."""
    from nbgrader.converters.base import NbGraderException
    from nbgrader.exchange import ExchangeError

    return NbGraderException, ExchangeError


class InWords(logging.Filter):
    """Puts the reason in the place of a traceback, and names no assignment that nobody can mean."""

    def __init__(self):
        super().__init__()
        self._asked = ""

    def filter(self, record: logging.LogRecord) -> bool:
        if record.levelno < logging.ERROR:
            return True
        if record.msg == NEAR:
            return self._name_near(record)
        said, error = record.getMessage(), sys.exc_info()[1]
        if found := NOT_FOUND.match(said):
            self._asked = Path(found[1]).name
        elif said.startswith(SEE_ABOVE):
            _say(record, "The lines above say why")
        elif not isinstance(error, Exception) or not (reason := why(error)):
            return True
        elif said.startswith(UPGRADE):
            from autograder.nbgrader_glue.locked import is_locked

            return not is_locked(error)
        elif said.startswith(TRACEBACK):
            _say(record, reason)
        return True

    def _name_near(self, record: logging.LogRecord) -> bool:
        """nbgrader names the path that is most alike as a whole: for "p3" a short one, "crane"."""
        here = Path(str(record.args[0])).parent if isinstance(record.args, tuple) else Path()
        names = sorted(path.name for path in here.iterdir()) if here.is_dir() else []
        near = meant(self._asked, names)
        _say(record, f"Did you mean {' or '.join(near)}?")
        return bool(near)


def _say(record: logging.LogRecord, text: str) -> None:
    record.msg, record.args = text, ()


@contextmanager
def stopping(converter) -> Iterator[None]:
    """For what a converter does before it changes anything: NbGraderException, its reason logged."""
    from nbgrader.converters.base import NbGraderException

    try:
        yield
    except logged():
        raise
    except Exception as error:
        if not (reason := why(error)):
            raise
        converter.log.error(reason)
        raise NbGraderException(reason) from None


def end_in_words() -> None:
    """Have nbgrader's command, if this process is one, end with the reason; others stay as they are."""
    program = Path(sys.argv[0])
    if "nbgrader" not in (program.stem, program.parent.name):
        return
    keep_sqlalchemy_quiet()
    shown = sys.excepthook

    def show(kind, error, trace) -> None:
        if reason := why(error):
            say(f"nbgrader: {reason}", sys.stderr)
        else:
            shown(kind, error, trace)

    sys.excepthook = show


def keep_sqlalchemy_quiet() -> None:
    """Let SQLAlchemy not warn of how nbgrader makes a submission's rows, which it does rightly."""
    warnings.filterwarnings("ignore", message="Object of type <Submitted")
