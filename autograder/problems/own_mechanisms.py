"""Checks of mechanisms: `cart-pole-M` of the kit, and `gantry-M` of gantry.py beside the notebook."""

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from autograder.judging.check import Check
from autograder.problems import own_checks

# What a mechanism may be asked for, as `mutation.answers` has it, which loads SymPy.
ANSWERED = (
    *("M", "M_dot", "C", "g_vec", "potential_energy", "lagrangian", "f", "energy_drift"),
    "regressor",
)


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


def check_of_kit(id: str) -> Check | None:
    """The check of this id of a mechanism that comes with the kit; None for any other id."""
    name, _, answer = id.rpartition("-")
    return (
        _of_kit(name, answer) if re.fullmatch("[a-z0-9-]+", name) and answer in ANSWERED else None
    )


@lru_cache(maxsize=64)
def _of_kit(name: str, answer: str) -> Check | None:
    from autograder.mechanisms import MECHANISMS  # derives with SymPy, which takes a second
    from autograder.mutation.checks import check_of

    return check_of(MECHANISMS[name], answer) if name in MECHANISMS else None


def files_here(id: str) -> dict[str, str]:
    """The file of the mechanism of a check, where it lies in the folder of a student's notebook or in
    the course's solutions/; and the course's own checks.
    """
    name = id.rpartition("-")[0]
    here = Path.cwd()
    course = own_checks.course_of(here)
    places = [Path(f"{name}.py")]
    if course and (source := course / "solutions" / name / f"{name}.py").is_file():
        places += [source] if own_checks.is_ours(source, here) else []
    for path in filter(Path.is_file, places if name else []):
        text = path.read_text(encoding="utf-8", errors="replace")
        if "MECHANISM" in text:
            return {path.name: text} | own_checks.files_here()
    return own_checks.files_here()
