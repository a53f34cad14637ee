"""How long a lesson takes, by what it has in it; the lesson's first cell states it.

    python -m tests.notebooks.reading_time lessons/*.ipynb

Words at 120 a minute, which is slow reading with a thought in between; half a minute for each line of a
formula that stands by itself, and for each picture; code at 12 lines a minute; three minutes for a check
that the student answers. Self-tests, the list of references and an appendix do not count.
"""

import math
import re
import sys
from pathlib import Path

import nbformat

from autograder import lesson_checks

LESSONS = sorted((Path(__file__).parents[2] / "lessons").glob("*.ipynb"))
WORDS, CODE_LINES = 120, 12  # a minute
DISPLAY, PICTURE, CHECK = 0.5, 0.5, 3  # minutes each
STEP = 5  # what is stated is a multiple, in minutes
NOT_READ = re.compile(r"^#{2,3} (References|Appendix)\b", re.MULTILINE)
FORMULA = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
PICTURES = ("image/png", "image/svg+xml")


def counts(path: Path) -> dict[str, int]:
    """What a student of the lesson reads, looks at and answers."""
    checks = lesson_checks.checks_of(path.name[:2])
    found = dict.fromkeys(("words", "displays", "lines", "pictures", "checks"), 0)
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "markdown":
            text, *rest = NOT_READ.split(cell.source)
            displays = FORMULA.findall(text)
            found["displays"] += sum(map(_lines_of, displays))
            found["words"] += len(re.findall(r"\w[\w'’.-]*", _plain(text)))
            if rest and cell.source.startswith("## Appendix"):
                break
        elif cell.id in checks:
            found["checks"] += 1
        elif "self-test" not in cell.metadata.get("tags", []):
            lines = [line.strip() for line in cell.source.splitlines()]
            found["lines"] += sum(bool(line) and not line.startswith("#") for line in lines)
            shown = [output.get("data", {}) for output in cell.outputs]
            found["pictures"] += sum(any(kind in data for kind in PICTURES) for data in shown)
    return found


def minutes(path: Path) -> float:
    """How long the lesson takes, before it is rounded up to what is stated."""
    of = counts(path)
    return (
        of["words"] / WORDS
        + of["lines"] / CODE_LINES
        + DISPLAY * of["displays"]
        + PICTURE * of["pictures"]
        + CHECK * of["checks"]
    )


def to_state(path: Path) -> int:
    return STEP * math.ceil(minutes(path) / STEP)


def stated(path: Path) -> int:
    """The minutes in the lesson's first cell; ValueError, with what to write, where it has none."""
    first = nbformat.read(path, as_version=4).cells[0].source
    found = re.search(r"About (\d+) minutes", first)
    if found is None:
        raise ValueError(
            f"lessons/{path.name}: its first cell has to say how long it takes, as in *About "
            f"{to_state(path)} minutes. You need: …*"
        )
    return int(found[1])


def _lines_of(formula: str) -> int:
    """The lines of a formula, of which an aligned one has several and a matrix is none."""
    if "{aligned}" not in formula:
        return 1
    without_matrices = re.sub(
        r"\\begin\{bmatrix\}.+?\\end\{bmatrix\}", "", formula, flags=re.DOTALL
    )
    return 1 + without_matrices.count(r"\\")


def _plain(text: str) -> str:
    """The text as it is read: a formula within it is one word, and addresses are none."""
    text = FORMULA.sub(" ", text)
    text = re.sub(r"```.+?```", " ", text, flags=re.DOTALL)
    text = re.sub(r"\$[^$]+\$", " x ", text)
    return re.sub(r"\]\([^)]*\)|</?\w+>", " ", text)


def main(paths: list[str]) -> None:
    for path in map(Path, paths):
        of = ", ".join(f"{number} {name}" for name, number in counts(path).items())
        print(f"{path.stem}: {of}: {minutes(path):.0f}, so state {to_state(path)} minutes")


if __name__ == "__main__":
    main(sys.argv[1:])
