"""The checks of every problem, by the grade_id of the cell they judge."""

import difflib
import re
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from types import MappingProxyType

from autograder.judging.check import Check
from autograder.problems import families, own_checks
from autograder.problems.material.conventions import Convention
from autograder.problems.own_mechanisms import check_of_file, check_of_kit, files_here

HERE = Path(__file__).parent
# Each folder with checks is a problem: the first steps, then the problems, then the challenges.
FOLDERS = sorted(
    (path.parent.name for path in HERE.glob("*/checks.py")),
    key=lambda name: ("spc".find(name[0]), name),
)
MODULES = tuple(import_module(f"{__name__}.{name}.checks") for name in FOLDERS)
CHECKS: dict[str, Check] = {check.id: check for module in MODULES for check in module.CHECKS}
# The answers that a person reads, by the grade_id of their cell.
READ: tuple[str, ...] = tuple(module.READ for module in MODULES if hasattr(module, "READ"))


# Those that can give each student an arm of the student's own.
PROBLEMS_WITH_FAMILIES = families.PROBLEMS


def check_for(
    id: str, own: Convention | None = None, files: Mapping[str, str] = MappingProxyType({})
) -> Check | None:
    """The check of this id: of a problem, of the course's own, or of a mechanism such as `cart-pole-M`;
    None for none of these.

    own: the student's own arm, where the problem asks for a family. files: the course's own mechanisms,
    name of the file → its text, and the file of its own checks, checks/NAME.py → its text.
    MechanismFileError or OwnChecksError if the one that the check needs is broken.
    """
    added = own_checks.check_of(id, files)
    if id in CHECKS:
        if added:
            raise own_checks.OwnChecksError(f"{id!r} is a check of the kit: give yours another id")
        check = own_checks.with_mistakes(CHECKS[id], files)
        return check if own is None else families.on(own, check)
    found = added or check_of_file(id, files) or check_of_kit(id)
    if found is None:
        own_checks.refuse_broken(files)
        return None
    return own_checks.with_mistakes(found, files)


def check_here(id: str) -> Check | None:
    """As `check_for`, with the course's own files as they lie around the working folder; None too where
    the one that is needed is broken.
    """
    try:
        return check_for(id, None, files_here(id))
    except ValueError:
        return None


class UnknownCheckError(ValueError):
    """No check has this id. In a notebook it is one line, without the way through our code."""

    def _render_traceback_(self):
        return [str(self)]


def known_check(id: object, own: Convention | None = None) -> Check:
    """The check of this id; where there is none, UnknownCheckError, with those that are nearest.

    A mechanism's own file is found in the folder of the notebook, the course's own checks in its folder
    checks/. The error says so if a person reads the answer, or if that file may be missing.
    """
    if not isinstance(id, str):
        name = getattr(id, "__name__", "")
        said = "nothing" if id is None else f"a {type(id).__name__}"
        raise UnknownCheckError(
            f"give the id of a check, in quotes; you gave {said}{_meant(nearest(str(name)))}"
        )
    if id in READ or id.endswith("-proof"):
        raise UnknownCheckError(f"no check judges {id!r}: a person reads it and gives its points")
    check = check_for(id, own, files_here(id))
    if check is None:
        meant = _meant(nearest(id)) or f"; the checks are {', '.join(CHECKS)}"
        mechanism, _, answer = id.rpartition("-")
        if mechanism and answer in {known.name for known in CHECKS.values()}:
            meant = f", and no {mechanism}.py beside the notebook that could give it{meant}"
        raise UnknownCheckError(f"there is no check {id!r}{meant}")
    return check


def nearest(id: str) -> list[str]:
    """The ids that may be meant, of the same problem where that is known."""
    problem, name, *_ = [*re.split(r"[-_ .]", id.casefold(), maxsplit=1), ""]
    same = [known for known in CHECKS if known.startswith(f"{problem}-")]
    names = {known: known.partition("-")[2].casefold() for known in same or CHECKS}
    asked = name if same else id.casefold()
    if not asked:
        return same
    return (
        [known for known, name in names.items() if name == asked]
        or [known for known, name in names.items() if len(asked) > 1 and asked in name]
        or [
            known
            for close in difflib.get_close_matches(asked, names.values(), cutoff=0.5)
            for known, name in names.items()
            if name == close
        ]
        or same
    )


def _meant(ids: list[str]) -> str:
    return f"; did you mean {' or '.join(map(repr, dict.fromkeys(ids)))}?" if ids else ""
