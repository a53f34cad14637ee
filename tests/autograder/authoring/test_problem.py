"""`autograder new-problem`: a mechanism's notebook, whose model answers pass, released and graded."""

import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import nbformat
import numpy as np
import pytest
import sympy as sp

from autograder.authoring.model_answer import model_answer
from autograder.authoring.picture import WIDTH, picture
from autograder.authoring.problem import (
    USUAL,
    ProblemError,
    notebook,
    usual_asks,
    write_problem,
)
from autograder.authoring.tasks import POINTS, WHAT
from autograder.mechanisms import MECHANISMS, Coordinate, EnergyTerm, Mechanism, Parameter
from autograder.mutation.answers import ANSWERS
from autograder.mutation.references import reference
from autograder.mutation.trial import nothing_to_ask
from tests.autograder.courses import new_course, run

EVERY = pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=list(MECHANISMS))
CART = MECHANISMS["cart-pole"]


@EVERY
@pytest.mark.parametrize("answer", ANSWERS)
def test_a_model_answer_is_right(mechanism, answer):
    asked = ANSWERS[answer]
    source = f"def {asked.signature}:\n" + "\n".join(
        f"    {line}" for line in model_answer(mechanism, answer)
    )
    namespace = {"np": np}
    exec(source, namespace)
    for call in asked.calls(mechanism, np.random.default_rng(1), 1)[:6]:
        right = reference(mechanism, answer)(*call.args)
        np.testing.assert_allclose(namespace[answer](*call.args), right, rtol=1e-9, atol=1e-10)


def test_a_model_answer_of_squared_velocities_is_as_short_as_by_hand():
    """K of a double pendulum with absolute angles, as it comes out of the velocities."""
    a, b = Coordinate("a", "rad", "link 1 upright"), Coordinate("b", "rad", "link 2 upright")
    m, length = Parameter("m", "kg", "mass", 1.0, 2.0), Parameter("r", "m", "length", 0.5, 1.0)
    x = length.symbol * (sp.cos(a.symbol) * a.velocity + sp.cos(b.symbol) * b.velocity)
    y = length.symbol * (sp.sin(a.symbol) * a.velocity + sp.sin(b.symbol) * b.velocity)
    bob = EnergyTerm("the bob", m.symbol * (x**2 + y**2) / 2)
    two = Mechanism("two", (a, b), (m, length), (bob,), (), lambda q, arm: [(0, 0)])
    assert model_answer(two, "M")[:2] == [
        "M11 = arm.m*arm.r**2",
        "M12 = arm.m*arm.r**2*np.cos(q[0] - q[1])",
    ]


@EVERY
def test_a_notebook_is_one_that_nbgrader_takes(mechanism):
    made = notebook(mechanism, list(ANSWERS))
    nbformat.validate(made)
    ids = [cell.id for cell in made.cells]
    grade_ids = [
        cell.metadata.nbgrader.grade_id for cell in made.cells if "nbgrader" in cell.metadata
    ]
    assert len(set(ids)) == len(ids)
    assert len(set(grade_ids)) == len(grade_ids)
    assert not any("outputs" in cell and cell.outputs for cell in made.cells)


def test_a_problem_is_written_released_and_graded(tmp_path):
    """As an instructor does it; one student hands in the model answers but for one sign."""
    root = new_course(tmp_path / "course")
    shown = run(root, "autograder", "new-problem", "cart-pole", "--asks", "M,C")
    assert "solutions/cart-pole/cart-pole.ipynb: written" in shown
    run(root, "nbgrader", "generate_assignment", "cart-pole")
    released = root / "course" / "release" / "cart-pole" / "cart-pole.ipynb"
    text = released.read_text(encoding="utf-8")
    assert "raise NotImplementedError" in text
    assert "arm.lc*arm.m" not in text
    assert (released.parent / "cart-pole.svg").is_file()

    answered = nbformat.read(root / "solutions" / "cart-pole" / "cart-pole.ipynb", 4)
    handed_in = nbformat.read(released, 4)
    for cell, model in zip(handed_in.cells, answered.cells, strict=True):
        if cell.metadata.get("nbgrader", {}).get("grade_id") == "answer-M":
            cell.source = model.source.replace("M12 = arm", "M12 = -arm")
        elif cell.metadata.get("nbgrader", {}).get("grade_id") == "answer-C":
            cell.source = model.source
    folder = root / "course" / "submitted" / "ada" / "cart-pole"
    folder.mkdir(parents=True)
    nbformat.write(handed_in, folder / "cart-pole.ipynb")
    shown = run(root, "autograder", "grade", "cart-pole", "--jobs", "1")
    assert "ada" in shown
    graded = (root / "course" / "autograded" / "ada" / "cart-pole" / "cart-pole.ipynb").read_text()
    assert "the coupling of cart and pole has the wrong sign" in graded
    scores = {
        cell["metadata"]["nbgrader"]["grade_id"]: json.dumps(cell["outputs"])
        for cell in json.loads(graded)["cells"]
        if cell["metadata"].get("nbgrader", {}).get("grade") and cell["cell_type"] == "code"
    }
    assert "partly correct" in scores["cart-pole-M"]
    assert "cart-pole-C: correct" in scores["cart-pole-C"]


