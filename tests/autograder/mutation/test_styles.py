"""No false alarm: a right answer of any mechanism is right at every seed, in whatever form it comes."""

import mpmath
import numpy as np
import pytest
import sympy as sp

from armdyn.derive import christoffel_symbols
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.styles import STYLES
from autograder.protocol import Reply, read, real
from tests.autograder.seeds import A_THOUSAND

ASKED = [(m, answer) for m in MECHANISMS.values() for answer in ANSWERS]
EVERY = pytest.mark.parametrize(
    ("mechanism", "answer"), ASKED, ids=[f"{m.name}-{a}" for m, a in ASKED]
)
# What follows in one or two derivatives.
DERIVED = [(m, a) for m, a in ASKED if a in ("M", "C", "g_vec", "potential_energy")]


def assert_right(check, function, seed):
    def ask(calls):
        return [Reply(value=read(call, function(*map(real, call.args)))) for call in calls]

    verdict = check.run(ask, np.random.default_rng(seed), VISIBLE_CASES)
    assert verdict.state is State.CORRECT, (seed, str(verdict))


@EVERY
@A_THOUSAND
def test_right_at_every_seed_in_one_form_after_the_other(mechanism, answer, seeds):
    """In single precision, which is the hardest, at each of them."""
    check, styles = check_of(mechanism, answer), list(STYLES.items())
    tried = seeds if len(seeds) == 1000 else seeds[: len(styles)]
    for k, seed in enumerate(tried):
        name, style = styles[k % len(styles)]
        for given in (style, np.float32):
            try:
                assert_right(check, lambda *args, given=given: given(check.reference(*args)), seed)
            except AssertionError as error:
                raise AssertionError(f"{check.id}, {name}: {error}") from None


def test_ten_forms_at_least():
    assert len(STYLES) >= 10


@pytest.mark.parametrize(
    ("mechanism", "answer"), DERIVED, ids=[f"{m.name}-{a}" for m, a in DERIVED]
)
def test_derived_from_expanded_energies_in_many_digits(mechanism, answer):
    """Other expressions, whose sums run in another order, evaluated by mpmath."""
    m = mechanism
    M = sp.hessian(sp.expand(sp.expand_trig(m.K)), m.qd)
    P = sp.expand(sp.expand_trig(m.P)) + 7
    if answer == "C":
        h = christoffel_symbols(M, m.q)
        wanted = [
            [sum(h[i, j, k] * m.qd[k] for k in range(m.n)) for j in range(m.n)] for i in range(m.n)
        ]
    else:
        wanted = {"M": M.tolist(), "g_vec": [P.diff(x) for x in m.q], "potential_energy": P}[answer]
    names = [p.symbol for p in m.parameters]
    compute = sp.lambdify([m.q, m.qd, names], wanted, modules="mpmath")

    def theirs(q, *rest):
        *velocities, arm = rest
        qd = velocities[0] if velocities else 0 * q
        values = ([*map(mpmath.mpf, x)] for x in (q, qd, [getattr(arm, s.name) for s in names]))
        return compute(*values)

    assert_right(check_of(mechanism, answer), theirs, seed=3)
