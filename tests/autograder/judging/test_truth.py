"""No sentence is false: whatever random wrong answers are, what the card says holds of their numbers."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.criterion import Criterion
from autograder.judging.models import evaluated
from autograder.judging.places import NOWHERE
from autograder.judging.witness import has_share, witness
from autograder.problems import CHECKS
from autograder.problems.material import planar_2r
from autograder.problems.material.definiteness import (
    MATRICES,
    ROUNDING,
    Kind,
    is_symmetric,
    least_eigenvalue,
)
from autograder.problems.material.systems import FreeRun
from autograder.problems.p1_inertia.checks import PARAMETERS
from autograder.protocol import Call, Reply
from tests.autograder.verdicts import sentences

SEED = 7


def diagnosis(check: Check, values: list) -> tuple[str, ...]:
    """What is said of these values; to what is asked afterwards there is no reply."""
    replies = iter([[Reply(value=value) for value in values]])
    rng = np.random.default_rng(SEED)
    return check.run(lambda calls: next(replies, []), rng, VISIBLE_CASES).diagnosis


def calls_of(check: Check) -> list[Call]:
    return check.calls(np.random.default_rng(SEED), VISIBLE_CASES)


# Whether a matrix is accepted: what people ask of it, right or wrong.
TESTS = (
    lambda A: True,
    is_symmetric,
    lambda A: np.array_equal(A, A.T),
    lambda A: np.all(A > 0),
    lambda A: np.all(np.diag(A) > 0),
    lambda A: A[0, 0] > 0,
    lambda A: np.trace(A) > 0,
    lambda A: np.linalg.det(A) > 0,
    lambda A: np.linalg.det(A) != 0,
    lambda A: np.linalg.cond(A) < 1e9,
    lambda A: least_eigenvalue(A) > ROUNDING,
    lambda A: np.linalg.eigvalsh(A)[0] > -1e-12,
    lambda A: np.linalg.eigvalsh(A)[-1] > 0,
    lambda A: np.all(np.linalg.eigvals(A).real > 0),
    lambda A: len(A) < 4,
)
IS_SPD = CHECKS["p1-is_spd"]


def spd_claims() -> dict:
    """Of what answers each sentence is true. kinds, A and said: of the matrices tried, in order."""

    def accepts(which):
        return lambda kinds, A, said: any(
            s for k, a, s in zip(kinds, A, said, strict=True) if which(k, a)
        )

    def accepts_every(which):
        return lambda kinds, A, said: all(
            s for k, a, s in zip(kinds, A, said, strict=True) if which(k, a)
        )

    def refuses(which):
        return lambda kinds, A, said: not accepts_every(which)(kinds, A, said)

    def last_digit(kinds, A, said):
        every = accepts_every(lambda k, a: k is Kind.DEFINITE)(kinds, A, said)
        return every and not accepts(lambda k, a: k is Kind.ROUNDED)(kinds, A, said)

    def symmetric(k, a):
        return np.array_equal(a, a.T)

    skewed = accepts(lambda k, a: k is Kind.SKEWED)

    def skewed_by(test):
        """Accepted where this holds, of those that are not symmetric."""
        return lambda kinds, A, said: all(
            s == test(a) for k, a, s in zip(kinds, A, said, strict=True) if k is Kind.SKEWED
        )

    claims = {
        "zero eigenvalue accepted": accepts(
            lambda k, a: k is Kind.SEMIDEFINITE and np.linalg.matrix_rank(a) < len(a)
        ),
        "rounding taken for a positive eigenvalue": accepts(
            lambda k, a: k is Kind.SEMIDEFINITE and np.all(a.any(axis=0))
        ),
        "exact symmetry": last_digit,
        "symmetry alone": accepts_every(symmetric),
        "diagonal alone": accepts_every(lambda k, a: symmetric(k, a) and np.all(np.diag(a) > 0)),
        "determinant of a symmetric matrix": accepts(
            lambda k, a: symmetric(k, a) and np.sum(np.linalg.eigvalsh(a) < -1e-9) == 2
        ),
        "entries positive": refuses(
            lambda k, a: k in (Kind.DEFINITE, Kind.ROUNDED) and np.any(a <= 0)
        ),
        "one positive eigenvalue": accepts_every(
            lambda k, a: symmetric(k, a) and np.linalg.eigvalsh(a)[-1] > 0
        ),
        "eigenvalues of one sign": accepts(
            lambda k, a: symmetric(k, a) and np.linalg.eigvalsh(a)[-1] < 0
        ),
        "one triangle read": skewed_by(lambda a: np.linalg.eigvalsh(a)[0] > 0),
        "eigenvalues of any matrix": skewed_by(lambda a: np.all(np.linalg.eigvals(a).real > 0)),
        "symmetric part only": skewed_by(lambda a: np.linalg.eigvalsh(a + a.T)[0] > 0),
        "determinant alone": accepts(lambda k, a: np.linalg.det(a) > 0),
        "always True": lambda kinds, A, said: all(said),
        "always False": lambda kinds, A, said: not any(said),
        "answer reversed": lambda kinds, A, said: all(
            s != (k in (Kind.DEFINITE, Kind.ROUNDED)) for k, s in zip(kinds, said, strict=True)
        ),
    }
    found = {sentences("p1-is_spd", name)[0]: holds for name, holds in claims.items()}
    for start, holds in (
        ("You refuse a matrix that is symmetric and positive", refuses(lambda k, a: k is Kind.DEFINITE)),
        ("You refuse a matrix that is positive", refuses(lambda k, a: k is Kind.ROUNDED)),
        ("You accept a symmetric matrix that has a negative", accepts(
            lambda k, a: symmetric(k, a) and np.linalg.eigvalsh(a)[0] < -1e-9)),
        ("You accept a matrix whose smallest", accepts(lambda k, a: k is Kind.SEMIDEFINITE)),
        ("You accept a matrix that is not", skewed),
    ):  # fmt: skip
        texts = {s.text for c in IS_SPD.criteria for s in c.said if s.text.startswith(start)}
        (text,) = texts
        found[text] = holds
    return found


CLAIMS = spd_claims()


@given(
    st.lists(st.sampled_from(TESTS), min_size=1, max_size=3),
    st.lists(st.integers(0, len(MATRICES) - 1), max_size=2),
)
@settings(max_examples=150)
def test_what_is_said_of_is_spd_is_so(tests, spoilt):
    """Some tests all met, and some matrices answered the other way round."""
    matrices = [call.args[0] for call in calls_of(IS_SPD)]
    kinds = [kind for kind, _ in MATRICES]
    said = [all(test(A) for test in tests) ^ (place in spoilt) for place, A in enumerate(matrices)]
    found = diagnosis(IS_SPD, [np.array(float(own)) for own in said])
    right = [kind in (Kind.DEFINITE, Kind.ROUNDED) for kind in kinds]
    assert bool(found) == (said != right)
    for sentence in found:
        assert CLAIMS[sentence](kinds, matrices, said), sentence


RANK = CHECKS["c6-rank_of_excitation"]


@given(st.data())
def test_what_is_said_of_a_rank_is_so(data):
    """Of one motion, of all alike, of the number of samples, or any."""
    calls = calls_of(RANK)
    samples = [len(call.args[0]) for call in calls]
    right = [int(evaluated(RANK.reference, [call])[0]) for call in calls]
    drawn = data.draw(
        st.lists(st.integers(0, 6), min_size=len(calls), max_size=len(calls))
        | st.integers(0, 6).map(lambda n: [n] * len(calls))
        | st.integers(1, 6).map(lambda n: [min(2 * K, n) for K in samples])
        | st.integers(1, 6).map(lambda n: [min(r, n) for r in right])
        | st.integers(-2, 2).map(lambda n: [r + n for r in right])
    )
    found = diagnosis(RANK, [np.array(float(n)) for n in drawn])
    assert bool(found) == (drawn != right)
    (counted,) = sentences("c6-rank_of_excitation", "five")
    (one_state,) = sentences("c6-rank_of_excitation", "first sample")
    (of_samples,) = sentences("c6-rank_of_excitation", "number of samples")
    (smaller,) = sentences("c6-rank_of_excitation", "smaller of rows and columns")
    for sentence in found:
        if sentence == counted or "same for every motion" in sentence:
            assert len(set(drawn)) == 1, sentence
        elif sentence == one_state:
            assert max(drawn) <= 2
        elif sentence == of_samples:
            assert drawn == samples
        elif sentence == smaller:
            assert drawn == [min(2 * K, 6) for K in samples]


SINGULAR = CHECKS["p1-singular_arm"]
NUMBERS = st.sampled_from([-1.0, -0.25, 0.0, 0.0, 0.5, 1.0])


@given(
    st.fixed_dictionaries(dict.fromkeys(PARAMETERS, NUMBERS)), st.sampled_from([0.0, 1.0, np.pi])
)
@settings(max_examples=200)
def test_what_is_said_of_an_arm_is_so(parameters, q2):
    q = np.array([0.3, q2])
    arm = SimpleNamespace(**parameters, g=9.81)
    values = np.linalg.eigvalsh(planar_2r.M(q, arm))
    found = diagnosis(SINGULAR, [[{n: np.array(v) for n, v in vars(arm).items()}, q]])
    negative = min(parameters.values()) < 0
    for sentence in found:
        if "positive definite" in sentence:
            assert values[0] > 0, (sentence, values)
        if "I2 is not zero" in sentence:
            assert arm.I2 > 0
        if "not singular" in sentence:
            assert abs(np.prod(values)) > 1e-9 * max(np.abs(values)) ** 2
        if "M is singular, but" in sentence:
            assert abs(values[0] * values[1]) <= 1e-9 * max(np.abs(values), default=0.0) ** 2
        if "is negative" in sentence:
            assert negative
        if "has no mass" in sentence:
            assert 0 in (arm.m1, arm.m2)
        if "has no length" in sentence:
            assert 0 in (arm.l1, arm.l2)
        if "elbow bent" in sentence:
            assert abs(np.sin(q2)) > 1e-6


EQUILIBRIA = CHECKS["p4-equilibria"]
FOUR = [(-np.pi / 2, 0), (-np.pi / 2, np.pi), (np.pi / 2, 0), (np.pi / 2, np.pi)]
ANGLES = st.sampled_from([-np.pi / 2, 0.0, np.pi / 2, np.pi, 1.57, 0.5])
SOME = st.lists(st.sampled_from(FOUR), min_size=1, max_size=4)


@given(
    st.lists(st.tuples(ANGLES, ANGLES), min_size=1, max_size=5)
    | st.tuples(SOME, st.just((np.pi / 2, 0.5))).map(lambda both: [*both[0], both[1]])
    | SOME
    | st.just([*np.round(FOUR, 3), (0.3, 0.5)])
    | st.lists(st.sampled_from([FOUR, np.round(FOUR, 3)]), min_size=4, max_size=4).map(
        lambda some: [own[k] for k, own in enumerate(some)]
    )
)
@settings(max_examples=200)
def test_what_is_said_of_configurations_is_so(configurations):
    q = np.array(configurations)
    calls = calls_of(EQUILIBRIA)
    found = diagnosis(EQUILIBRIA, [q] * len(calls))
    directions = np.transpose([q[:, 0], q[:, 0] + q[:, 1]])
    off = np.max(np.abs(np.cos(directions)), axis=1)  # from upright and hanging, as a share
    rest = off < 1e-6
    near = {
        tuple(np.round(np.sin(own))) for own, far in zip(directions, off, strict=True) if far < 0.02
    }
    for sentence in found:
        if "are equilibria, but" in sentence or "Your answer holds only" in sentence:
            assert np.all(rest), sentence
        if "link 1 points up" in sentence:
            assert np.all(np.sin(q[:, 0]) > 0)
        if "link 1 hangs down" in sentence:
            assert np.all(np.sin(q[:, 0]) < 0)
        if "the arm is stretched" in sentence:
            assert np.all(np.abs(np.cos(q[:, 1]) - 1) < 1e-6)
        if "equilibrium is missing" in sentence:
            assert len(near) < 4
        if "needs a torque" in sentence:
            assert not np.all(rest)
        if "is not exact." in sentence:
            assert np.any((off > 0) & (off < 0.02))
        if "not exactly" in sentence:
            assert len(near) == 4
            assert 0 < np.max(off) < 0.02


MATRIX = replace(CHECKS["p1-M"], mistakes=(), catalogue=None, terms=())
WRONG = {
    "transposed": lambda M, rng: [m.T + np.array([[0, 0], [1, 0]]) for m in M],
    "scaled": lambda M, rng: [rng.uniform(0.5, 2) * m for m in M],
    "permuted": lambda M, rng: [rng.permutation(m.ravel()).reshape(2, 2) for m in M],
    "noisy": lambda M, rng: [m + rng.normal(0, 0.3, (2, 2)) for m in M],
    "symmetric and noisy": lambda M, rng: [m + rng.normal() * np.array([[0, 1], [1, 0]]) for m in M],
    "nearly right": lambda M, rng: [m * (1 + rng.uniform(-1e-3, 1e-3, (2, 2))) for m in M],
    "symmetric and nearly right": lambda M, rng: [m * (1 + rng.uniform(-1e-3, 1e-3)) for m in M],
    "constant": lambda M, rng: [M[0] for _ in M],
    "one number": lambda M, rng: [np.ones((2, 2)) for _ in M],
    "off the diagonal zero": lambda M, rng: [np.diag(np.diag(m)) for m in M],
    "of one case": lambda M, rng: [M[0] + 1, *M[1:]],
    "one case zero": lambda M, rng: [M[0] * 0, *(m + 0.1 for m in M[1:])],
}  # fmt: skip


@pytest.mark.parametrize("wrong", WRONG)
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30)
def test_what_is_found_in_numbers_is_so(wrong, seed):
    right = [evaluated(MATRIX.reference, [call])[0] for call in calls_of(MATRIX)]
    theirs = [np.asarray(m, dtype=float) for m in WRONG[wrong](right, np.random.default_rng(seed))]
    found = " ".join(diagnosis(MATRIX, theirs))
    apart = max(abs(m[0, 1] - m[1, 0]) / np.max(np.abs(m)) for m in theirs if np.any(m)) > 1e-4
    mixed = [np.max(np.abs((t - r)[[0, 1], [1, 0]])) for t, r in zip(theirs, right, strict=True)]
    assert not ("differ from each other" in found and not apart)
    if "In your M12 and M21, every value is 0" in found:
        assert not any(m[0, 1] or m[1, 0] for m in theirs)
    if "In your M12 and M21, the values are right to" in found:
        percent = float(found.partition("M21, the values are right to ")[2].partition(" %")[0])
        size = [abs(m[0, 1]) for m in right]
        least = [max(own, 0.05 * max(size)) for own in size]
        worst = max(e / own for e, own in zip(mixed, least, strict=True))
        assert worst <= percent / 100 * (1 + 1e-9) <= 1.0 * worst * 10


@given(st.floats(-10, 10), st.floats(-10, 10), st.floats(0, 10), st.booleans())
def test_a_share_is_told_where_the_right_value_is_not_near_zero(right, off, largest, is_bound):
    criterion = Criterion("torque", "N·m", is_bound=is_bound)
    largest = max(largest, abs(right))
    said = witness(
        Call("f", ()), "f()", np.array(right), np.array(right + off), criterion, largest, NOWHERE
    )
    error = abs(right + off - right)
    shares = not is_bound and error < 3 * abs(right) and abs(right) >= 0.05 * largest
    assert has_share(error, abs(right), largest, criterion) == shares
    assert ("of the right value" in said.off) == shares
    if shares:
        told = float(said.off.partition(" (")[2].partition(" %")[0])
        assert told == pytest.approx(100 * error / abs(right), abs=0.51, rel=0.06)


def test_an_answer_that_differs_from_call_to_call_is_called_so():
    rng = np.random.default_rng(1)

    def ask(calls):
        return [Reply(value=rng.normal(size=(2, 2)) + 3) for _ in calls]

    said = " ".join(MATRIX.run(ask, np.random.default_rng(SEED)).diagnosis)
    assert (
        "Called twice with the same arguments, your function does not return the same numbers"
        in said
    )
    assert "depend on" not in said


@pytest.mark.parametrize(
    "check_id", ["p1-is_spd", "p2-C_other", "p4-potential_energy", "p5-simulate", "c6-identify"]
)
def test_any_check_sees_what_differs_from_call_to_call(check_id):
    """Also one that compares calls with each other, or asks for truth values."""
    check = CHECKS[check_id]
    rng = np.random.default_rng(1)

    def ask(calls):
        right = [np.asarray(value, dtype=float) for value in evaluated(check.reference, calls)]
        if calls[0].truth:
            return [Reply(value=rng.integers(0, 2, value.shape).astype(float)) for value in right]
        return [Reply(value=value + rng.normal(size=value.shape)) for value in right]

    verdict = check.run(ask, np.random.default_rng(SEED))
    assert "Called twice with the same arguments" in " ".join(verdict.diagnosis)


@pytest.mark.parametrize(
    ("check_id", "spoil", "said"),
    [
        # Each is the sum of two mistakes' errors in one criterion, by chance, and not in the others.
        ("p1-M", lambda M: M + 1, ()),
        ("p4-g_vec", lambda g: g * [-1, 1], ("every value has the wrong sign",)),
        ("p4-g_vec", lambda g: g * [0, 1], ("every value is 0",)),
        ("p1-inertia_from_links", lambda M: 0 * M, ("every value is 0", "every value is 0")),
        ("p5-f", lambda x: 0 * x, ("every value is 0", "every value is 0")),
        ("c6-regressor", lambda Y: 0 * Y, ("every value is 0",) * 5),
    ],
)
def test_two_mistakes_that_add_up_by_chance_are_not_named(check_id, spoil, said):
    check = CHECKS[check_id]
    right = [np.asarray(evaluated(check.reference, [call])[0], float) for call in calls_of(check)]
    found = diagnosis(check, [spoil(value) for value in right])
    assert len(found) == len(said)
    assert all(own in sentence for own, sentence in zip(said, found, strict=True)), found


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda states: 0 * states + states[0], "does not come near the state where it should end"),
        (lambda states: 1.01 * states, "Yours changes it by more than RK4 would"),
    ],
)
def test_the_energy_of_a_run_is_judged_where_it_ends_near_its_end(spoil, said):
    check = replace(CHECKS["p5-simulate"], mistakes=())
    calls = calls_of(check)
    values = [np.asarray(evaluated(check.reference, [call])[0], float) for call in calls]
    free = [k for k, call in enumerate(calls) if isinstance(call, FreeRun)]
    found = diagnosis(check, [spoil(v) if k in free else v for k, v in enumerate(values)])
    assert len(free) == 4
    assert any(said in sentence for sentence in found), found
    assert sum("free motion" in sentence for sentence in found) == 1
