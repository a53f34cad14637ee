"""One hand-in of one student: its files, its notebook, its time; and which of several counts."""

import json
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from datetime import datetime

from autograder.lms.file_names import copy_of
from autograder.protocol import one_line
from autograder.roster import Person

MOST_FILES = 500
MOST_BYTES = 200 << 20
# nbgrader's own files beside a submission: a student's would pretend to be them.
RESERVED = {"timestamp.txt", "timestamp-original.txt", "submission_secret.txt"}
UNFIT = re.compile(r"[\x00-\x1f\x7f]|^\.\.?$|^.{201}")


@dataclass(frozen=True)
class HandIn:
    """What one student handed in at one time.

    files: by their paths, with "/". when: with its zone; None if it is not known. late: the platform
    says so. guessed: `when` says no more than that. source: where it comes from, in words. notes: what
    is to be said of it.
    """

    person: Person
    source: str
    files: dict[str, bytes]
    when: datetime | None = None
    late: bool = False
    guessed: bool = False
    notes: tuple[str, ...] = field(default=(), compare=False)

    def in_time(self, due: datetime | None) -> bool:
        if self.late:
            return False
        return due is None or self.when is None or self.when <= due

    def noted(self, *notes: str) -> "HandIn":
        return replace(self, notes=(*self.notes, *notes))


def counts_rather(new: HandIn, old: HandIn, due: datetime | None, latest: bool = False) -> bool:
    """Whether a hand-in counts instead of one that was seen before it: the last in time does.

    latest: the last one does though it is late. Where a time is not known, what is seen later is later.
    """
    if not latest and new.in_time(due) != old.in_time(due):
        return new.in_time(due)
    return new.when is None or old.when is None or new.when >= old.when


def arranged(files: dict[str, bytes], assignment: str) -> tuple[dict[str, bytes], list[str]]:
    """The files as the grader looks for them, the notebook by its name, and notes on what was done."""
    files, notes = _without_reserved(_lifted(files))
    wanted = f"{assignment}.ipynb"
    copies = {
        name: number
        for name in files
        if "/" not in name and (number := copy_of(name, assignment)) is not None
    }
    if wanted in copies:
        others = sorted(copies.keys() - {wanted})
        notes += [f"{_shown(name)} lies beside {wanted}, which counts" for name in others]
    elif copies:
        last = [name for name, number in copies.items() if number == max(copies.values())]
        if len(last) == 1:
            files[wanted] = files.pop(last[0])
            notes.append(f"its notebook is called {_shown(last[0])}")
            others = sorted(copies.keys() - set(last))
            notes += [f"{_shown(name)}, an earlier copy, lies beside it" for name in others]
        else:
            shown = " and ".join(map(_shown, sorted(last)))
            notes.append(f"{shown} may each be the notebook: the grader looks into them")
    elif others := sorted(name for name in files if name.endswith(".ipynb")):
        notes.append(f"there is no {wanted}; the grader looks into {_shown(others[0])}")
    return files, notes


def of_another(files: Iterable[str], assignment: str, others: Iterable[str]) -> str:
    """Of which other assignment the notebooks are by their names, if none is this one's; else ""."""
    names = [name.rsplit("/", 1)[-1] for name in files if name.endswith(".ipynb")]
    if any(copy_of(name, assignment) is not None for name in names):
        return ""
    theirs = (other for other in others for name in names if copy_of(name, other) is not None)
    return next(theirs, "")


def fault(files: dict[str, bytes], assignment: str) -> str:
    """Why the grader will find no notebook in these files; empty if it may find one."""
    wanted = f"{assignment}.ipynb"
    if wanted in files:
        return f"{wanted} is no notebook" if _is_other(files[wanted]) else ""
    if not any("/" not in name and name.endswith(".ipynb") for name in files):
        shown = ", ".join(map(_shown, sorted(files)[:3])) or "no file"
        return f"there is no notebook, only {shown}{' …' if len(files) > 3 else ''}"
    return ""


def unfit(name: str, sizes: Counter) -> str:
    """Why a file is not taken, by its path and by what its student has sent so far; empty if it is.

    sizes: "files" and "bytes" of the hand-in, this file among them.
    """
    if any(UNFIT.search(part) for part in name.split("/")):
        return "its name cannot be that of a file"
    if sizes["files"] > MOST_FILES:
        return f"the hand-in has more than {MOST_FILES} files"
    if sizes["bytes"] > MOST_BYTES:
        return f"the hand-in has more than {MOST_BYTES >> 20} MB"
    return ""


def _lifted(files: dict[str, bytes]) -> dict[str, bytes]:
    """Without the folder that all files lie in."""
    tops = {name.split("/")[0] for name in files}
    if len(tops) == 1 and all("/" in name for name in files):
        return _lifted({name.split("/", 1)[1]: data for name, data in files.items()})
    return dict(files)


def _without_reserved(files: dict[str, bytes]) -> tuple[dict[str, bytes], list[str]]:
    left_out = [name for name in files if name.casefold() in RESERVED]
    kept = {name: data for name, data in files.items() if name not in left_out}
    return kept, [f"the student's own {name} was left out" for name in sorted(left_out)]


def _is_other(data: bytes) -> bool:
    try:
        held = json.loads(data.decode("utf-8-sig"))
    except (ValueError, RecursionError):
        return True
    return not (isinstance(held, dict) and ("cells" in held or "worksheets" in held))


def _shown(name: str) -> str:
    return one_line(name, 100)
