"""The usual false proofs: each is caught and named, and no true step is taken for one."""

from dataclasses import replace

import numpy as np
import pytest

from autograder.proofs import DERIVATIONS, mark
from autograder.protocol import handed_in
from tests.autograder.proofs.models import said

# Derivation, mistake: a line, the false one behind it, and the reasons given for that.
TABLE = {
    ("p1-positive", "positive determinant"): ("qd' M qd", "> 0", "positive determinant"),
    ("p1-positive", "positive diagonal"): ("qd' M qd", ">= 0", "positive diagonal"),
    ("p1-positive", "symmetry of M"): ("qd' M qd", "> 0", "symmetry of M"),
    ("p1-positive", "semidefinite inertias"): ("v1' I1 v1", "> 0", "semidefinite inertias"),
    ("p1-positive", "K without its half"): ("qd' M qd", "K", "kinetic energy"),
    ("p2-skew", "energy balance"): ("Mdot - 2 C", "2 C' - Mdot'", "energy balance"),
    ("p2-skew", "C is skew"): ("Mdot + C + C'", "Mdot", "Christoffel symbols"),
    ("p2-skew", "Ṁ = 2C"): ("Mdot - 2 C", "0", "Christoffel symbols"),
    ("p2-skew", "Ṁ = C"): ("2 Mdot - 2 C", "0", "Christoffel symbols"),
    ("p2-skew", "M constant"): ("2 C", "W - W'", "Christoffel symbols"),
    ("p3-L", "L = K + P"): ("d/dq(L)", "d/dq(K) + d/dq(P)", "definition of L"),
    ("p3-L", "from upright"): ("P", "m g lc + m g lc cos q", "potential energy"),
    ("p3-L", "sine for the height"): ("d/dq(P)", "d/dq(m g lc sin q)", "potential energy"),
    ("p3-L", "inertia about the centre of mass"): (
        "K",
        "1/2 (I + m lc^2) qd^2",
        "kinetic energy",
    ),
    ("p3-L", "point mass"): ("K", "1/2 m (lc qd)^2", "kinetic energy"),
    ("p3-L", "derivatives exchanged"): ("u", "d/dt(d/dq(L)) - d/dqd(L)", "Euler-Lagrange"),
    ("p3-L", "K without its half"): ("d/dqd(K)", "2 I qd", "kinetic energy", "partial derivatives"),
    ("p3-L", "P with the sign of K"): ("u", "d/dt(d/dqd(L)) + d/dq(L)", "Euler-Lagrange"),
    ("p3-L", "no derivative in time"): ("u", "d/dqd(L) - d/dq(L)", "Euler-Lagrange"),
    ("p4-P", "sign of P"): ("P", "m1 g0' p1 + m2 g0' p2", "potential energy"),
    ("p4-P", "one mass for both"): ("P", "-m1 (g0' p1 + g0' p2)", "potential energy"),
    ("p4-P", "g reversed"): ("qd' g", "-qd' dPdq", "gradient of P"),
    ("p4-P", "links of one Jacobian"): ("g0' v1 + g0' v2", "2 g0' J1 qd", "Jacobians"),
    ("p5-E", "friction lost"): ("qd' M qdd", "qd' (u - C qd - g)", "equation of motion"),
    ("p5-E", "friction reversed"): ("qd' M qdd", "qd' (u - C qd - g + f)", "equation of motion"),
}
OF_ENERGY = {
    "gravity reversed": ("qd' M qdd", "qd' (u - C qd + g{f})", "equation of motion"),
    "C reversed": ("qd' M qdd", "qd' (u + C qd - g{f})", "equation of motion"),
    "C is skew": ("qd' (Mdot - 2 C) qd", "qd' Mdot qd", "skew-symmetry"),
    "Ṁ = 2C": ("Mdot qd - 2 C qd", "0", "skew-symmetry"),
    "Ṁ = C": ("1/2 qd' Mdot qd - qd' C qd", "-1/2 qd' C qd", "skew-symmetry"),
    "M constant": ("d/dt(1/2 qd' M qd)", "qd' M qdd", "product rule", "symmetry of M"),
    "no gravity": ("qd' M qdd + qd' g", "qd' (u - C qd - g{f})", "equation of motion"),
    "no torque": ("qd' M qdd", "-qd' (C qd + g{g})", "equation of motion"),
    "K without its half": ("d/dt(K)", "d/dt(qd' M qd)", "kinetic energy"),
}
for name, (before, after, *reasons) in OF_ENERGY.items():
    TABLE["p2-E", name] = before, after.format(f="", g=""), *reasons
    TABLE["p5-E", name] = before, after.format(f=" - f", g=" + f"), *reasons


