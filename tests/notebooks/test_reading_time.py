"""Each lesson states how long it takes, and that is what its words, lines and tasks add up to."""

import nbformat
import pytest

from tests.notebooks.reading_time import LESSONS, counts, minutes, stated, to_state


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_stated_minutes_are_those_that_it_takes(path):
    assert abs(stated(path) - to_state(path)) <= 5, (
        f"state {to_state(path)} minutes: {counts(path)}"
    )


def test_a_lesson_without_minutes_is_told_what_to_write(tmp_path):
    cell = nbformat.v4.new_markdown_cell("# 99 · New\n\n" + "word " * 700)
    path = tmp_path / "99-new.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=[cell]), path)
    with pytest.raises(ValueError, match=r"lessons/99-new\.ipynb: .* \*About 10 minutes\."):
        stated(path)


def test_what_counts(tmp_path):
    cell = nbformat.v4
    picture = cell.new_output("display_data", {"image/png": "", "text/plain": "an arm"})
    cells = [
        cell.new_markdown_cell(
            "One $q$ [three](four.ipynb).\n\n$$a\\\\b$$\n\n"
            "$$\\begin{aligned}a &= \\begin{bmatrix}0\\\\1\\end{bmatrix}\\\\ b &= c\\end{aligned}$$"
        ),
        cell.new_code_cell("# a comment\na = 1\n\nb = 2", outputs=[picture]),
        cell.new_code_cell("assert a", metadata={"tags": ["self-test"]}),
        cell.new_code_cell('my_sag = ...\ncheck("05-sag")', id="05-sag"),
        cell.new_markdown_cell("Five.\n\n### References\n- A. Author (1999), *A book*."),
        cell.new_markdown_cell("## Appendix: more\n\nMuch more."),
        cell.new_code_cell("c = 3"),
    ]
    path = tmp_path / "05-a.ipynb"
    nbformat.write(cell.new_notebook(cells=cells), path)
    expected = {"words": 4, "displays": 3, "lines": 2, "pictures": 1, "checks": 1}
    assert counts(path) == expected
    assert minutes(path) == pytest.approx(4 / 120 + 3 / 2 + 2 / 12 + 1 / 2 + 3)
    assert to_state(path) == 10
