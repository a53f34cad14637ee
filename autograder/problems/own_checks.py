"""Checks and mistakes of the course's own: checks/NAME.py, for the problem in solutions/NAME.

The file lies beside solutions/, and not in it, as it holds right answers and nbgrader hands out what
lies beside a notebook. It has CHECKS, a tuple, or MISTAKES, for checks of the kit: id → a tuple of
Mistake. Its text goes to whoever judges, so a cluster needs no such folder.
"""

import importlib.abc
import importlib.machinery
import importlib.util
import linecache
import os
import re
import sys
import traceback
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from types import ModuleType

from autograder.judging.check import Check
from autograder.judging.diagnosis import Mistake

FOLDER = "checks"
COURSE = "nbgrader_config.py"  # lies in a course's folder
PACKAGE = "autograder.course_checks"  # by these names the files are modules; a bundle has them so


class OwnChecksError(ValueError):
    """A file of the course's own checks cannot be used; the text says which, where, and what to do."""

    def _render_traceback_(self):
        return [str(self)]


@dataclass(frozen=True)
class Own:
    """What one file defines: checks, and mistakes that it adds to checks, both by the checks' ids."""

    checks: Mapping[str, Check]
    mistakes: Mapping[str, tuple[Mistake, ...]]
    module: ModuleType


@lru_cache(maxsize=64)
def read(text: str, shown: str) -> Own:
    """What the text of a file defines; the same text gives the same objects.

    shown: the file's path in the course, checks/NAME.py. The text is run, so it must be the course's
    own, never a student's. OwnChecksError names file and line.
    """
    try:
        module = _module(text, shown)
        return Own(_checks(vars(module)), _mistakes(vars(module)), module)
    except (Exception, SystemExit) as error:  # whatever the lecturer's file raises
        line = _line(error, shown, text)
        at = f"{shown}, line {line}" if line else shown
        said = error.msg if isinstance(error, SyntaxError) else str(error)
        kind = "" if isinstance(error, OwnChecksError) else f"{type(error).__name__}: "
        raise OwnChecksError(
            f"{at}: {kind}{said}; put the file right, and try it with `autograder try "
            f"{Path(shown).stem}`"
        ) from error


def check_of(id: str, files: Mapping[str, str]) -> Check | None:
    """The check of this id in the files that can be read; None if none has it."""
    return next((own.checks[id] for own in _readable(files) if id in own.checks), None)


def with_mistakes(check: Check, files: Mapping[str, str]) -> Check:
    """The check with what the files add to it, before its own mistakes; one of the same name goes."""
    added = [mistake for own in _readable(files) for mistake in own.mistakes.get(check.id, ())]
    if not added:
        return check
    names = {mistake.name for mistake in added}
    kept = [mistake for mistake in check.mistakes if mistake.name not in names]
    return replace(check, mistakes=(*added, *kept))


def refuse_broken(files: Mapping[str, str]) -> None:
    """OwnChecksError where one of the files cannot be used."""
    for said in broken(files):
        raise OwnChecksError(said)


def broken(files: Mapping[str, str]) -> list[str]:
    """What to say of each file that cannot be used: checks are judged without what it adds to them."""
    said = []
    for shown, text in _of_checks(files).items():
        try:
            read(text, shown)
        except OwnChecksError as error:
            said.append(str(error))
    return said


def import_again(files: Mapping[str, str]) -> None:
    """Have the modules' names stand for these files, whatever was read in between."""
    for own in _readable(files):
        sys.modules[own.module.__name__] = own.module


def files_of(source: Path) -> dict[str, str]:
    """The file of the problem in this folder of solutions/, checks/NAME.py → its text; {} for none."""
    root = course_of(source)
    return _texts([root / FOLDER / f"{source.name}.py"]) if root else {}


def files_here() -> dict[str, str]:
    """Those that a notebook in the working folder needs: its problem's, or else all of the course.

    What another account has put into a folder above, such as /tmp, is left alone: it would be run here.
    """
    here = Path.cwd()
    root = course_of(here)
    if root is None:
        return {}
    found = [path for path in sorted((root / FOLDER).glob("*.py")) if is_ours(path, here)]
    mine = [path for path in found if path.stem == here.name]
    return _texts(mine or found)


def names_here() -> set[str]:
    """Of the functions that these files ask for."""
    return {check.name for own in _readable(files_here()) for check in own.checks.values()}


def course_of(folder: Path) -> Path | None:
    """The course's folder that this one is in; None outside a course."""
    return next((at for at in (folder, *folder.parents) if (at / COURSE).is_file()), None)


