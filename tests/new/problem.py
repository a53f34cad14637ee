"""Writes a new problem of the kit: its checks, its notebook, its tests. All of it works at once.

    python -m tests.new.problem p6-crane "The crane" lessons/10-state-space-and-simulation.ipynb#10-state

The last argument is the cell of the lesson that prepares it: it begins with a heading, and gets the line
that leads to the problem. Nothing is overwritten. Then change every part to your problem; the tests say
what does not fit together, and in which file.
"""

import re
import subprocess
import sys
from pathlib import Path

import nbformat

from tests.new.filled import filled
from tests.notebooks import course_map

ROOT = Path(__file__).parents[2]
# By the skeleton's file: where it goes.
PLACES = {
    "checks.py": "autograder/problems/{folder}/checks.py",
    "mistakes.py": "autograder/problems/{folder}/mistakes.py",
    "right.py": "tests/autograder/problems/{folder}/right.py",
    "table.py": "tests/autograder/problems/{folder}/table.py",
    "unknown.py": "tests/autograder/problems/{folder}/unknown.py",
    "test_checks.py": "tests/autograder/problems/{folder}/test_checks.py",
    "expected.py": "tests/autograder/problems/{folder}/expected.py",
    "submissions.py": "tests/submissions/{folder}.py",
    "problem.ipynb": "solutions/{name}/{name}.ipynb",
    "figure.svg": "solutions/{name}/{name}.svg",
}
PARTS = "Parts A, B, C and D"


class NewProblemError(ValueError):
    """The problem cannot be written; the text says why."""


def write(root: Path, name: str, title: str, prepared_by: str) -> list[Path]:
    """The files that were written or changed. NewProblemError if one of them is there."""
    if not re.fullmatch(r"[pc]\d(-[a-z0-9]+)+", name):
        raise NewProblemError(
            f"{name!r}: a problem is called like p6-crane, a challenge like c9-crane"
        )
    short, folder = name[:2], name.replace("-", "_")
    if taken := sorted((root / "solutions").glob(f"{short}-*")):
        raise NewProblemError(f"{taken[0].relative_to(root)} has the number {short} already")
    lesson, _, cell = prepared_by.partition("#")
    path = root / lesson
    heading = linked_back(path, cell, name)
    words = {
        "name": name,
        "short": short,
        "folder": folder,
        "title": title,
        "lesson": path.stem,
        "number": path.name[:2],
        "cell": cell,
        "heading": heading,
    }
    written = []
    for skeleton, place in PLACES.items():
        to = root / place.format_map(words)
        if to.exists():
            raise NewProblemError(f"{to.relative_to(root)} is there already")
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(filled(skeleton, words), encoding="utf-8")
        written.append(to)
    python = [str(path) for path in written if path.suffix == ".py"]
    subprocess.run(
        [sys.executable, "-m", "ruff", "format", "--quiet", *python], cwd=root, check=True
    )
    package = root / f"autograder/problems/{folder}/__init__.py"
    package.write_text(f'"""{short}: {title.lower()}."""\n', encoding="utf-8")
    return [*written, package, path]


def linked_back(path: Path, cell_id: str, name: str) -> str:
    """The heading of the lesson's cell, below which a line now leads to the problem."""
    if not path.is_file():
        raise NewProblemError(f"{path}: there is no such lesson")
    lesson = nbformat.read(path, as_version=4)
    cell = next((cell for cell in lesson.cells if cell.id == cell_id), None)
    heading, *rest = cell.source.split("\n") if cell else ("",)
    if not heading.startswith("## "):
        known = [own.id for own in lesson.cells if own.source.startswith("## ")]
        raise NewProblemError(
            f"{path.name}: {cell_id or 'no cell'} is no cell that begins with a heading; these do: "
            f"{', '.join(known)}"
        )
    line = f"*{PARTS} of [{name[:2]}](../problems/{name}/{name}.ipynb) ask for this.*"
    while rest and (not rest[0] or rest[0].startswith("*Part")):
        rest.pop(0)
    before = [one for one in cell.source.split("\n")[1:] if one.startswith("*Part")]
    cell.source = "\n".join([heading, "", *before, line, "", *rest])
    path.write_text(nbformat.writes(lesson) + "\n", encoding="utf-8")
    return heading.removeprefix("## ")


def main(arguments: list[str]) -> int:
    if len(arguments) != 3:
        print(__doc__)
        return 2
    try:
        written = write(ROOT, *arguments)
    except NewProblemError as error:
        print(error, file=sys.stderr)
        return 2
    for path in written:
        print(path.relative_to(ROOT))
    course_map.main([str(ROOT / "docs" / "course-map.md")])
    print("docs/course-map.md")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
