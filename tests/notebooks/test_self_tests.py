"""Cells that test the course itself are folded, and guesses are typed before they are answered.

A cell with the tag `self-test` only asserts what a text or a picture says: a student may skip it.
"""

import ast
import re
import symtable
from pathlib import Path

import nbformat
import pytest

from autograder import lesson_checks

LESSONS = sorted((Path(__file__).parents[2] / "lessons").glob("*.ipynb"))
# Lessons without checks of their own still fold the answers to their questions.
WITH_CHECKS = [path for path in LESSONS if path.name[:2] in lesson_checks.numbers()]
DETAILS = re.compile(
    r"<details>\n<summary><strong>The answer, once you have guessed</strong></summary>\n\n"
    r".+\n\n</details>",
    re.DOTALL,
)


def cells_of(path: Path):
    return nbformat.read(path, as_version=4).cells


def is_self_test(cell) -> bool:
    return "self-test" in cell.metadata.get("tags", [])


def is_folded(cell) -> bool:
    return bool(cell.metadata.get("jupyter", {}).get("source_hidden"))


def of_comprehensions(source: str) -> set[str]:
    """The names that comprehensions alone assign: from Python 3.12 on the cell's table has them."""
    tree = ast.parse(source)
    targets = [
        name
        for part in ast.walk(tree)
        if isinstance(part, ast.comprehension)
        for name in ast.walk(part.target)
        if isinstance(name, ast.Name)
    ]
    inside = set(map(id, targets))
    stored = (n for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store))
    return {n.id for n in targets} - {n.id for n in stored if id(n) not in inside}


def names(source: str) -> tuple[set[str], set[str]]:
    """What a cell uses of other cells, and what it defines for them."""
    top = symtable.symtable(source, "cell", "exec")
    defined = {
        s.get_name()
        for s in top.get_symbols()
        if s.is_assigned() or s.is_imported() or s.is_namespace()
    }
    used = {s.get_name() for s in top.get_symbols() if s.is_referenced()}
    own = of_comprehensions(source)
    used, defined = used - own, defined - own
    inner = list(top.get_children())
    while inner:
        scope = inner.pop()
        used |= {s.get_name() for s in scope.get_symbols() if s.is_global() and s.is_referenced()}
        inner += scope.get_children()
    return used - defined, defined


def used_of_self_tests(cells) -> list[str]:
    """The names that an open cell takes from a self-test, each with the cell's id."""
    of_self_test: set[str] = set()
    found = []
    for cell in cells:
        if cell.cell_type != "code":
            continue
        used, defined = names(cell.source)
        if is_self_test(cell):
            of_self_test |= defined
        else:
            of_self_test -= defined
            found += [f"{cell.id} uses {name}" for name in sorted(used & of_self_test)]
    return found


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_a_self_test_may_be_skipped(path):
    cells = cells_of(path)
    for cell in filter(is_self_test, cells):
        assert cell.cell_type == "code"
        assert is_folded(cell), f"{cell.id}: fold it (jupyter.source_hidden)"
        assert cell.source.startswith("# Self-test"), cell.id
        assert re.search(r"^ *assert ", cell.source, re.MULTILINE), cell.id
        assert cell.outputs == [], f"{cell.id}: a self-test prints nothing"
    assert used_of_self_tests(cells) == []


@pytest.mark.parametrize("path", WITH_CHECKS, ids=lambda path: path.stem)
def test_only_self_tests_are_folded(path):
    cells = cells_of(path)
    assert any(map(is_self_test, cells))
    for cell in cells:
        hidden = cell.metadata.get("jupyter", {})
        assert is_self_test(cell) == is_folded(cell), cell.id
        assert "outputs_hidden" not in hidden, cell.id


@pytest.mark.parametrize("path", WITH_CHECKS, ids=lambda path: path.stem)
def test_a_guess_is_typed_before_its_answer(path):
    """The question, the check, the answer folded in the text, the self-test of the answer."""
    cells = cells_of(path)
    checks = lesson_checks.checks_of(path.name[:2])
    asking = [k for k, cell in enumerate(cells) if "Predict, then run" in cell.source]
    assert asking
    for k in asking:
        question, guess, told, tested = cells[k : k + 4]
        assert question.cell_type == "markdown"
        assert guess.id in checks, f"{question.id}: a check comes next"
        assert DETAILS.fullmatch(told.source), f"{told.id}: the answer stands in <details>"
        assert is_self_test(tested), f"{tested.id}: the self-test of the answer"


def cell(source: str, tags=()):
    return nbformat.v4.new_code_cell(source, metadata={"tags": list(tags)})


@pytest.mark.parametrize(
    ("sources", "found"),
    [
        (("a = 1", "b = a"), ["b = a uses a"]),
        (("def a(): ...", "b = a"), ["b = a uses a"]),
        (("a = 1", "a = 2", "b = a"), []),
        (("a, (c, *d) = 1, (2, 3)", "print(d)"), ["print(d) uses d"]),
        (("for a in b: ...", "print(a)"), ["print(a) uses a"]),
        (("[a for a in b]", "print(a)"), []),
        (("def f():\n    a = 1", "print(a)"), []),
        (("a = 1", "def f(a): return a"), []),
        (("from m import a", "def f(): return a"), ["def f(): return a uses a"]),
    ],
)
def test_what_a_cell_takes_from_a_self_test(sources, found):
    first, *others = sources
    cells = [cell(first, ["self-test"]), *map(cell, others)]
    for one in cells:
        one.id = one.source
    assert used_of_self_tests(cells) == found
