"""Lines as people and attackers type them: one notation, in bounded time, and nothing runs."""

import time
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.proofs import DERIVATIONS, mark, marking
from autograder.proofs.energy import FREE
from autograder.proofs.parsing import LineError, relation_and_sides
from autograder.proofs.pendulum import PENDULUM
from autograder.proofs.subject import World
from autograder.protocol import HandedIn, handed_in
from autograder.protocol.proofs import MOST_CHARACTERS, MOST_LINES, MOST_PARTS

ENERGY = World(FREE, np.random.default_rng(0), ())
SWING = World(PENDULUM, np.random.default_rng(0), ())

SAME = {
    "1/2 qd' M qd": [
        r"\tfrac12 \dot q^{\mathsf T} M \dot q",
        r"\frac{1}{2}\,\dot{q}^T M\,\dot{q}",
        r"\dfrac{\dot q^\top M\dot q}{2}",
        r"$\tfrac12\,\dot q^{\mathrm T}M\dot q$",
        r"\frac12 \dot q^\mathsf{T} M \dot q",
        "½ q̇ᵀ M q̇",
        "½q̇ᵀMq̇",
        "qd.T*M*qd/2",
        "0.5*qd.T@M@qd",
        "(1/2)*qd^T M*qd",
        "qd' (M/2) qd",
        "qd'[M qd]/2",
        "(qd' M qd)'/2",
    ],
    "Mdot - 2 C": [
        r"\dot M - 2C",
        "Ṁ − 2·C",
        "d/dt(M) - 2 C",
        "ddt(M) - 2*C",
        r"\bigl(\dot M - 2C\bigr)",
    ],
    "qd' M qdd": [r"\dot q^T M \ddot q", "q̇ᵀ M q̈", "qd' M ddt(qd)"],
    "M^-1 (u - g)": ["M^{-1}(u-g)", "M**(-1)*(u - g)", "M⁻¹ (u − g)", r"M^{-1}\left(u - g\right)"],
    "Edot - Pdot": ["Ė - Ṗ", "dE/dt - dP/dt", r"\dot E - \dot P", "d/dt(E - P)"],
}
SAME_PENDULUM = {
    "1/2 I qd^2 - m g lc (1 - cos(q))": [
        "I*qd**2/2 - m*g*lc*(1 - cos(q))",
        r"\tfrac12 I\dot q^2 - m g\ell_c(1 - \cos q)",
        "½ I q̇² − m g ℓc (1 − cos q)",
    ],
    "d/dt(d/dqd(L)) - d/dq(L)": ["d/dt(dL/dqd) - dL/dq", r"d/dt(\partial L/\partial qd) - ∂L/∂q"],
}


def value(world, subject, text):
    return world.value(subject.parser.read(text)).numbers


@pytest.mark.parametrize(("ours", "theirs"), [(a, b) for a, more in SAME.items() for b in more])
def test_the_ways_of_typing_a_formula(ours, theirs):
    np.testing.assert_allclose(value(ENERGY, FREE, theirs), value(ENERGY, FREE, ours))


@pytest.mark.parametrize(
    ("ours", "theirs"), [(a, b) for a, more in SAME_PENDULUM.items() for b in more]
)
def test_the_ways_of_typing_a_formula_of_the_pendulum(ours, theirs):
    np.testing.assert_allclose(value(SWING, PENDULUM, theirs), value(SWING, PENDULUM, ours))


