"""Checks of mechanisms that stand in a file beside the problem's notebook: `gantry-M` of gantry.py."""

from collections.abc import Mapping
from pathlib import Path

from autograder.judging.check import Check


def check_of_file(id: str, files: Mapping[str, str]) -> Check | None:
    """The check of this id, if one of these files has its mechanism; None if none has.

    files: name → text of the mechanisms' files. MechanismFileError if the file is broken.
    """
    name, _, answer = id.rpartition("-")
    text = files.get(f"{name}.py")
    if not name or text is None:
        return None
    from autograder.mechanisms.file import mechanism_of  # derives with SymPy, which takes a second
    from autograder.mutation.answers import ANSWERS
    from autograder.mutation.checks import check_of

    return check_of(mechanism_of(text, f"{name}.py", name), answer) if answer in ANSWERS else None


def files_here(id: str) -> dict[str, str]:
    """The file of the mechanism of a check, where it lies in the folder of a student's notebook."""
    path = Path(f"{id.rpartition('-')[0]}.py")
    if not path.is_file():
        return {}
    text = path.read_text(encoding="utf-8", errors="replace")
    return {path.name: text} if "MECHANISM" in text else {}
