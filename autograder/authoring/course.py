"""Where a course has its own mechanisms: solutions/NAME/NAME.py, beside the notebook of the problem."""

import difflib
from collections.abc import Sequence
from pathlib import Path

from autograder.authoring.template import template
from autograder.files import put_in_place
from autograder.mechanisms import MECHANISMS, Mechanism
from autograder.mechanisms.file import MechanismFileError, mechanism_in, mechanism_of


class NoMechanismError(ValueError):
    """There is no mechanism of this name that can be used; the text says why, and what there is."""


class FillInError(ValueError):
    """A mechanism's file has been written, to be filled in; the text says how to go on."""


def own_file(root: Path, name: str) -> Path:
    return root / "solutions" / name / f"{name}.py"


def is_as_written(path: Path, name: str) -> bool:
    """Whether nobody has put a mechanism in the file yet."""
    return path.read_text(encoding="utf-8", errors="replace") == template(name)


def found(root: Path, name: str) -> Mechanism:
    """The mechanism of this name: of its file in solutions/, or of the kit; or of the file NAME.py.

    NoMechanismError if there is none, MechanismFileError if its file is broken.
    """
    if Path(name).suffix == ".py":
        return mechanism_in(Path(name))
    path = own_file(root, name)
    if path.is_file():
        shown = path.relative_to(root).as_posix()
        if is_as_written(path, name):
            raise NoMechanismError(
                f"{shown} is still as it was written: put your mechanism in it first"
            )
        return mechanism_in(path, shown, name)
    if name in MECHANISMS:
        return MECHANISMS[name]
    owned = sorted(p.stem for p in (root / "solutions").glob("*/*.py") if p.stem == p.parent.name)
    has = f"; the course has {', '.join(owned)}" if owned else ""
    raise NoMechanismError(
        f"there is no mechanism {name!r}{_meant(name, owned)}{has}; the kit has "
        f"{', '.join(MECHANISMS)}; `autograder new-problem {name}` writes the file of a new one"
    )


def own(root: Path, name: str) -> Mechanism:
    """The mechanism to write a problem of, its file in place.

    The file NAME.py of anywhere is copied to solutions/; for a name that nothing has, a file to fill in
    is written there, and FillInError says so.
    """
    if Path(name).suffix == ".py":
        mechanism = mechanism_in(Path(name))
        path = own_file(root, mechanism.name)
        if path.resolve() == Path(name).resolve():
            return mechanism_in(path, path.relative_to(root).as_posix(), mechanism.name)
        if path.exists():
            raise NoMechanismError(
                f"{path.relative_to(root)} is there already: change that file, or move it away"
            )
        path.parent.mkdir(parents=True, exist_ok=True)
        put_in_place(path, Path(name).read_text(encoding="utf-8"))
        return mechanism
    if name in MECHANISMS or own_file(root, name).is_file():
        return found(root, name)
    text = template(name)
    try:
        mechanism_of(text, f"{name}.py", name)
    except MechanismFileError:
        raise NoMechanismError(
            f"a mechanism's name has small letters, digits and hyphens, as cart-pole; not {name!r}"
        ) from None
    path = own_file(root, name)
    path.parent.mkdir(parents=True, exist_ok=True)
    put_in_place(path, text)
    raise FillInError(
        f"{path.relative_to(root)}: written, for you to fill in{_meant(name)}. Then run\n"
        f"  autograder try {name}\n  autograder new-problem {name}"
    )


def files_of(root: Path, name: str, mechanism: Mechanism) -> dict[str, str]:
    """The file that `found` read the mechanism from, as the grader takes it; none for one of the kit."""
    path = Path(name) if Path(name).suffix == ".py" else own_file(root, name)
    return {f"{mechanism.name}.py": path.read_text(encoding="utf-8")} if path.is_file() else {}


def _meant(name: str, owned: Sequence[str] = ()) -> str:
    known = [*owned, *MECHANISMS]
    near = [one for one in known if name in one] or difflib.get_close_matches(name, known, 1)
    return f" (did you mean {' or '.join(near)}?)" if near else ""
