"""Chooses the notebook in a submission's folder that is graded, and the files beside it."""

import os
import warnings
from dataclasses import replace
from itertools import accumulate
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader import utils

from autograder.nbgrader_glue import times
from autograder.notebook.beside import DEFINES, Beside, choose
from autograder.notebook.recognise import Likeness, likeness
from autograder.problems import own_checks
from autograder.protocol import one_line

# Limits on notebooks that are only looked at; the smallest come first.
MOST_LOOKED_AT = 20
MOST_BYTES = 32 << 20
MOST_NAMES = 5
# What nbgrader's exchange puts beside each submission, and what we put beside that.
OF_THE_EXCHANGE = (times.FILE, times.ORIGINAL, "submission_secret.txt")
UNREADABLE = Likeness(known=False, answered=True)


def counted(folder: Path, name: str, source: NotebookNode) -> tuple[Path, list[str]]:
    """The notebook that is graded, and notes on the others.

    That is the notebook with the assignment's name, whatever else is there; without one, the notebook
    that is recognised by its cells. FileNotFoundError, which says what is there, if there is none, or
    if several have answers.
    """
    wanted = folder / f"{name}.ipynb"
    notebooks = sorted(path for path in folder.glob("*.ipynb") if path.is_file())
    others = [path for path in notebooks if not (wanted.exists() and path.samefile(wanted))]
    if wanted.exists() and not others:
        return wanted, []
    alike = {path: _likeness(path, source) for path in _few(others)}
    alike = {path: like for path, like in alike.items() if like.known}
    if wanted.exists():
        mine = _likeness(wanted, source)
        return wanted, [_ignored(path, like, wanted, mine) for path, like in alike.items()]
    answered = [path for path, like in alike.items() if like.answered] or list(alike)
    if len(answered) != 1:
        raise FileNotFoundError(_what_is_there(folder, wanted, answered))
    (taken,) = answered
    rest = [
        _ignored(path, like, taken, alike[taken]) for path, like in alike.items() if path != taken
    ]
    return taken, [f"there is no {wanted.name}; {_shown(taken)} was graded instead", *rest]


def beside(folder: Path, source: Path, ignore: list[str], kept: list[str]) -> Beside:
    """A submission's files without notebooks. The source's replace the student's, except for `kept`.

    A mechanism of the source is for the checks alone.
    """
    found = _files(folder, ignore)
    theirs = {name: path for name, path in found.items() if path.suffix != ".ipynb"}
    ours = _files(source, [*ignore, "*.ipynb"])
    own = theirs.keys() - ours
    mechanisms = _mechanisms(ours)
    for name in mechanisms:
        theirs.pop(name, None)
        ours.pop(name)
    for name in kept:
        ours.pop(Path(name).as_posix(), None)
    chosen = choose(theirs | ours, own)
    notebooks = dict.fromkeys(found.keys() - theirs.keys(), "it is a notebook")
    judging = dict.fromkeys(mechanisms, "the checks alone use a mechanism's file")
    left_out = {**chosen.left_out, **notebooks, **judging}
    return replace(chosen, left_out=left_out, mechanisms=mechanisms | own_checks.files_of(source))


def mechanisms_beside(folder: Path) -> dict[str, str]:
    """The course's own files of which a problem's checks are made: the mechanisms beside its source, by
    the names of their files, and checks/NAME.py.
    """
    beside = _mechanisms({path.name: path for path in folder.glob("*.py")})
    return beside | own_checks.files_of(folder)


def _mechanisms(files: dict[str, Path]) -> dict[str, str]:
    """The texts of those Python files that define a mechanism, by their names."""
    texts = {
        name: path.read_text(encoding="utf-8", errors="replace")
        for name, path in files.items()
        if path.suffix == ".py" and "/" not in name
    }
    return {name: text for name, text in texts.items() if DEFINES.search(text)}


def _files(folder: Path, ignore: list[str]) -> dict[str, Path]:
    found = {}
    for name in utils.find_all_files(str(folder), ignore):
        path = Path(name)
        parts = path.relative_to(folder).parts
        hidden = any(part.startswith(".") for part in parts)
        if (
            not hidden
            and "/".join(parts) not in OF_THE_EXCHANGE
            and _is_text(parts)
            and path.is_file()
        ):
            found["/".join(parts)] = path
    return found


def _is_text(parts) -> bool:
    try:
        "".join(parts).encode()
    except UnicodeEncodeError:
        return False
    return True


def _few(notebooks: list[Path]) -> list[Path]:
    """Those within the limits, in order of their names."""
    sizes = {path: path.stat().st_size for path in notebooks}
    smallest = sorted(notebooks, key=lambda path: sizes[path])[:MOST_LOOKED_AT]
    totals = accumulate(sizes[path] for path in smallest)
    return sorted(path for path, total in zip(smallest, totals, strict=True) if total <= MOST_BYTES)


def _likeness(path: Path, source: NotebookNode) -> Likeness:
    if path.stat().st_size > MOST_BYTES:
        return UNREADABLE
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return likeness(nbformat.read(path, as_version=4), source)
    except Exception:  # not a notebook of this assignment, whatever it is
        return UNREADABLE


def _ignored(path: Path, like: Likeness, graded: Path, mine: Likeness) -> str:
    if like.answered and not mine.answered:
        return f"{_shown(graded)} was graded but has no answers; {_shown(path)} beside it has some"
    there = "with answers" if like.answered else "without answers"
    return f"{_shown(path)}, {there}, lies beside {_shown(graded)} and was not graded"


def _what_is_there(folder: Path, wanted: Path, answered: list[Path]) -> str:
    missing = f"there is no {wanted.name}"
    if answered:
        shown = " and ".join(map(_shown, answered))
        return f"{missing}, but there are {shown}: ask the student which one counts, and rename it"
    names = sorted(
        os.path.relpath(os.path.join(at, file), folder)
        for at, _, files in os.walk(folder)
        for file in files
        if file not in OF_THE_EXCHANGE and ".ipynb_checkpoints" not in at
    )
    if not names:
        return missing
    shown = ", ".join(one_line(name, 60) for name in names[:MOST_NAMES])
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    return f"{missing}, only {shown}{more}"


def _shown(path: Path) -> str:
    return one_line(path.name, 100)
