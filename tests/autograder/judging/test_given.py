"""What the card says of calls without numbers: which failed, how many, and which work."""

import re
from dataclasses import replace

import numpy as np
import pytest

from autograder.judging.check import VISIBLE_CASES
from autograder.judging.partial import is_finite
from autograder.judging.passages import failing
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.protocol import FaultKind, Reply, answer, calls, limits
from tests.autograder.problems.tables import gathered
from tests.autograder.verdicts import function_of, judged, namespace_of, verdict_of

ASKED = {"p1-M": 12, "p1-is_spd": 17, "p4-equilibria": 2}


def shown(check_id: str, body: str):
    verdict = judged(check_id, body, count=VISIBLE_CASES)
    assert verdict.state is State.ERROR
    assert verdict.credit == 0
    return verdict


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p1-M", "np.ones((2, 3))"),
        ("p1-M", "q[2] * np.ones((2, 2))"),
        ("p1-M", "None"),
        ("p1-M", "'M'"),
        ("p1-M", "np.full((2, 2), np.nan)"),
        ("p1-is_spd", "A > 0"),
        ("p1-is_spd", "0.5"),
        ("p4-equilibria", "np.zeros(3)"),
        ("p3-lagrangian", "q / 0"),
        ("p4-potential_energy", "q"),
        ("p5-simulate", "x0"),
    ],
)
def test_every_call_fails(check_id, body):
    failed = shown(check_id, body).failed
    made = CHECKS[check_id].calls(np.random.default_rng(0), VISIBLE_CASES)
    assert failed.tried == failed.count == len(made) == ASKED.get(check_id, len(made))
    assert failed.works == ""
    assert failed.of.name == CHECKS[check_id].name
    assert failed.call.startswith((f"{failed.of.name}(", f"sp.Matrix({failed.of.name}("))


@pytest.mark.parametrize(
    "bad",
    ["1 / 0", "None", "'g'", "np.nan", "np.ones(2)"],
)
def test_some_calls_fail_and_one_that_works_is_shown(bad):
    """Of g_vec(q, pend): those with a positive q."""
    body = f"if q[0] > 0:\n    return {bad}\nreturn 1.0"
    verdict = shown("p3-g_vec", body)
    made = CHECKS["p3-g_vec"].calls(np.random.default_rng(0), VISIBLE_CASES)
    bad_ones = [call for call in made if call.args[0][0] > 0]
    failed = verdict.failed
    assert 0 < failed.count < failed.tried == len(made)
    assert failed.count == len(bad_ones)
    np.testing.assert_array_equal(failed.of.args[0], bad_ones[0].args[0])
    if bad != "np.nan":  # which says itself where it came
        (q,) = map(float, re.findall(r"np\.array\(\[(.*?)\]", failed.works))
        assert q < 0
    assert verdict.lines()[1] == failing(failed)[0].text


def test_where_arguments_are_long_the_shapes_tell_which_calls_work():
    verdict = shown("p1-inertia_from_links", "return jacobians[1].T @ inertias[1] @ jacobians[1]")
    assert verdict.failed.call == "inertia_from_links(jacobians, inertias)"
    assert re.search(r"# jacobians \(1, 6, \d\), inertias \(1, 6, 6\)$", verdict.failed.given_by)
    assert re.search(r"# jacobians \([23], 6, \d\), inertias \([23], 6, 6\)$", verdict.failed.works)


def test_a_call_that_never_returns_is_shown_and_no_other_is_made(monkeypatch):
    namespace = {"__name__": "__main__", "made": []}
    source = function_of("p3-g_vec", "made.append(q)\nwhile len(made) > 1: pass\nreturn 1.0")
    exec(source, namespace)
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.2)
    monkeypatch.setattr(limits, "PATIENCE", 1000.0)
    verdict = CHECKS["p3-g_vec"].run(
        lambda asked: calls.answer_all(asked, namespace), np.random.default_rng(0), VISIBLE_CASES
    )
    assert "did not return within 0.2 s" in verdict.problem
    assert len(namespace["made"]) == 2
    np.testing.assert_array_equal(verdict.failed.of.args[0], namespace["made"][1])
    assert verdict.lines()[1].startswith("The check stopped at this call: g_vec(np.array([")


def test_no_call_is_shown_where_none_was_made():
    check = CHECKS["p3-g_vec"]
    for namespace in ({}, {"g_vec": 3.0}):
        verdict = check.run(
            lambda asked, own=namespace: [answer(asked[0], own)], np.random.default_rng(0)
        )
        assert verdict.state is State.ERROR
        assert verdict.failed is None


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("np.eye(2) * q", "Did you multiply a matrix and a vector by *?"),
        ("np.ones((2, 3))", ""),
        ("np.ones(3)", ""),
    ],
)
def test_a_matrix_where_a_vector_belongs_is_asked_after(body, said):
    problem = shown("p4-g_vec", body).problem
    assert "it must return shape (2,)" in problem
    assert ("by *?" in problem) == bool(said)
    assert said in problem


def test_an_array_where_one_truth_value_belongs():
    assert shown("p1-is_spd", "A > 0").problem == (
        "is_spd(A) returned 4 values, in shape (2, 2); it must return one, True or False. Must all of "
        "them hold (np.all), or is one enough (np.any)?"
    )


