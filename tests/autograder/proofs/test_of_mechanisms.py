"""The derivations of any mechanism's problem: known by their ids, in its words, marked as p2 and p5."""

import pytest

from autograder.authoring import proof
from autograder.proofs import DERIVATIONS, card, derivation_of
from autograder.proofs.of_mechanisms import _SENTENCES, OF_ANY
from tests.autograder.proofs.models import marked, models

KINDS = pytest.mark.parametrize("friction", [False, True], ids=["free", "friction"])


@pytest.mark.parametrize("id", ["cart-pole-E", "block-skew", "p-2-E-friction", "e-E", "p1x-skew"])
def test_a_mechanism_has_derivations(id):
    found = derivation_of(id)
    assert found.id == id
    assert found.cell == f"{id.removesuffix('-friction').rpartition('-')[0]}-proof"
    assert derivation_of(id) is found


NONE = (
    *("", "E", "-E", "cart-pole", "cart-pole-e", "cart-pole-C", "Cart-E", "a b-E", "a--E", "p1-E"),
    *(
        "c6-skew",
        "answer-p2-E",
        "answer-cart-pole-E",
        "cart-pole-friction",
        "cart-pole-skew-friction",
        "cart-pole-E\n",
        "a-E'); f(('",
    ),
)


@pytest.mark.parametrize("id", NONE)
def test_nothing_else_does(id):
    assert derivation_of(id) is None


def test_a_problem_keeps_its_own():
    assert all(derivation_of(id) is known for id, known in DERIVATIONS.items())


@KINDS
def test_the_models_are_those_of_the_courses_problems(friction):
    """They stand in two files, as a notebook in source form cannot import one."""
    energy, skew = proof.lines_of("cart-pole", friction)
    assert list(energy.model) == models()["p5-E" if friction else "p2-E"]
    assert list(skew.model) == models()["p2-skew"]


@KINDS
@pytest.mark.parametrize("seed", range(3))
def test_the_models_earn_the_rows_of_the_table(friction, seed):
    earned = []
    for lines in proof.lines_of("cart-pole", friction):
        namespace = {}
        exec(lines.answer, namespace)
        found = marked(lines.id, namespace[lines.function], seed)
        assert (found.done, found.still) == (True, "")
        assert found.earned == derivation_of(lines.id).rows
        earned += [(row.number, row.points) for row in found.earned]
    assert earned == [(1, 1), (2, 1), (3, 1)]
    table = [line for line in proof.task("B", friction).splitlines() if line.startswith("| 1 |")]
    assert len(table) == proof.POINTS
    for at, word in enumerate(("symmetry of $M$", "equation of motion", "skew-symmetric")):
        assert word in table[at]


@KINDS
def test_the_first_rows_are_earned_on_the_way(friction):
    energy, _ = proof.lines_of("cart-pole", friction)
    numbers = [[row.number for row in marked(energy.id, list(energy.model[:count])).earned]
               for count in (4, 5, 7)]  # fmt: skip
    assert numbers == [[], [1], [1, 2]]


def test_each_sentence_of_ours_stands_for_one_of_the_course():
    names = {mistake.name for one in OF_ANY.values() for mistake in one.mistakes}
    assert set(_SENTENCES) <= names


MOTION = "equation of motion"
FALSE = {
    "g reversed": ("E", "qd' (u - C qd + g) + 1/2 qd' Mdot qd + qd' g", "g has the wrong sign."),
    "no g": ("E", "qd' (u - C qd) + 1/2 qd' Mdot qd + qd' g", "This step loses g,"),
    "no u": ("E", "-qd' (C qd + g) + 1/2 qd' Mdot qd + qd' g", "takes the motors to give nothing."),
    "no f": (
        "E-friction",
        "qd' (u - C qd - g) + 1/2 qd' Mdot qd + qd' g",
        "What resists the motion?",
    ),
}


@pytest.mark.parametrize(("id", "after", "said"), FALSE.values(), ids=FALSE)
def test_false_steps_are_named_in_the_words_of_any_mechanism(id, after, said):
    before = proof.lines_of("m", friction=id != "E")[0].model[:5]
    line = marked(f"m-{id}", [*before, (f"= {after}", MOTION)]).lines[-1]
    assert said in line.said
    assert "gravity" not in line.said
    assert "torque" not in line.said


def test_energy_is_not_enough_and_what_is_to_be_proved_is_not_given():
    (one,), (other,) = (
        marked("m-skew", [("= 0", reason)]).lines for reason in ("energy balance", "skew-symmetry")
    )
    assert one.said.startswith("Energy does not give this.")
    assert other.said == '"skew-symmetry" is what is to be proved; here it is assumed.'


@pytest.mark.parametrize("id", OF_ANY)
def test_what_the_names_mean_gives_no_definition_away(id):
    shown = card.text(marked(f"cart-pole-{id}", []))
    assert "gravity and springs" in shown
    assert "∂P" not in shown
    assert OF_ANY[id].goal not in shown or len(OF_ANY[id].goal) < 3
