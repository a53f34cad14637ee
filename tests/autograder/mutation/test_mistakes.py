"""Every mistake that follows from a mechanism is named by its own sentence; right answers by none."""

import re

import numpy as np
import pytest
import sympy as sp

from autograder.judging.check import VISIBLE_CASES
from autograder.mechanisms import MECHANISMS, Coordinate, EnergyTerm, Mechanism, Parameter
from autograder.mutation import operators
from autograder.mutation.answers import ANSWERS
from autograder.mutation.answers.answer import states
from autograder.mutation.checks import check_of
from autograder.mutation.composed import catalogue_of
from autograder.mutation.mistakes import mistakes_of
from autograder.mutation.sentences import GENERAL, OF_A_TERM, OF_COLUMNS, ROWS, THROUGHOUT
from autograder.mutation.steps import STEPS
from autograder.protocol import Reply, read, real

PHI, S = Coordinate("phi", "rad", "the arm level"), Coordinate("s", "m", "the spring loose")
R, MASS = (
    Parameter("r", "m", "to the slider", 0.3, 0.8),
    Parameter("m", "kg", "the slider", 1.0, 2.0),
)
AT = R.symbol + S.symbol
# A slider on an arm, which is at a sum of two lengths.
SLIDER = Mechanism(
    "slider-on-arm",
    (PHI, S),
    (R, MASS, Parameter("g", "m/s²", "gravity", 9.0, 10.0)),
    (EnergyTerm("the slider", MASS.symbol * (S.velocity**2 + AT**2 * PHI.velocity**2) / 2),),
    (
        EnergyTerm(
            "the weight", MASS.symbol * sp.Symbol("g", positive=True) * AT * sp.sin(PHI.symbol)
        ),
    ),
    lambda q, arm: [(0.0, 0.0), (arm.r + q[1], 0.0)],
)
# All answers of some; of each other mechanism a few answers, so that each answer comes with several.
ALL = ("pendulum", "planar-2r", "cart-pole", "turn-and-slide")
OTHERS = 5
ASKED = [
    (m, answer)
    for i, m in enumerate(MECHANISMS.values())
    for k, answer in enumerate(ANSWERS)
    if m.name in ALL or (i + k) % OTHERS == 0
]
ASKED += [(SLIDER, answer) for answer in ("M", "g_vec", "C")]
# Where several mistakes differ in a detail: two lengths beside an inertia, friction of two joints.
ASKED += [(MECHANISMS["planar-2r-beside"], "M"), (MECHANISMS["furuta"], "f")]
EVERY = pytest.mark.parametrize(
    ("mechanism", "answer"), ASKED, ids=[f"{m.name}-{a}" for m, a in ASKED]
)


def judged(check, function, seed=0, count=VISIBLE_CASES):
    def ask(calls):
        return [Reply(value=read(call, function(*map(real, call.args)))) for call in calls]

    return check.run(ask, np.random.default_rng(seed), count)


@EVERY
def test_no_two_mistakes_have_the_same_numbers_or_one_name(mechanism, answer):
    """To a fresh draw, so that what was taken for two is two."""
    names = [mistake.name for mistake in mistakes_of(mechanism, answer)]
    assert len(set(names)) == len(names)
    asked = ANSWERS[answer]
    calls = [call.args for call in asked.calls(mechanism, np.random.default_rng(11), 1)]
    catalogue = catalogue_of(mechanism, answer)
    composed = asked.composition
    columns = composed(mechanism).columns(calls) if composed else states(calls)
    numbers = np.concatenate([catalogue.numbers(*columns), catalogue.right(*columns)[None]])
    if not asked.shape(mechanism.n):  # of an energy only its changes count
        numbers = numbers[:, 1:] - numbers[:, :-1]
    flat = numbers.reshape(len(numbers), -1)
    flat = flat[np.isfinite(flat).all(axis=1)]
    for i, own in enumerate(flat[1:], 1):
        apart = np.max(np.abs(flat[:i] - own), axis=1)
        assert apart.min() > 1e-9 * np.max(np.abs(own), initial=1.0), catalogue.mutants[
            i % len(flat)
        ]


