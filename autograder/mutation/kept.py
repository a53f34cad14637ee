"""Keeps on disk what was derived from a mechanism, so that it is derived once on a machine.

An entry's name is a digest of what it follows from: the mechanism's definition, the code that derives,
and SymPy's version. So none is ever out of date, and you may delete the folder at any time. An entry
holds numbers and names alone, never code.
"""

import json
import os
import stat
import sys
from collections.abc import Callable
from functools import cache, lru_cache
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from autograder.digest import digest
from autograder.files import put_in_place

if TYPE_CHECKING:
    from autograder.mechanisms.outline import Outline

HERE = Path(__file__).parent
DERIVING = (HERE, HERE.parent / "mechanisms")


def entry(parts: tuple[str, ...], make: Callable[[], dict], fits: Callable[[dict], object]):
    """What `fits` makes of the kept entry of these parts; it is made and kept where there is none.

    fits: raises KeyError, TypeError, ValueError or IndexError where an entry is not what it should be.
    It is then made anew, as is one of which anything was changed since. That the folder cannot be read
    or written is no error.
    """
    path = _folder() / f"{digest(code(), *parts)}.json"
    try:
        if _is_own(path.parent):
            return fits(json.loads(_checked(path.read_text(encoding="utf-8"))))
    except (OSError, ValueError, KeyError, TypeError, IndexError):
        pass  # none yet, or damaged
    made = make()
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if _is_own(path.parent):
            put_in_place(path, signed(json.dumps(made)), mode=0o600)
    except OSError:
        pass  # the next process makes it again
    return fits(made)


def signed(text: str) -> str:
    """What stands in the file: a digest of the text, which shows any damage, then the text."""
    return f"{digest(text)}\n{text}"


def _checked(content: str) -> str:
    text = content.partition("\n")[2]
    if content != signed(text):
        raise ValueError("the entry is damaged")
    return text


@cache
def code() -> str:
    """A digest of the code that derives, and of the packages under it."""
    versions = [f"{name} {metadata.version(name)}" for name in ("numpy", "sympy")]
    return digest(*versions, *(path.read_text(encoding="utf-8") for path in sources()))


@lru_cache(maxsize=64)
def definition(outline: "Outline") -> tuple[str, ...]:
    """What of a mechanism its mistakes and numbers follow from, as parts of an entry's name.

    One that comes with the kit follows from the code, which names every entry.
    """
    if outline.is_built_in or _is_of_the_kit(outline):
        return ("built in", outline.name)
    import sympy as sp

    mechanism = outline.full
    energies = (*mechanism.kinetic, *mechanism.potential)
    words = [mechanism.name, *mechanism.coordinates, *mechanism.parameters]
    words += [len(mechanism.kinetic), *(term.name for term in energies), *mechanism.friction]
    formulas = [term.energy for term in energies] + [term.torque for term in mechanism.friction]
    return (str(words), *(sp.srepr(sp.sympify(formula)) for formula in formulas))


def _is_of_the_kit(outline: "Outline") -> bool:
    """Whether it is one of the kit, or that one in π, and follows from its name."""
    loaded = sys.modules.get("autograder.mechanisms.built_in")
    if loaded is None:
        return False
    from autograder.mutation.inertial_parameters import IN_PI, in_inertial_parameters

    try:
        base = loaded.named(outline.name.removesuffix(IN_PI))
    except KeyError:
        return False
    return outline is (base if base.name == outline.name else in_inertial_parameters(base))


@cache
def sentences() -> str:
    """A digest of the code that makes sentences."""
    files = sorted((HERE / "sentences").glob("*.py"))
    return digest(*(path.read_text(encoding="utf-8") for path in files))


def sources() -> list[Path]:
    """The files of that code; sentences have a digest of their own."""
    armdyn = find_spec("armdyn")  # importing it would load SciPy
    assert armdyn is not None
    assert armdyn.origin is not None
    folders = (*DERIVING, Path(armdyn.origin).parent / "derive")
    found = (path for folder in folders for path in folder.rglob("*.py"))
    return sorted(path for path in found if path.parent.name != "sentences")


def _folder() -> Path:
    """Of this user, where the system keeps what may be deleted."""
    if given := os.environ.get("XDG_CACHE_HOME"):
        return Path(given) / "armdyn" / "mechanisms"
    try:
        home = Path.home()
    except RuntimeError:  # a user without a home
        return Path(os.devnull) / "none"
    places = {"win32": "AppData/Local", "darwin": "Library/Caches"}
    return home / places.get(sys.platform, ".cache") / "armdyn" / "mechanisms"


def _is_own(folder: Path) -> bool:
    """Whether nobody else can write here: an entry of others could call a wrong answer right."""
    if sys.platform == "win32":
        return folder.is_dir()  # a user's folder is the user's own there
    found = folder.stat()
    return found.st_uid == os.geteuid() and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
