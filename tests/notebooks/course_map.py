"""One page on the whole course, made from its notebooks: section, problem, model and test.

    python -m tests.notebooks.course_map docs/course-map.md

`make lessons` runs it. Nothing of the page is written by hand: what a section computes with is read
from its cells, and what tests that is found by the module's name.
"""

import ast
import importlib
import inspect
import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import nbformat

from autograder import lesson_checks
from autograder.problems import CHECKS, READ
from tests.notebooks import reading_time

ROOT = Path(__file__).parents[2]
HEAD = """# The course, section by section

Made from the notebooks by `make lessons`; do not edit it. Everything in the second column is called
in the section's own cells, and their asserts hold its formulas and numbers; `pytest --nbval lessons`
runs them all. The third column has the tests of what is called.

| lesson | reading | leads to | traps it shows |
|---|---|---|---|
"""
GOALS = """
## What is graded of the goals

Each lesson says what a student can do after it. A goal is graded if a check of the lesson or a part of
a problem asks for it.

| lesson | goals | graded | by checks of the lesson |
|---|---|---|---|
"""
NO_CHECKS = "no checks yet"
PROBLEMS = """
## The problems

Each check runs in the student's notebook and, with fresh arms and states, in the grader. It knows
that many wrong models by name, which are in `mistakes.py`, and files like it, beside the checks. Each of
them has a wrong answer in the problem's table, and [one test]({}) runs all tables.
"""
TABLES_TEST = ROOT / "tests" / "autograder" / "problems" / "test_mistakes.py"


@dataclass(frozen=True)
class Section:
    """A heading of a notebook, and the cells below it."""

    title: str
    cells: tuple

    @property
    def code(self) -> str:
        return "\n".join(cell.source for cell in self.cells if cell.cell_type == "code")

    @property
    def text(self) -> str:
        return "\n".join(cell.source for cell in self.cells if cell.cell_type == "markdown")


def sections(notebook: Path) -> list[Section]:
    """The notebook cut at its headings of the first and second level, the title first."""
    found, cells = [], []
    for cell in nbformat.read(notebook, as_version=4).cells:
        heading = re.match(r"##? (.+)", cell.source) if cell.cell_type == "markdown" else None
        if heading:
            cells = []
            found.append((heading[1], cells))
        cells.append(cell)
    return [Section(title, tuple(cells)) for title, cells in found]


def names_used(parts: list[Section]) -> Iterator[tuple[Section, list[str]]]:
    """Each section with what its cells use of armdyn, as `properties.symmetry` or `Planar2R.M`."""
    known = {}  # a name of the notebook → what it stands for
    for part in parts:
        tree = ast.parse(part.code)
        known |= _imported(tree)
        known |= _made(tree, known)
        used = {_resolved(node, known) for node in ast.walk(tree)}
        whole = {name for name in used if name and not name.startswith("plotting")}
        # A model's function says more than the model alone.
        yield part, sorted(n for n in whole if not any(m.startswith(f"{n}.") for m in whole))


def _imported(tree):
    return {
        alias.asname or alias.name: ".".join([*(node.module or "").split(".")[1:], alias.name])
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "armdyn"
        for alias in node.names
    }


def _made(tree, known):
    """Variables that are assigned a model: `arm = Planar2R(...)`."""
    return {
        target.id: known[node.value.func.id]
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.Call)
        and isinstance(node.value.func, ast.Name)
        and inspect.isclass(_found(known.get(node.value.func.id, "")))
        for target in node.targets
        if isinstance(target, ast.Name)
    }


def _resolved(node, known) -> str | None:
    if isinstance(node, ast.Name):
        return known.get(node.id)
    if not isinstance(node, ast.Attribute):
        return None
    base = _resolved(node.value, known)
    if base is None:
        return None
    name = f"{base}.{node.attr}"
    # A field of a model, such as arm.l1, is no part of the course's subject.
    return name if callable(_found(name)) or inspect.ismodule(_found(name)) else base


