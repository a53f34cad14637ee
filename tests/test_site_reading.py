"""What Sphinx is given to read of a page and of a docstring."""

import json

import pytest

pytest.importorskip("mermaidx", reason="needs mermaidx: pip install -c constraints.txt -e .[site]")

from docs import diagrams
from docs.site.reading import docstring, links, page_text


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("[a](../../lessons/03-m.ipynb#cell-id=03-arm)", "[a](#03-arm)"),
        ("[a](../solutions/p1-m/p1-m.ipynb)", "[a](../problems/p1-m/p1-m.ipynb)"),
        ("[a](../tests/autograder/problems/p1/right.py)", "a"),
        ("[a](../tests/armdyn/test_derive.py)", "[a](../tests/armdyn/test_derive.py)"),
    ],
)
def test_a_link(written, read):
    assert links(written) == read


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("the norm |x| of `x_1`", r"the norm \|x\| of ``x_1``"),
        ("* an item\n* `M`s", "* an item\n* ``M``\\ s"),
        ("a*b*c and d_", r"a\*b\*c and d\_"),
    ],
)
def test_a_docstring(written, read):
    assert docstring(written) == read


def notebook(*cells: dict) -> str:
    return json.dumps({"cells": [{"metadata": {}, "id": f"c{i}"} | c for i, c in enumerate(cells)]})


def test_of_a_problem_the_story_is_read():
    text = {"cell_type": "markdown", "source": ["# A story"]}
    proof = {"cell_type": "markdown", "source": ["(your answer)"]}
    proof["metadata"] = {"nbgrader": {"solution": True}}
    code = {"cell_type": "code", "source": ["M = 1"]}
    read = json.loads(page_text("problems/p1/p1", notebook(text, code, proof)))
    assert [cell["source"] for cell in read["cells"]] == ["(c0)=\n# A story"]


def test_what_is_folded_in_a_lesson_is_folded_on_its_page():
    hidden = {"jupyter": {"source_hidden": True, "outputs_hidden": True}}
    answer = {"cell_type": "code", "source": ["42"], "metadata": hidden}
    (cell,) = json.loads(page_text("lessons/00", notebook(answer)))["cells"]
    assert cell["metadata"]["tags"] == ["hide-cell"]


def test_two_diagrams_share_no_id_and_keep_their_text():
    first, second = (diagrams.svg(f"flowchart TD\n a[M q̈] --> {end}[u]") for end in "bc")
    assert "M" in first
    assert "q̈" in first
    assert "foreignObject" not in first
    ids = [{part.split('"')[0] for part in svg.split(' id="')[1:]} for svg in (first, second)]
    assert ids[0]
    assert not ids[0] & ids[1]


def test_a_control_stands_in_place_of_what_its_cell_stored():
    stored = {"output_type": "display_data", "data": {"text/plain": "here"}, "metadata": {}}
    cells = [
        {"cell_type": "code", "id": name, "metadata": {}, "outputs": [stored], "source": ""}
        for name in ("01-control", "01-other")
    ]
    text = json.dumps({"cells": cells})
    read = json.loads(page_text("lessons/01", text, {"01-control": "<div>alive</div>"}))
    control, other = read["cells"]
    assert [output["data"] for output in control["outputs"]] == [{"text/html": "<div>alive</div>"}]
    assert other["outputs"] == [stored]