def sentences(id: str) -> dict[str, str]:
    """Mistake or misused reason → what is said of it."""
    derivation = DERIVATIONS[id]
    return {m.name: m.sentence for m in derivation.mistakes} | {
        m.reason: m.sentence for m in derivation.misused
    }


def step(id: str, before: str, after: str, *reasons: str, seed: int = 3) -> str:
    """What is said of a step, from wherever it starts."""
    derivation = replace(DERIVATIONS[id], start=before)
    after = after if after[:1] == ">" or " = " in after else f"= {after}"
    (line,) = mark(derivation, handed_in([(after, *reasons)]), np.random.default_rng(seed)).lines
    return line.said


@pytest.mark.parametrize(("id", "mistake"), TABLE)
def test_it_is_named(id, mistake):
    for seed in range(3):
        assert step(id, *TABLE[id, mistake], seed=seed) == sentences(id)[mistake]


def test_every_mistake_is_in_the_table():
    assert set(TABLE) == {(id, name) for id in DERIVATIONS for name in sentences(id)}


@pytest.mark.parametrize("id", DERIVATIONS)
def test_what_is_to_be_proved_may_not_be_a_reason(id):
    derivation = DERIVATIONS[id]
    for name in derivation.to_prove:
        (text,) = said(id, (f"{derivation.relation} {derivation.goal}", name))
        assert text == f'"{name}" is what is to be proved; here it is assumed.'


def test_energy_gives_one_vector_and_skew_symmetry_all():
    """The false proof of problem 2: the same reason does give q̇ᵀ(Ṁ − 2C)q̇ = 0, and nothing more."""
    balance = replace(DERIVATIONS["p2-skew"], start="qd' (Mdot - 2 C) qd")
    found = mark(balance, handed_in([("0", "energy balance")]), np.random.default_rng(0))
    assert found.lines[0].holds
    assert "every entry" in step("p2-skew", "(Mdot - 2 C) qd", "0", "energy balance")
    assert step("p2-skew", "qdd' (Mdot - 2 C) qdd", "0", "Christoffel symbols") == ""


@pytest.mark.parametrize(
    ("id", "before", "after", "reasons", "words"),
    [
        (
            "p2-E",
            "qd' M qdd",
            "qdd' M qd",
            ("algebra",),
            "not by algebra: it needs a property of M",
        ),
        (
            "p2-E",
            "qd' g",
            "g' qd",
            ("symmetry of M",),
            'by algebra alone; "symmetry of M" is not used',
        ),
        (
            "p2-E",
            "qd' M qdd",
            "qdd' M qd",
            ("symmetry of M", "gradient of P"),
            'follows by "symmetry of M"; "gradient of P" is not used',
        ),
        (
            "p2-E",
            "Pdot",
            "qd' g",
            ("chain rule",),
            '"chain rule" is not enough: it also needs a definition',
        ),
        ("p2-E", "Edot", "qd' u", ("chain rule",), "put the steps between on lines of their own"),
        ("p2-E", "qd' u", "qd' u + 3 qd' u", ("algebra",), "in a random state of a random"),
        (
            "p2-E",
            "qd' u",
            "qd' u + 1/1000/1000 qd' u",
            ("algebra",),
            "in a random state of a random",
        ),
        ("p2-E", "qd' u", "3 qd' u", (), "Give a reason"),
        ("p2-E", "qd' u", "u' qd", ("symetry of M",), "Did you mean symmetry of M?"),
        ("p2-E", "qd' u", "u' qd", ("magic",), "'magic' is no reason of the list."),
        ("p2-E", "qd' u", "u' qd", ("algebra", *["chain rule", "product rule"] * 2), "At most 2"),
        ("p2-E", "qd' u", "> 0", ("algebra",), "is an equality"),
        ("p1-positive", "qd", ">= 0", ("symmetry of M",), ">= compares numbers"),
        ("p2-E", "qd' u", "C = u' qd", ("algebra",), "starts elsewhere"),
    ],
)
def test_what_is_said_of_other_steps(id, before, after, reasons, words):
    assert words in step(id, before, after, *reasons)


def test_a_left_side_is_where_one_stands_or_started():
    lines = [("Edot = d/dt(K + P)", "definition of E"), ("Edot = Kdot + Pdot", "algebra"),
             ("Kdot + Pdot = Pdot + Kdot", "algebra"), ("Pdot = Kdot", "algebra")]  # fmt: skip
    assert [bool(text) for text in said("p2-E", *lines)] == [False, False, False, True]


def test_later_lines_are_marked_against_the_line_before_though_it_is_wrong():
    lines = [("qd' u", "algebra"), ("u' qd", "algebra")]
    assert [bool(text) for text in said("p2-E", *lines)] == [True, False]