def _found(name: str):
    """What a dotted name stands for in armdyn; None where it stands for nothing."""
    found = importlib.import_module("armdyn")
    for part in filter(None, name.split(".")):
        inner = getattr(found, part, None)
        if inner is None and inspect.ismodule(found):
            try:
                inner = importlib.import_module(f"{found.__name__}.{part}")
            except ImportError:
                return None
        found = inner
        if found is None:
            return None
    return found


def files_testing(name: str) -> list[str]:
    """The test files named after the module that a name comes from, or after a package around it.

    Where there are none: those that import the name.
    """
    found = _found(name)
    module = found.__name__ if inspect.ismodule(found) else getattr(found, "__module__", "")
    folders = [ROOT / "tests" / folder for folder in ("armdyn", "ports")]
    files = [
        path
        for part in module.split(".")[1:]
        for folder in folders
        for path in folder.glob(f"test_{part}*.py")
    ]
    imported = re.compile(rf"^from armdyn.* import .*\b{name.split('.')[0]}\b", re.MULTILINE)
    files = files or [
        path
        for folder in folders
        for path in folder.glob("test_*.py")
        if imported.search(path.read_text(encoding="utf-8"))
    ]
    return sorted(path.relative_to(ROOT).as_posix() for path in files)


def lessons() -> list[Path]:
    return sorted((ROOT / "lessons").glob("*.ipynb"))


def problems() -> list[Path]:
    return sorted(
        (ROOT / "solutions").glob("*/*.ipynb"), key=lambda path: (path.stem[0] == "c", path)
    )


def goals(lesson: Path) -> list[str]:
    """What a student can do after a lesson, as its first cell lists it."""
    first = sections(lesson)[0].text
    listed = re.search(
        r"^\*\*After this lesson you can\*\*\n\n((?:\d+\. .+\n)+)", first, re.MULTILINE
    )
    return re.findall(r"^\d+\. (.+)$", listed[1], re.MULTILINE) if listed else []


def graded(lesson: Path) -> dict[int, tuple[str, ...]]:
    """The ids of the checks that grade each goal of a lesson, by the goal's number."""
    number = lesson.name[:2]
    known = number in lesson_checks.numbers()
    return lesson_checks.of_lesson(number).GOALS if known else {}


def page(to: Path) -> str:
    """The page; links are those of a file at `to`."""
    cut = {path: sections(path) for path in lessons()}
    leads = {path: _leads_to(parts) for path, parts in cut.items()}
    lines = [
        HEAD + "\n".join(_overview(path, parts, leads[path], to) for path, parts in cut.items())
    ]
    lines.append(GOALS + "\n".join(_all_goals(list(cut), to)))
    for path, parts in cut.items():
        lines += _lesson(path, parts, to)
        lines += _goals(path, to)
    lines.append(PROBLEMS.format(_link(TABLES_TEST, to)))
    for path in problems():
        prepared_by = [lesson for lesson, led in leads.items() if path.stem in led]
        lines += _problem(path, prepared_by, to)
    return "\n".join(lines) + "\n"


def _leads_to(parts):
    """The problems that a lesson links to."""
    text = "\n".join(part.text for part in parts)
    return list(dict.fromkeys(re.findall(r"\.\./problems/([\w-]+)/", text)))


def _overview(path, parts, led, to):
    text = "\n".join(part.text for part in parts)
    minutes = reading_time.stated(path)
    traps = "; ".join(_cell(trap) for trap in re.findall(r"^### Trap: (.+)$", text, re.MULTILINE))
    linked = ", ".join(f"[{name}]({_link(_source(name), to)})" for name in led)
    return f"| [{parts[0].title}]({_link(path, to)}) | {minutes} min | {linked} | {traps} |"


