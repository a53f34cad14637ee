"""False proofs as students write them, whole: which lines do not hold, and what is said of them."""

import pytest

from tests.autograder.proofs.models import marked, models

ENERGY = ("Edot = d/dt(1/2 qd' M qd) + Pdot", "definition of E", "kinetic energy")
SKEW = "(Mdot - 2C) + (Mdot - 2C)'"
LAGRANGE = list(models()["p3-L"])
CIRCLE = '" is what is to be proved; here it is assumed.'
# Name: derivation, lines, and what stands in the sentence of each that does not hold, by its number.
FALSE = {
    "the right end from a wrong middle": (
        "p2-E",
        [ENERGY, ("= qd' M qdd + Pdot", "product rule", "symmetry of M"),
         ("= qd' M qdd + qd' g", "chain rule", "gradient of P"),
         ("= qd' (u - C qd)", "equation of motion"), ("= qd' u", "skew-symmetry")],
        {2: "loses the change of M", 5: "takes C itself to be skew-symmetric"},
    ),
    "the energy from its own balance": (
        "p2-E",
        [("Edot = qd' u + 1/2 qd' (Mdot - 2 C) qd", "energy balance"), ("= qd' u", "skew-symmetry")],
        {1: CIRCLE},
    ),
    "skew by skewness": ("p2-skew", [(f"{SKEW} = 0", "skew-symmetry")], {1: CIRCLE}),
    "skew by the energy": ("p2-skew", [(f"{SKEW} = 0", "energy balance")], {1: "every entry"}),
    "skew for every z by the energy": (
        "p2-skew", [("= z' (Mdot - 2 C) z", "energy balance"), ("= 0", "energy balance")],
        {1: "with the same q̇ that stands in C", 2: "with the same q̇ that stands in C"},
    ),
    "any vector for the velocities": (
        "p2-E", [("Edot = z' u", "equation of motion")], {1: "does not follow"},
    ),
    "a sum that is zero whatever stands in it": (
        "p2-skew",
        [(f"{SKEW} = (W - W') + (W - W')'", "Christoffel symbols"), ("= 0", "algebra")],
        {1: "what stands in the first bracket is not what stood there before"},
    ),
    "Christoffel symbols with plus signs": (
        "p2-skew",
        [(f"{SKEW} = (-W - W') + (-W - W')'", "Christoffel symbols")],
        {1: "does not follow from the line before: in a random state"},
    ),
    "the product rule of two factors": (
        "p2-E",
        [ENERGY, ("= 1/2 qdd' M qd + 1/2 qd' M qdd + Pdot", "product rule")],
        {2: "loses the change of M"},
    ),
    "a lost half": (
        "p2-E",
        [ENERGY, ("= qd' M qdd + qd' Mdot qd + Pdot", "product rule", "symmetry of M")],
        {2: "half or twice the factor"},
    ),
    "C for half of the rate of M": (
        "p2-E",
        [ENERGY, ("= qd' M qdd + qd' C qd + Pdot", "product rule", "symmetry of M")],
        {2: "are not enough: it also needs a property of C"},
    ),
    "transposed in the same order": (
        "p1-symmetry",
        [("M' = (J1' I1 J1 + J2' I2 J2)'", "M from the links"),
         ("= J1 I1' J1' + J2 I2' J2'", "algebra")],
        {2: "does not fit"},
    ),
    "symmetry, since it is so": ("p1-symmetry", [("M' = M", "symmetry of M")], {1: CIRCLE}),
    "symmetry of the inertias, unsaid": (
        "p1-symmetry",
        [("M' = (J1' I1 J1 + J2' I2 J2)'", "M from the links"),
         ("= J1' I1 J1 + J2' I2 J2", "algebra"), ("= M", "M from the links")],
        {2: "it needs a property of the link inertias"},
    ),
    "one example in numbers": (
        "p1-positive",
        [("qd' M qd = 3.2", "kinetic energy"), ("> 0", "algebra")],
        {1: "One example proves nothing"},
    ),
    "the numbers of one pendulum": (
        "p3-L", [("u = 2 qdd + 9.81 sin(q)", "Euler-Lagrange")], {1: "A measured number stands here"},
    ),
    "energy is positive": (
        "p1-positive",
        [("qd' M qd = 2 K", "kinetic energy"), ("> 0", "M is positive definite")],
        {2: CIRCLE},
    ),
    "positive, for its energy": (
        "p1-positive",
        [("qd' M qd = 2 K", "kinetic energy"), ("> 0", "no motion without energy")],
        {2: "is not enough: it also needs a definition and a property of the link inertias"},
    ),
    "divided by the velocity": (
        "p3-L", [("u = d/dt(K + P)/qd", "Euler-Lagrange")], {1: "divides by what is zero at rest"},
    ),
    "divided by the square of the velocities": (
        "p2-skew", [(f"= qd' ({SKEW}) qd / (qd' qd)", "algebra")], {1: "divides by what is zero"},
    ),
    "divided by a column": (
        "p2-E", [("Edot / qd = u", "algebra")], {1: "You divide by a column of 3; only a number"},
    ),
    "the sign of a slope": (
        "p3-L",
        [*LAGRANGE[:2], ("= d/dt(I qd) - m g lc sin q", "partial derivatives")],
        {3: "With another sign of one term"},
    ),
    "a slope that stays a cosine": (
        "p3-L",
        [*LAGRANGE[:3], ("= d/dt(I qd) + m g lc cos q", "partial derivatives")],
        {4: "a sine and a cosine exchanged"},
    ),
    "Euler-Lagrange, turned round": (
        "p3-L",
        [("u = d/dq(L) - d/dt(d/dqd(L))", "Euler-Lagrange")],
        {1: "With the opposite sign"},
    ),
    "two friction torques": (
        "p5-E",
        [("Edot = qd' u", "energy balance"), ("= qd' (u - f)", "equation of motion")],
        {1: CIRCLE, 2: "does not follow"},
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FALSE)
def test_it_is_caught_where_it_is_false(name):
    id, lines, expected = FALSE[name]
    for seed in range(3):
        found = marked(id, lines, seed)
        wrong = {at: line.said for at, line in enumerate(found.lines, 1) if not line.holds}
        assert wrong.keys() == expected.keys(), wrong
        assert not [at for at, words in expected.items() if words not in wrong[at]], wrong
        assert not found.done
        assert found.earned == ()


@pytest.mark.parametrize(
    "line",
    [
        "(W' - W) + (W' - W)'",
        "(W' - W) + (W - W')",
        "-(W - W') - (W - W')'",
        "1/2 (2 W' - 2 W) + (W' - W)'",
    ],
)
def test_no_right_sum_is_taken_for_a_false_one(line):
    assert marked("p2-skew", [(f"{SKEW} = {line}", "Christoffel symbols"), ("= 0", "algebra")]).done
