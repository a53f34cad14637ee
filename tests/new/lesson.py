"""Writes a new lesson: its notebook, its checks, their answers, its place after the last lesson.

    python -m tests.new.lesson the-crane "The crane"

It runs the lesson and stores its outputs, states the minutes, and leads from the last lesson to it.
Nothing is overwritten. Then change every part to your lesson; the tests say what does not fit together,
and in which file.
"""

import re
import subprocess
import sys
from pathlib import Path

import nbformat

from docs import reading_order
from tests.new.filled import filled
from tests.notebooks import course_map, reading_time, references
from tests.notebooks.store_outputs import store_outputs

ROOT = Path(__file__).parents[2]
PLACES = {
    "lesson_checks.py": "autograder/lesson_checks/lesson_{number}.py",
    "lesson_answers.py": "tests/autograder/lesson_checks/lesson_{number}.py",
    "lesson.ipynb": "lessons/{number}-{name}.ipynb",
}
UNKNOWN = "About 0 minutes"


class NewLessonError(ValueError):
    """The lesson cannot be written; the text says why."""


def write(root: Path, name: str, title: str) -> list[Path]:
    """The files that were written or changed; the lesson, which has not run yet, is the first."""
    if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name):
        raise NewLessonError(f"{name!r}: a lesson is called like the-crane; its number is added")
    *_, last = reading_order.lessons(root / "lessons")
    number = f"{1 + max(int(path.name[:2]) for path in (root / 'lessons').glob('*.ipynb')):02}"
    words = {"number": number, "name": name, "title": title}
    written = []
    for skeleton, place in PLACES.items():
        to = root / place.format_map(words)
        if to.exists():
            raise NewLessonError(f"{to.relative_to(root)} is there already")
        to.write_text(filled(skeleton, words), encoding="utf-8")
        written.insert(0, to)
    path, *python = written
    format_them = [sys.executable, "-m", "ruff", "format", "--quiet", *map(str, python)]
    subprocess.run(format_them, cwd=root, check=True)
    start = root / "lessons" / "00-start-here.ipynb"
    _change(
        start,
        reading_order.TABLE,
        lambda text: _with_row(
            text, f"| [{number} · {title}]({path.name}) | its subject | – | 0 |"
        ),
    )
    _change(last, f"{last.name[:2]}-summary", lambda text: _with_next(text, words, path.name))
    return [*written, start, last]


def state_minutes(path: Path, start: Path) -> int:
    """Write how long the lesson takes into its first cell and into the table of lesson 00."""
    minutes = reading_time.to_state(path)
    first = nbformat.read(path, as_version=4).cells[0].id
    _change(path, first, lambda text: text.replace(UNKNOWN, f"About {minutes} minutes"))
    row = re.compile(rf"(^\| \[[^]]+\]\({path.name}\) .*\| )0( \|)$", re.MULTILINE)
    _change(start, reading_order.TABLE, lambda text: row.sub(rf"\g<1>{minutes}\2", text))
    return minutes


def _change(path: Path, cell_id: str, change) -> None:
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        if cell.id == cell_id:
            cell.source = change(cell.source)
    path.write_text(nbformat.writes(notebook) + "\n", encoding="utf-8")


def _with_row(text: str, row: str) -> str:
    """The table with one more row."""
    lines = text.split("\n")
    end = max(k for k, line in enumerate(lines) if line.startswith("| ["))
    return "\n".join([*lines[: end + 1], row, *lines[end + 1 :]])


def _with_next(text: str, words: dict[str, str], file: str) -> str:
    """The last lesson's summary, which now leads on."""
    line = f"**Next:** [{words['number']} · {words['title']}]({file})."
    return text.replace("\n### References", f"\n{line}\n\n### References", 1)


def main(arguments: list[str]) -> int:
    if len(arguments) != 2:
        print(__doc__)
        return 2
    try:
        path, *others = write(ROOT, *arguments)
    except NewLessonError as error:
        print(error, file=sys.stderr)
        return 2
    store_outputs(path)
    minutes = state_minutes(path, ROOT / "lessons" / "00-start-here.ipynb")
    course_map.main([str(ROOT / "docs" / "course-map.md")])
    references.main(str(ROOT / "docs" / "references.md"))
    for file in (path, *others):
        print(file.relative_to(ROOT))
    print(f"docs/course-map.md\ndocs/references.md\nIt takes about {minutes} minutes to read.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
