"""Right derivations as other people write them: other ways, other notations, other reasons."""

import pytest

from tests.autograder.proofs.models import marked

WAYS = {
    "p1-symmetry, on the other side": (
        "p1-symmetry",
        ("= (J1ᵀ I1 J1 + J2ᵀ I2 J2)ᵀ", "M from the links"),
        ("= J1ᵀ I1 J1 + J2ᵀ I2 J2", "semidefinite inertias"),
        ("= M", "m from the Links"),
    ),
    "p1-positive, by the energy": (
        "p1-positive",
        (r"\dot q^{\mathsf T} M \dot q = 2 K", "kinetic energy"),
        ("= v1^T I1 v1 + v2^T I2 v2", "energies of the links"),
        ("> 0", "no motion without energy", "semidefinite inertias"),
    ),
    "p1-positive, in two lines and a repetition": (
        "p1-positive",
        ("v1' I1 v1 + v2' I2 v2", "kinetic energy", "energies of the links"),
        ("qd' M qd = (v2' I2 v2 + v1' I1 v1)", "algebra"),
        ("> 0", "no motion without energy", "semidefinite inertias"),
    ),
    "p2-E, in Unicode and with two reasons": (
        "p2-E",
        ("Ė = d/dt(½ q̇ᵀ M q̇ + P)", "definition of E", "kinetic energy"),
        ("= q̇ᵀ M q̈ + ½ q̇ᵀ Ṁ q̇ + Ṗ", "product rule", "symmetry of M"),
        ("= q̇ᵀ M q̈ + ½ q̇ᵀ Ṁ q̇ + q̇ᵀ g", "chain rule", "gradient of P"),
        ("= q̇ᵀ(u − C q̇) + ½ q̇ᵀ Ṁ q̇", "equation of motion"),
        ("= q̇ᵀ u + ½ q̇ᵀ(Ṁ − 2C) q̇", "algebra"),
        ("= q̇ᵀ u + ½ q̇ᵀ(Wᵀ − W) q̇", "Christoffel symbols"),
        ("= q̇ᵀ u", "algebra"),
    ),
    "p2-E, K and P apart, in LaTeX": (
        "p2-E",
        (r"\dot E = \dot K + \dot P", "definition of E"),
        (r"\dot E = \tfrac12 \frac{2}{1} \dot K + q̇ᵀ dPdq", "chain rule"),
        (r"\dot E = d/dt(\tfrac12 \dot q^T M \dot q) + \dot q^T g", "kinetic energy", "gradient of P"),
        (
            r"= \dot q^T M \ddot q + \tfrac{1}{2} \dot q^T \dot M \dot q + \dot q^T g",
            "product rule",
            "symmetry of M",
        ),
        (r"= \dot q^T u - \dot q^T C \dot q + \frac{1}{2} \dot q^T \dot M \dot q", "equation of motion"),
        (r"= \dot q^T u - \dot q^T (C - \tfrac12 \dot M) \dot q", "algebra"),
        (r"= \dot q^T u", "skew-symmetry"),
    ),
    "p2-skew, term by term": (
        "p2-skew",
        ("= Mdot + Mdot' - 2 C - 2 C'", "algebra"),
        ("= 2 Mdot - 2 C - 2 C'", "symmetry of M"),
        ("= 2 Mdot - (Mdot + W - W') - (Mdot' + W' - W)", "Christoffel symbols"),
        ("= 0", "symmetry of M"),
    ),
    "p2-skew, in indices, in LaTeX": (
        "p2-skew",
        (
            r"= \bigl(\dot M_{ij} - 2\sum_k h_{ijk}\,\dot q_k\bigr)"
            r" + \bigl(\dot M_{ij} - 2\sum_k h_{ijk}\,\dot q_k\bigr)^{\mathsf T}",
            "Christoffel symbols",
        ),
        (
            r"= \sum_k\left(\frac{\partial M_{jk}}{\partial q_i} - \frac{\partial M_{ik}}{\partial q_j}"
            r"\right)\dot q_k + \sum_k\left(\frac{\partial M_{ik}}{\partial q_j}"
            r" - \frac{\partial M_{jk}}{\partial q_i}\right)\dot q_k",
            "algebra",
        ),
        ("= 0 .", "algebra"),
    ),
    "p3-L, each derivative by itself": (
        "p3-L",
        ("d/dt(dL/dqd) - dL/dq", "euler-lagrange"),
        ("d/dt(dK/dqd - dP/dqd) - (dK/dq - dP/dq)", "definition of L"),
        ("d/dt(d/dqd(I*qd**2/2)) - d/dq(I*qd**2/2) + dP/dq - d/dt(dP/dqd)", "kinetic energy"),
        ("d/dt(I*qd) + dP/dq", "partial derivatives"),
        ("I*qdd + dP/dq", "time derivative"),
        ("I*qdd + d/dq(m*g*lc*(1 - cos(q)))", "potential energy"),
        ("I*qdd + m*g*lc*sin(q)", "partial derivatives"),
    ),
    "p4-P, from the potential energy on": (
        "p4-P",
        ("= dP/dt", "gradient of P", "chain rule"),
        ("= -m1 g0ᵀ v1 - m2 g0ᵀ v2", "potential energy", "product rule"),
        ("= -m1 v1ᵀ g0 - m2 v2ᵀ g0", "algebra"),
        ("= q̇ᵀ(-m1 J1ᵀ g0 - m2 J2ᵀ g0)", "Jacobians"),
    ),
    "p5-E, with the accelerations solved for": (
        "p5-E",
        ("Edot = d/dt(1/2 qd' M qd + P)", "kinetic energy", "definition of E"),
        ("= qd' M qdd + 1/2 qd' Mdot qd + Pdot", "symmetry of M", "product rule"),
        ("= qd' M qdd + 1/2 qd' Mdot qd + qd' g", "chain rule", "gradient of P"),
        ("= qd' M (M^-1 (u - C qd - g - f)) + 1/2 qd' Mdot qd + qd' g", "equation of motion"),
        ("= qd' (u - f) - qd' C qd + 1/2 qd' Mdot qd", "algebra"),
        ("= qd' (u - f)", "skew-symmetry"),
    ),
}  # fmt: skip


@pytest.mark.parametrize(("id", "lines"), [(id, lines) for id, *lines in WAYS.values()], ids=WAYS)
def test_it_is_complete(id, lines):
    found = marked(id, lines)
    assert [(line.text, line.said) for line in found.lines if line.said] == []
    assert found.done, found.still
