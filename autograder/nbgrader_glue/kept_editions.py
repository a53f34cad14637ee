"""Keeps each edition of an assignment: the notebook as it was released, every time that it changed."""

from pathlib import Path

from autograder.files import put_in_place

FOLDER = Path("course") / "editions"


def keep(root: Path, assignment: str, released: Path) -> None:
    """Keep a released notebook, if none that is kept is the same. root: the course's folder."""
    text = released.read_text(encoding="utf-8")
    if text in kept(root, assignment):
        return
    numbers = _numbers(root, assignment)
    folder = root / FOLDER / assignment
    folder.mkdir(parents=True, exist_ok=True)
    put_in_place(folder / f"{max(numbers, default=0) + 1}.ipynb", text)


def kept(root: Path, assignment: str) -> tuple[str, ...]:
    """The released notebooks as JSON, the newest first."""
    folder = root / FOLDER / assignment
    numbers = sorted(_numbers(root, assignment), reverse=True)
    return tuple((folder / f"{number}.ipynb").read_text(encoding="utf-8") for number in numbers)


def _numbers(root: Path, assignment: str) -> list[int]:
    found = (root / FOLDER / assignment).glob("*.ipynb")
    return [int(path.stem) for path in found if path.stem.isdecimal()]
