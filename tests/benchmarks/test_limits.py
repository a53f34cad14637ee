"""The count of operations that stands beside the benchmarks' times."""

import itertools
import sys

import pytest
import sympy as sp

from armdyn.derive import from_energies, planar_2r
from tests.benchmarks import limits


def with_gcc_or_clang(test):
    windows = pytest.mark.skipif(sys.platform == "win32", reason="asks a compiler of gcc's kind")
    return windows(pytest.mark.usefixtures("compiler")(test))


@pytest.mark.parametrize(
    ("statements", "needed"),
    [
        ("const double z = r * r;", 1),
        ("const double y = 1 - z*(a + b/c);", 4),
        ("const double r = fma(n, -0.5, t);", 2),
        ("x[half + i] += sixth * a1[2 * i];", 2),
        ("*o_0 = -k[3 + 1];", 0),
        ("for (int i = 0; i < 2 * n; i++)", 0),
        ("double a, b;\n  a = b + 1e-9;\n  b = a * 2.5e+3;", 2),
    ],
)
def test_operations_are_those_on_floats(statements, needed):
    assert limits.operations(statements) == needed


def test_a_body_ends_with_its_own_brace():
    source = (
        "int one(int a)\n{\n    a = 1;\n}\nvoid two(void)\n{\n    if (b) {\n        b;\n    }\n}\n"
    )
    assert limits.body(source, "two") == "    if (b) {\n        b;\n    }\n"
    with pytest.raises(ValueError, match="three: no such"):
        limits.body(source, "three")


@with_gcc_or_clang
def test_a_step_is_four_evaluations_and_each_angle_costs_the_same():
    """M = 1 and P a sum of sines: q̈ costs the angles, the negated sums, and 1/M at most."""
    q, qd = sp.symbols("q qd", real=True)
    counts = []
    for angles in ([q], [q, q**2], [q, q**2, q**4]):
        d = from_energies(qd**2 / 2, sum(map(sp.sin, angles)), [q], [qd])
        evaluation, step = limits.evaluation_and_step(d)
        update = step - 4 * evaluation
        counts.append((evaluation, update))
    assert len({update for _, update in counts}) == 1
    first, second = (b[0] - a[0] for a, b in itertools.pairwise(counts))
    assert 30 < first <= second <= first + 4


@with_gcc_or_clang
def test_the_limits_are_above_what_is_measured():
    evaluation, step = limits.evaluation_and_step(planar_2r())
    assert 60 < evaluation < step / 4 < 200
    row = limits.Work("x", 1e-9, 64, evaluation)
    assert "| x | 1 ns | 64 |" in limits.table([row], 128e9, 1e12)
    assert "| 64 | 50% |" in limits.table([row], 128e9, 1e12)
    assert limits.most_operations() > 1e8