def test_nothing_is_written_over(tmp_path):
    path = write_problem(tmp_path, CART, ["M"])
    before = path.read_bytes()
    with pytest.raises(ProblemError, match=r"cart-pole\.ipynb is there already; move it away"):
        write_problem(tmp_path, CART, ["M", "C"])
    assert path.read_bytes() == before


@EVERY
def test_the_proof_has_the_friction_of_the_equation_above_it(mechanism):
    for asks in (["C"], ["C", "f"]):
        cells = {cell.id.removeprefix(f"{mechanism.name}-"): cell.source
                 for cell in notebook(mechanism, asks).cells}  # fmt: skip
        resists = "f(\\dot q)" in cells["title"]
        assert resists == (bool(mechanism.friction) and "f" in asks)
        assert ("u - f(\\dot q)" in cells["proof"]) == resists
        assert ("u - f(\\dot q)" in cells["proof-task"]) == resists


@EVERY
def test_the_table_has_the_names_that_sentences_use(mechanism):
    table = notebook(mechanism, ["M"]).cells[1].source
    for symbol in mechanism.qd:
        assert re.search(rf"\b{symbol.name} \|", table)


@pytest.mark.parametrize("asks", [[], ["M", "M"], ["m"], ["M", ""]])
def test_answers_that_cannot_be_asked(tmp_path, asks):
    with pytest.raises(ProblemError, match=f"needs some of {', '.join(ANSWERS)}, each once"):
        write_problem(tmp_path, CART, asks)
    assert not (tmp_path / "solutions").exists()


@EVERY
def test_the_usual_problem_asks_nothing_that_is_0(mechanism):
    asks = usual_asks(mechanism)
    assert "M" in asks
    assert [answer for answer in USUAL if nothing_to_ask(mechanism, answer)] == [
        answer for answer in USUAL if answer not in asks
    ]


def test_every_answer_has_its_words_and_points():
    assert set(POINTS) == set(WHAT) == set(ANSWERS)


SEEN = {
    "cart-pole": {"Rail", "Cart", "Link", "Mass"},
    "spring-cart": {"Rail", "Wall", "Spring", "Cart", "Link", "Mass"},
    "turn-and-slide": {"Ground", "Link", "Slide", "Mass"},
    "slider-crank": {"Ground", "Rail", "Cart", "Link"},
    "planar-3r": {"Ground", "Link", "Mass"},
}


@pytest.mark.parametrize("name", SEEN)
def test_a_picture_has_the_shapes_of_its_mechanism(name):
    mechanism, rng = MECHANISMS[name], np.random.default_rng(2)
    shapes = mechanism.shapes(mechanism.placed(rng), mechanism.drawn(rng))
    assert {type(shape).__name__ for shape in shapes} == SEEN[name]


@EVERY
def test_a_picture_lies_within_its_frame(mechanism):
    root = ElementTree.fromstring(picture(mechanism))
    numbers = [float(x) for x in re.findall(r"-?\d+\.\d", " ".join(_places(root)))]
    assert min(numbers) >= 0
    assert max(numbers) <= WIDTH


def _places(root):
    for element in root.iter():
        yield from (element.get(name, "") for name in ("d", "cx", "cy", "x", "y"))


@pytest.mark.parametrize(
    ("draws", "said"),
    [
        (lambda q, arm: [(q[0], 0.0)], "draws gave [("),
        (lambda q, arm: [], "draws gave [], needs a list of Link, Spring, Slide, Cart"),
        (lambda q, arm: [arm.nothing], "draws raised AttributeError"),
    ],
)
def test_what_cannot_be_drawn_is_refused(draws, said):
    with pytest.raises(ValueError, match=r"^mechanism 'cart-pole': ") as refused:
        replace(CART, draws=draws)
    assert said in str(refused.value)