def test_two_mistakes_at_once_are_both_named():
    mechanism = MECHANISMS["planar-2r"]
    check, catalogue = check_of(mechanism, "M"), catalogue_of(mechanism, "M")
    places = {(m.operator, m.term, m.entry): k for k, m in enumerate(catalogue.mutants)}
    first = places["dropped", "the rotation of link 1", ""]
    second = places["wrong sign", "the coupling of the two links", "M11"]
    known = mistakes_of(mechanism, "M")

    def wrong(q, arm):
        right = check.reference(q, arm)
        return known[first].wrong(q, arm) + known[second].wrong(q, arm) - right

    assert set(judged(check, wrong).diagnosis) == {known[first].sentence, known[second].sentence}


def test_a_length_forgotten_in_a_sum_and_a_sum_squared_part_by_part_are_named():
    check = check_of(SLIDER, "M")

    def of(inertia):
        return lambda q, arm: np.diag([arm.m * inertia(arm.r, q[1]), arm.m])

    assert judged(check, of(lambda r, s: (r + s) ** 2)).credit == 1
    assert judged(check, of(lambda r, s: s**2)).diagnosis == (
        "In your M, r is missing from a sum in the slider. Which lengths add up there?",
    )
    (said,) = judged(check, of(lambda r, s: r**2 + s**2)).diagnosis
    assert said.startswith("In your M, you squared r and s one by one in the slider.")


def test_every_operator_and_step_has_a_sentence():
    made = {mutant.operator for m, answer in ASKED for mutant in catalogue_of(m, answer).mutants}
    steps = {name for of in STEPS.values() for name in of}
    assert made <= GENERAL.keys()
    assert GENERAL.keys() <= made | steps
    others = THROUGHOUT.keys() | OF_A_TERM.keys() | OF_COLUMNS.keys()
    assert others | {row.operator for row in ROWS} <= GENERAL.keys()
    assert len(operators.OPERATORS) <= len(made)


@pytest.mark.parametrize(
    "template",
    [s for of in (GENERAL, THROUGHOUT, OF_A_TERM, OF_COLUMNS) for s in of.values()]
    + [row.sentence for row in ROWS],
)
def test_a_sentence_holds_no_formula(template):
    """No product or function of parameters: the names of the parameters come alone."""
    assert not re.search(r"\{\w+\}\s*[*·+/^²]", template)
    assert not re.search(r"\b[mIlg](c)?[12]\b|cos\(|sin\(", template)


@pytest.mark.parametrize(
    ("mechanism", "answer", "wrong", "said"),
    [
        (
            "cart-pole",
            "g_vec",
            lambda q, arm: [0.0, -arm.m * arm.g * arm.lc * np.cos(q[1])],
            "has a cosine where a sine belongs",
        ),
        (
            "planar-2r",
            "g_vec",
            lambda q, arm: [
                (arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.sin(q[0])
                + arm.m2 * arm.lc2 * arm.g * np.sin(q[0] + q[1]),
                arm.m2 * arm.lc2 * arm.g * np.sin(q[0] + q[1]),
            ],
            "Your g has sines where cosines belong",
        ),
        (
            "cart-pole",
            "g_vec",
            lambda q, arm: [0.0, -(arm.m + arm.mc) * arm.g * arm.lc * np.sin(q[1])],
            "adds mc to m",
        ),
        (
            "planar-2r",
            "M",
            lambda q, arm: right_M(q, arm) / (1 + np.eye(2)),
            "In your M11, every value",
        ),
    ],
)
def test_what_a_student_did_is_said_as_the_student_sees_it(mechanism, answer, wrong, said):
    """In g a cosine for a sine is that, though P then has a sine for a cosine."""
    (first, *_) = judged(check_of(MECHANISMS[mechanism], answer), wrong).diagnosis
    assert said in first


def right_M(q, arm):
    return check_of(MECHANISMS["planar-2r"], "M").reference(q, arm)


def test_what_is_0_earns_nothing_by_itself():
    check = check_of(MECHANISMS["cart-pole"], "g_vec")
    assert judged(check, lambda q, arm: [0.0, 0.0]).credit == 0


def test_a_teachers_row_is_said_where_it_fits_best():
    said = {
        (m.operator, m.term, m.entry): mistake.sentence
        for m, mistake in zip(
            catalogue_of(MECHANISMS["planar-2r"], "M").mutants,
            mistakes_of(MECHANISMS["planar-2r"], "M"),
            strict=True,
        )
    }
    own = said["dropped", "the rotation of link 2", "M11"]
    assert "Hold joint 2 and move joint 1" in own
    general = said["dropped", "the coupling of the two links", "M11"]
    assert "Hold joint 2" not in general
    assert "products of two velocities" in general
