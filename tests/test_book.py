"""The course as one PDF: it is set whole, every formula in it is a formula, and it has no answer."""

import json
import re
from pathlib import Path

import pytest

from tests.notebooks.answer_lines import answer_lines, flat

ROOT = Path(__file__).parents[1]
RAW = re.compile(r"(`{3,}).*?\1|`[^`\n]*`", re.DOTALL)
# On which pages the formula sheet and what follows it begin.
SHEET = """
#context [#metadata(
  (<13-sheet>, <13-questions>).map(place => query(place).first().location().page())
) <sheet>]
"""


@pytest.fixture(scope="module")
def source(tmp_path_factory) -> Path:
    """The book as Typst, beside its figures."""
    why = "needs pypandoc: pip install -c constraints.txt -e .[site]"
    pytest.importorskip("pypandoc", reason=why)
    from docs.book.__main__ import book

    folder = tmp_path_factory.mktemp("book")
    file = folder / "book.typ"
    file.write_text(book(folder), encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def text(source) -> str:
    return source.read_text(encoding="utf-8")


def test_it_is_set_its_index_leads_through_it_and_its_sheet_is_one_page(source):
    import typst

    source.write_text(source.read_text(encoding="utf-8") + SHEET, encoding="utf-8")
    compiler = typst.Compiler(source)
    assert compiler.compile().startswith(b"%PDF")
    marks = [mark["value"] for mark in json.loads(compiler.query("<marked>"))]
    assert {"Lagrangian", "inertia matrix", "skew-symmetric", "regressor"} <= set(marks)
    assert len(marks) > 100
    ((begins, next_begins),) = (mark["value"] for mark in json.loads(compiler.query("<sheet>")))
    assert next_begins == begins + 1


def test_a_column_is_as_wide_as_what_stands_in_it(text):
    first = text.index("The lessons along this map")
    widths = re.search(r"columns: \(([^)]+)\)", text[first:])[1].split(", ")
    lesson, about, leads, minutes = (float(width.rstrip("%")) for width in widths)
    assert min(lesson, about, leads) > 2 * minutes


def test_an_index_mark_takes_no_room(source):
    import typst

    (source.parent / "mark.typ").write_text(
        "#set page(width: auto)\n"
        + next(
            line for line in source.read_text(encoding="utf-8").splitlines() if "let marked" in line
        )
        + """
#context assert(measure([form#marked("form").]).width == measure([form.]).width)
""",
        encoding="utf-8",
    )
    assert typst.compile(source.parent / "mark.typ").startswith(b"%PDF")


def test_a_formula_is_no_text(text):
    told = RAW.sub("", text)
    assert r"\$" not in told
    assert "\\dot" not in told


def test_each_chapter_and_figure_is_in_it(text):
    for path in [*ROOT.glob("lessons/*.ipynb"), *ROOT.glob("solutions/*/*.ipynb")]:
        assert f"<{path.stem}>" in text
    stored = sum(
        "image/png" in output.get("data", {})
        for path in ROOT.glob("lessons/*.ipynb")
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]
        if not cell["metadata"].get("jupyter", {}).get("source_hidden")
        for output in cell.get("outputs", [])
    )
    assert text.count(".png") == stored > 20
    assert "flowchart TD" not in text


def test_it_has_no_answer(text):
    printed = flat(text)
    assert [line for line in answer_lines() if line in printed] == []
    assert "In a greenhouse a robot arm" in printed
    assert "your answer goes here" not in printed