def is_ours(path: Path, here: Path) -> bool:
    """Whether the file is this account's, the administrator's, or of whoever owns the working folder."""
    if not hasattr(os, "geteuid"):
        return True
    return path.stat().st_uid in (0, os.geteuid(), here.stat().st_uid)


def _texts(paths: list[Path]) -> dict[str, str]:
    return {
        f"{FOLDER}/{path.name}": path.read_text(encoding="utf-8", errors="replace")
        for path in paths
        if path.is_file()
    }


def _of_checks(files: Mapping[str, str]) -> dict[str, str]:
    return {shown: text for shown, text in files.items() if shown.startswith(f"{FOLDER}/")}


def _readable(files: Mapping[str, str]) -> list[Own]:
    """What can be used; of the rest, `broken` tells."""
    found = []
    for shown, text in _of_checks(files).items():
        with suppress(OwnChecksError):
            found.append(read(text, shown))
    return found


def _module(text: str, shown: str) -> ModuleType:
    """The file's module. It has a name, as a bundle writes a function by the name of its module."""
    name = f"{PACKAGE}.{re.sub(r'[^0-9A-Za-z_]', '_', Path(shown).stem)}"
    spec = importlib.machinery.ModuleSpec(name, _Text(text), origin=shown)
    module = importlib.util.module_from_spec(spec)
    code = compile(text, shown, "exec")
    linecache.cache.pop(shown, None)  # a traceback shall show this text, not an earlier one
    before = sys.modules.get(name)
    sys.modules[name] = module
    try:
        exec(code, vars(module))
    except BaseException:
        sys.modules.pop(name)
        if before is not None:
            sys.modules[name] = before
        raise
    return module


class _Text(importlib.abc.InspectLoader):
    def __init__(self, text: str):
        self._text = text

    def get_source(self, fullname: str) -> str:
        return self._text


def _checks(namespace: Mapping) -> dict[str, Check]:
    found = namespace.get("CHECKS", ())
    if "CHECKS" not in namespace and "MISTAKES" not in namespace:
        raise OwnChecksError("needs CHECKS = (Check(…), …) or MISTAKES = {id: (Mistake(…), …)}")
    _refuse_other(found, Check, "CHECKS")
    checks: dict[str, Check] = {}
    for check in found:
        if not check.id.endswith(f"-{check.name}") or check.id.startswith("-"):
            raise OwnChecksError(
                f"the check {check.id!r} needs an id that ends in its function's name, such as "
                f"{check.id.rpartition('-')[0] or 'crane'}-{check.name}"
            )
        if check.id in checks:
            raise OwnChecksError(f"two of its checks have the id {check.id!r}")
        checks[check.id] = check
    return checks


def _mistakes(namespace: Mapping) -> dict[str, tuple[Mistake, ...]]:
    found = namespace.get("MISTAKES", {})
    if not isinstance(found, Mapping):
        raise OwnChecksError(
            "MISTAKES needs the id of a check before each tuple: {id: (Mistake(…),)}"
        )
    for id, mistakes in found.items():
        _refuse_other(mistakes, Mistake, f"MISTAKES[{id!r}]")
        for mistake in mistakes:
            if not callable(mistake.wrong):
                raise OwnChecksError(
                    f"{mistake.name!r} of MISTAKES[{id!r}] needs a function as `wrong`"
                )
    return {id: tuple(mistakes) for id, mistakes in found.items()}


def _refuse_other(found: object, kind: type, where: str) -> None:
    """OwnChecksError where it is no tuple of these."""
    if not isinstance(found, tuple | list) or not all(isinstance(one, kind) for one in found):
        forgotten = "; a comma is missing behind it" if isinstance(found, kind) else ""
        raise OwnChecksError(f"{where} needs a tuple, ({kind.__name__}(…),){forgotten}")


def _line(error: BaseException, shown: str, text: str) -> int | None:
    """Where in the file it was raised; of what was refused afterwards, where its name stands."""
    if isinstance(error, SyntaxError):
        return error.lineno if error.filename == shown else None
    frames = traceback.extract_tb(error.__traceback__)
    raised = [frame.lineno for frame in frames if frame.filename == shown]
    named = re.findall(r"'([^']+)'", str(error))
    written = [
        number
        for name in named
        for number, line in enumerate(text.splitlines(), 1)
        if f'"{name}"' in line or f"'{name}'" in line
    ]
    return next(iter([*raised[::-1], *written[::-1]]), None)