def test_a_forged_fault_gets_no_more_than_a_fault():
    """Fewer replies than calls, the last of them a fault, as the sandbox sends them."""
    check = CHECKS["p3-g_vec"]

    def ask(asked):
        fault = calls.Fault(FaultKind.RAISED, "ValueError: x")
        return [Reply(value=np.array(check.reference(*asked[0].args))), Reply(fault=fault)]

    verdict = check.run(ask, np.random.default_rng(0), VISIBLE_CASES)
    assert (verdict.state, verdict.credit) == (State.ERROR, 0)
    assert verdict.failed.tried == 0


SHAPES = ((), (0,), (1,), (2,), (3,), (4,), (9,), (2, 2), (1, 2), (6, 2), (2, 3, 4))
PARTS = ({}, [], {"l1": np.array(1.0)}, [{"l1": np.array([np.nan])}, np.array(0.0)])


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
def test_nothing_that_came_back_is_the_fault_of_the_check(check):
    """Whatever the shape and whatever the numbers: it is the answer that is wrong."""
    whole = [np.full(shape, number) for shape in SHAPES for number in (1.0, np.nan)]
    parts = [*PARTS, *whole[:8]]  # as only a forged reply to most calls can be
    if check.id != "p1-singular_arm":
        parts = [*PARTS[:1], *whole]
    made = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    for k, value in enumerate(parts):
        other = parts[(7 * k + 3) % len(parts)]
        for values in (len(made) * [value], [value, *(len(made) - 1) * [other]]):

            def ask(asked, values=values):
                return [Reply(value=value) for value in values][: len(asked)]

            verdict = replace(check, catalogue=None, mistakes=(), terms=()).run(
                ask, np.random.default_rng(0), VISIBLE_CASES
            )
            assert verdict.state is not State.CHECK_FAILED, (value, other, verdict.problem)
            if verdict.state is State.CORRECT:
                assert all(map(is_finite, values))


RIGHT = gathered("right", "RIGHT")


def nowhere_finite(value):
    match value:
        case tuple([dict(arm), q]):
            return arm | {"I2": np.nan}, q
        case list() | tuple():
            return np.full(np.shape(value), np.nan)
        case bool():
            return np.nan
    return value * np.nan


@pytest.mark.parametrize(
    "spoil",
    [lambda value: 1 / 0, lambda value: None, nowhere_finite],
    ids=["error", "nothing", "NaN"],
)
@pytest.mark.parametrize("check_id", RIGHT)
def test_of_every_check_the_one_call_that_fails_is_shown(check_id, spoil):
    """And where it gave numbers, the criteria that have nothing to do with it keep their credit."""
    check = CHECKS[check_id]
    given, made = RIGHT[check_id][0], []
    right = given if callable(given) else namespace_of(check_id, given)[check.name]

    def spoilt_once(*args):
        made.append(args)
        value = right(*args)
        return spoil(value) if len(made) == 1 else value

    verdict = verdict_of(check, {check.name: spoilt_once}, count=VISIBLE_CASES)
    failed = verdict.failed
    assert failed.count == 1
    again = spoil is nowhere_finite and len(made) > failed.tried  # to hear where NumPy warns
    if again and any(criterion.in_loop for criterion in check.criteria):
        # A run is one of them, however many steps it has.
        assert failed.tried == len(check.calls(np.random.default_rng(0), VISIBLE_CASES))
    else:
        assert failed.tried == len(made) - again
    assert failed.of.name == check.name
    assert any(failed.call in own.text + own.code for own in failing(failed))
    assert (failed.given_by == "") == (check.signature == f"{check.name}()")
    assert verdict.credit == sum(row.share for row in verdict.rows if row.met) < 1
    if spoil is not nowhere_finite:
        assert verdict.state is State.ERROR
    elif check_id in ("c6-rank_of_excitation", "c6-identify", "p5-rk4_step", "p5-energy_drift"):
        assert verdict.credit > 0  # each of their criteria is about other calls


ROOT_IN_AN_ENTRY = """A = sp.ones(len(q), len(q))
if len(q) > 1:
    A[1, 0] = sp.sqrt(-1 - q[0]**2)
return A"""


@pytest.mark.parametrize(
    ("check_id", "body", "found"),
    [
        ("p3-lagrangian", "I*qd**2/2 + m*g*lc*sp.sqrt(q)", "nan"),
        ("p3-lagrangian", "I*sp.log(qd)", "-inf"),
        ("p2-christoffel", ROOT_IN_AN_ENTRY, "nan at [1, 0]"),
    ],
)
def test_an_expression_that_has_no_number_is_shown_where_it_has_none(check_id, body, found):
    """Its place is counted in the expression, and the call that is shown gives it."""
    verdict = shown(check_id, body)
    assert f" returned {found}, which" in verdict.problem
    (point,) = verdict.failed.of.at
    numbers = answer(verdict.failed.of, namespace_of(check_id, body)).value
    assert not np.all(np.isfinite(numbers))
    assert all(f": {float(f'{value:.6g}')!r}" in verdict.failed.call for value in point.values())