def test_an_expression_of_sympys_is_read():
    import sympy as sp

    M, qd = sp.MatrixSymbol("M", 3, 3), sp.MatrixSymbol("qd", 3, 1)
    (line,) = handed_in([(qd.T * M * qd / 2, "kinetic energy")]).lines
    np.testing.assert_allclose(value(ENERGY, FREE, line[0]), value(ENERGY, FREE, "1/2 qd' M qd"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "This line is empty."),
        ("=", "Nothing stands behind =."),
        ("K = P = E", "Write one ="),
        ("qd qd", "a column of 3 and a column of 3 does not fit. A scalar product is a' b."),
        ("M + qd", "You add a column of 3 to a 3×3 matrix."),
        ("qd / M", "You divide by a 3×3 matrix; only a number divides."),
        ("qd^2", "There is no power of a column of 3."),
        ("qd^-1", "There is no inverse of a column of 3."),
        ("M^5", "A power is a whole number up to 4, -1 or T."),
        ("M^-2", "The only negative power is -1."),
        ("M^0.5", "A power is a whole number"),
        ("sin(qd)", "sin is taken of a number, not of a column of 3."),
        ("(M", "A bracket of this line is not closed."),
        ("M)", "')' is not expected there."),
        ("M +", "This line stops where something should follow."),
        ("B qd", "'B' is no name of this derivation. The names are"),
        ("M # a remark", "'#' cannot be read here."),
        ("1/(K - K)", "This line divides by zero"),
        ("1001 K", "is larger than 1000"),
        ("12345678 K", "cannot be read here"),
        ("d/dqd(K)", "There is no derivative by qd here."),
        ("d/dt(d/dt(d/dt(K)))", "A derivative of a derivative of a derivative"),
        ("K" * 300 + "+" * 200, f"more than {MOST_CHARACTERS} characters"),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_said_in_one_sentence(text, said):
    marked = mark(DERIVATIONS["p2-E"], handed_in([(text, "algebra")]), np.random.default_rng(0))
    assert said in marked.lines[0].said


HOSTILE = {
    "brackets": "(" * 199 + "K" + ")" * 199,
    "open": "(" * 399,
    "squares": "[" * 399,
    "transposes": "M" + "'" * 398,
    "powers": "M" + "^4" * 199,
    "power tower": "K^(4^(4^(4)))",
    "power of a power": "(" * 20 + "K" + "^4)" * 20 + "^4",
    "quotients": "K" + "/K" * 199,
    "derivatives": "d/dt(" * 60 + "K" + ")" * 60,
    "product in derivatives": "d/dt("
    + "K P " * 15
    + "d/dt("
    + "E P " * 15
    + "d/dt("
    + "K " * 60
    + ")))",
    "rule": "d/dt(d/dt((K P E)^4 (K P E)^4 (K P)^4))",
    "waves": "sin " * 90 + "K",
    "minus": "-" * 399 + "K",
    "frac": r"\frac" * 60 + "{1}{2}",
    "nested frac": r"\frac{" * 40 + "1" + "}{2}" * 40,
    "nested sums": r"\sum_k(m_k" * 30 + ")" * 30,
    "sums of slopes": r"\sum_k\frac{\partial M_{ij}}{\partial q_k}\dot q_k" * 8,
    "boxes": r"\boxed{" * 57,
    "huge number": "9" * 399,
    "numbers": "999 " * 99,
    "dunder": "K.__class__.__mro__[1].__subclasses__()",
    "call": "__import__('os').system('id')",
    "lambda": "(lambda: K)()",
    "names": "exec(eval(open(globals())))",
    "format": "{K.__init__}",
    "null": "K\x00P",
    "bidirectional": "K\u202eP",
    "surrogate": "K\ud800",
    "combining": "q" + "\u0307" * 398,
    "html": "<script>alert(1)</script>",
    "many names": "K " * 199,
    "sums": "+K" * 199,
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_line_is_refused_or_valued_quickly(text):
    for id, reason in (("p2-E", "product rule"), ("p3-L", "time derivative")):
        spent = time.process_time()
        marked = mark(DERIVATIONS[id], handed_in([(text, reason)]), np.random.default_rng(0))
        assert marked.lines[0].said
        assert time.process_time() - spent < 4


def test_a_derivative_that_grows_too_long_is_refused():
    rule = PENDULUM.reason("time derivative")
    world = World(PENDULUM, np.random.default_rng(0), (rule,))
    short, long = (f"d/dt(d/dt({'(q + I qd)^4 ' * factors}))" for factors in (1, 12))
    world.value(PENDULUM.parser.read(short))
    with pytest.raises(LineError, match="too long when its derivatives are written out"):
        world.value(PENDULUM.parser.read(long))


@pytest.mark.parametrize("name", ["rule", "sums", "many names", "nested frac"])
def test_a_hostile_line_takes_little_memory(name, monkeypatch):
    monkeypatch.setattr(marking, "MOST_DIAGNOSED", 0)  # the worlds for that are many, and small
    tracemalloc.start()
    mark(
        DERIVATIONS["p2-E"], handed_in([(HOSTILE[name], "product rule")]), np.random.default_rng(0)
    )
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 30e6


def test_a_whole_hostile_derivation_is_marked_quickly():
    line = ("+".join(["qd' M qd"] * 40), "product rule", "chain rule")
    given = HandedIn((tuple(line),) * (MOST_LINES + 1))
    spent = time.process_time()
    marked = mark(DERIVATIONS["p2-E"], given, np.random.default_rng(0))
    assert time.process_time() - spent < 10
    assert len(marked.lines) == MOST_LINES
    assert marked.still == f"Only the first {MOST_LINES} lines are read."
    assert not marked.done


@given(st.text(st.sampled_from("KMqd'()[]+-*/^ 0123.=>\\{}$_TECPusincoddt½ᵀ̇"), max_size=80))
@settings(max_examples=150, deadline=None)
def test_any_text_is_read_or_refused(text):
    try:
        _, _, right = relation_and_sides(text)
        tree = FREE.parser.read(right)
        numbers = ENERGY.value(tree).numbers
    except LineError:
        return
    assert np.isfinite(numbers).all()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (None, "Give a list of lines"), ("K", "Give a list of lines"), (3, "Give a list of lines"),
        ({"K": "algebra"}, "Give a list of lines"), ([()], "Give a list of lines"),
        (lambda: 1 / 0, "ZeroDivisionError: division by zero"), (lambda x: x, "TypeError"),
    ],
)  # fmt: skip
def test_what_is_no_list_of_lines(given, said):
    assert said in handed_in(given).problem


def test_what_is_not_attempted_is_no_problem():
    def untouched():
        raise NotImplementedError

    assert handed_in(untouched) == HandedIn() == handed_in([])


def test_more_than_is_read_is_cut():
    endless = (("K" * 10_000,) * 50 for _ in iter(int, 1))
    given = handed_in(endless)
    assert len(given.lines) == MOST_LINES + 1
    assert {len(line) for line in given.lines} == {MOST_PARTS}
    assert max(len(part) for line in given.lines for part in line) == MOST_CHARACTERS + 1
