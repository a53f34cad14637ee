"""Right answers to every check are right at any seed, in any form, however found; no others are."""

from dataclasses import replace

import numpy as np
import pytest

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.mutation.styles import STYLES
from autograder.notebook.grade import is_judged, stream
from autograder.notebook.sitting import Sitting
from autograder.problems import CHECKS
from autograder.protocol import Reply, real
from tests.autograder.course_problems import NAMES, problem
from tests.autograder.problems.tables import gathered
from tests.autograder.seeds import A_THOUSAND
from tests.autograder.verdicts import assert_right, function_of, judged_in, namespace_of

RIGHT, DELICATE = gathered("right", "RIGHT"), gathered("right", "DELICATE")
# Their references give no numbers that could be put in another form.
OF_SYMBOLS, OF_PARTS = ("p2-christoffel", "p3-lagrangian"), ("p1-singular_arm", "c7-terms")
OF_TRUTH = ("p1-is_spd",)
NUMBERS = [id for id in RIGHT if id not in (*OF_SYMBOLS, *OF_PARTS, *OF_TRUTH)]
# Of these only every so manieth seed is tried, as each takes its time.
EVERY = {
    "p2-christoffel": 5,
    "p5-rk4_step": 2,
    "p5-simulate": 8,
    "c6-rank_of_excitation": 2,
    "c7-rnea": 3,
    "c8-slotine_li": 8,
}


def namespace_with(check_id, answer):
    """answer: a function, its body, or what it returns."""
    return {CHECKS[check_id].name: answer} if callable(answer) else namespace_of(check_id, answer)


@pytest.mark.parametrize(
    ("check_id", "k"), [(check_id, k) for check_id in RIGHT for k in range(len(RIGHT[check_id]))]
)
def test_right_however_it_is_found(check_id, k):
    namespace = namespace_with(check_id, RIGHT[check_id][k])
    for seed, count in ((1, HIDDEN_CASES), (2, VISIBLE_CASES)):
        assert_right(judged_in(namespace, check_id, seed, count))


def in_form(check_id, form):
    reference = CHECKS[check_id].reference
    return {CHECKS[check_id].name: lambda *args: form(reference(*args))}


# The protocol reads a form, the same for all checks: each meets a third of them, and each check some.
PAIRS = [
    pytest.param(check_id, form, marks=[pytest.mark.long] if (k + j) % 3 else [])
    for k, check_id in enumerate(NUMBERS)
    for j, form in enumerate(STYLES)
]


@pytest.mark.parametrize(("check_id", "form"), PAIRS)
def test_right_in_any_form(check_id, form):
    assert_right(judged_in(in_form(check_id, STYLES[form]), check_id, 1, VISIBLE_CASES))


def test_ten_styles_at_least():
    assert RIGHT.keys() == {id for id in CHECKS if not id.startswith("start")}, (
        "each check needs right answers in tests/autograder/problems/FOLDER/right.py"
    )
    for check_id, found in RIGHT.items():
        assert len(found) >= 4
        assert len(found) + (len(STYLES) if check_id in NUMBERS else 0) >= 10, check_id


@A_THOUSAND
@pytest.mark.parametrize("check_id", [id for id in RIGHT if id in (*NUMBERS, *DELICATE)])
def test_no_false_alarm_over_a_thousand_seeds(check_id, seeds):
    """In single precision, which is the harder one; every fifth seed in double, too."""
    double = in_form(check_id, lambda value: value)
    always = [namespace_with(check_id, answer) for answer in DELICATE.get(check_id, ())]
    if check_id in NUMBERS:
        always.append(in_form(check_id, np.float32))
    for seed in seeds[:: EVERY.get(check_id, 1)]:
        for namespace in [*always, *([double] if check_id in NUMBERS and seed % 5 == 0 else [])]:
            verdict = judged_in(namespace, check_id, seed, VISIBLE_CASES)
            assert verdict.state is State.CORRECT, f"seed {seed}: {verdict}"


# Small whole numbers, and zeros.
COUNTED = ("c6-rank_of_excitation", "c7-gravity_sign", "p3-C")
# What is left where all is wrong by a little: Ṁ22 is 0, and stays so; an arm in closed loop arrives.
SPARED = {"p2-M_dot": 0.1, "c8-gravity_compensation": 0.25, "c8-slotine_li": 0.35}
MEASURED = pytest.mark.parametrize("check_id", [id for id in NUMBERS if id not in COUNTED])


@MEASURED
def test_a_rounded_constant_is_no_mistake(check_id):
    known = {mistake.sentence for mistake in CHECKS[check_id].known_mistakes}
    rounded = in_form(check_id, lambda value: 1.0001 * np.asarray(value))
    verdict = judged_in(rounded, check_id, 1, VISIBLE_CASES)
    assert known.isdisjoint(verdict.diagnosis)


def judged_spoilt(check_id, spoilt, seed):
    """The right numbers, changed; what is said of them is not asked for."""
    check = replace(CHECKS[check_id], mistakes=(), catalogue=None, terms=())

    def ask(calls):
        right = (np.array(check.reference(*map(real, call.args)), float) for call in calls)
        return [Reply(value=spoilt(value)) for value in right]

    return check.run(ask, np.random.default_rng(seed), VISIBLE_CASES)


@MEASURED
@pytest.mark.parametrize("every", [5, pytest.param(1, marks=pytest.mark.long)])
def test_one_entry_wrong_by_1e_4_fails_at_any_seed(check_id, every):
    """Each entry, by 1e-4 of the largest: also one that is 0; each at other seeds of ten."""

    def spoilt(value):
        largest = value.flat[np.argmax(np.abs(value))]
        value.flat[place % value.size] += 1e-4 * largest
        return value

    for place in range(14):
        for seed in range(place % every, 10, every * EVERY.get(check_id, 1)):
            verdict = judged_spoilt(check_id, spoilt, seed)
            assert verdict.state is not State.CORRECT, (place, seed)


@MEASURED
def test_all_wrong_by_1e_4_earns_nothing(check_id):
    left = SPARED.get(check_id, 0)
    for seed in range(20):
        credit = judged_spoilt(check_id, lambda value: 1.0001 * value, seed).credit
        assert credit == pytest.approx(left), seed


LIBRARIES = "import sympy as sp, scipy, scipy.linalg, scipy.optimize\n"


@pytest.mark.parametrize("name", [name for name in NAMES if name != "p5-state-space"])
def test_right_through_the_room_and_its_wall(name):
    """An answer of SymPy's objects, and the last way of each check."""
    given = problem(name)
    with Sitting() as sitting:
        for cell in given.release.cells:
            if cell.cell_type == "code" and not is_judged(cell):
                sitting.run(cell.source)
        for check_id in given.submissions.POINTS:
            *others, last = RIGHT[check_id]
            for body in [*[body for body in others if "sp." in body][:1], last]:
                sitting.run(LIBRARIES + function_of(check_id, body))
                verdict = CHECKS[check_id].run(sitting.ask, stream("seed", check_id), VISIBLE_CASES)
                assert verdict.state is State.CORRECT, f"{body}\n{verdict}"