def _lesson(path, parts, to):
    yield f"\n## [{parts[0].title}]({_link(path, to)})\n"
    yield from ("| section | computed with | tests |", "|---|---|---|")
    for part, used in names_used(parts):
        if part is parts[0] or part.title == "Summary":
            continue
        tests = dict.fromkeys(test for name in used for test in files_testing(name))
        called = ", ".join(f"`{name}`" for name in used) or ("its own cells" if part.code else "")
        yield f"| {_cell(part.title)} | {called} | {_tests(tests, to)} |"


def _all_goals(paths, to):
    """A row a lesson, and the sum."""
    totals = [0, 0, 0]
    for path in paths:
        ids = graded(path)
        own = lesson_checks.checks_of(path.name[:2])
        here = sum(any(id in own for id in ids[goal]) for goal in ids)
        counts = [len(goals(path)), len(ids), here]
        totals = [total + count for total, count in zip(totals, counts, strict=True)]
        stated, of_all, of_own = counts
        shown = f"{of_all} | {of_own}" if ids else f"{NO_CHECKS} | "
        yield f"| [{path.name[:2]}]({_link(path, to)}) | {stated} | {shown} |"
    yield "| all | " + " | ".join(map(str, totals)) + " |"


def _goals(path, to):
    """What grades each goal of a lesson that has checks."""
    ids = graded(path)
    if not ids:
        return
    number = path.name[:2]
    table = ROOT / "tests" / "autograder" / "lesson_checks" / f"lesson_{number}.py"
    module = ROOT / "autograder" / "lesson_checks" / f"lesson_{number}.py"
    yield f"\nChecks: [{module.name}]({_link(module, to)}). Answers: {_tests([table], to)}.\n"
    yield from ("| after this lesson you can | graded by |", "|---|---|")
    for goal, text in enumerate(goals(path), 1):
        by = ", ".join(
            f"`{id}`" + (", read by a person" if id in READ else "") for id in ids.get(goal, ())
        )
        yield f"| {_cell(text)} | {by or 'nothing'} |"


def _problem(path, prepared_by, to):
    title, *parts = sections(path)
    module = path.stem.replace("-", "_")
    of_problem = [
        f"tests/autograder/problems/{module}/test_checks.py",
        f"tests/autograder/problems/{module}/right.py",
        f"tests/autograder/problems/{module}/table.py",
        f"tests/autograder/problems/{module}/unknown.py",
        f"tests/submissions/{module}.py",
    ]
    tests = [test for test in of_problem if (ROOT / test).exists()]
    yield f"\n### [{path.stem}: {_short(title.title)}]({_link(path, to)})\n"
    by = ", ".join(f"[{lesson.stem[:2]}]({_link(lesson, to)})" for lesson in prepared_by)
    yield f"Lessons: {by}. Checks: `autograder/problems/{module}/`. Tests: {_tests(tests, to)}.\n"
    yield from ("| part | graded | points | mistakes known |", "|---|---|---|---|")
    for part in parts:
        for cell in part.cells:
            graded = cell.metadata.get("nbgrader", {})
            if graded.get("grade"):
                check = CHECKS.get(graded["grade_id"])
                how = f"`{graded['grade_id']}`" + ("" if check else ", read by a person")
                known = len(check.known_mistakes) if check else ""
                yield f"| {_cell(part.title)} | {how} | {graded['points']:g} | {known} |"


def _short(title):
    return title.partition(": ")[2] or title


def _cell(text):
    return text.replace("|", "\\|")


def _source(problem):
    return ROOT / "solutions" / problem / f"{problem}.ipynb"


def _tests(tests, to):
    return ", ".join(f"[{Path(test).stem}]({_link(ROOT / test, to)})" for test in tests)


def _link(path, to):
    return Path(os.path.relpath(path, to.resolve().parent)).as_posix()


def main(paths: list[str]) -> None:
    for path in map(Path, paths):
        path.write_text(page(path), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
