"""p3-pendulum: right answers in many styles pass at any seed; the references agree with armdyn."""

import numpy as np
import pytest
import sympy as sp

from armdyn import Pendulum
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.p3_pendulum.checks import CHECKS as P3
from tests.autograder.seeds import A_THOUSAND
from tests.autograder.verdicts import assert_right, judged, judged_in, namespace_of

MGL = "pend.m * pend.g * pend.lc"
RIGHT = {
    "p3-lagrangian": [
        "I * qd**2 / 2 - m * g * lc * (1 - sp.cos(q))",
        "I * qd**2 / 2 + m * g * lc * sp.cos(q)",
        "sp.Rational(1, 2) * I * qd**2 - 2 * m * g * lc * sp.sin(q / 2) ** 2",
        "0.5 * I * qd**2 - m * g * (5 - lc * sp.cos(q))",
        "0.5 * (I - m * lc**2) * qd**2 + 0.5 * m * ((lc * sp.cos(q) * qd) ** 2 "
        "+ (lc * sp.sin(q) * qd) ** 2) + m * g * lc * sp.cos(q)",
        "sp.Matrix([[I * qd**2 / 2 + m * g * lc * sp.cos(q)]])[0, 0]",
        "sp.expand(I * qd**2 / 2 - m * g * (lc - lc * sp.cos(q)))",
        "sp.integrate(I * qd, qd) - sp.integrate(m * g * lc * sp.sin(q), q)",
        "(sp.Matrix([qd]).T * sp.Matrix([[I]]) * sp.Matrix([qd]))[0] / 2 + m * g * lc * sp.cos(q)",
        "0.5 * I * qd**2 - m * g * lc * (1 - sp.sin(q + sp.pi / 2))",
    ],
    "p3-M": [
        "pend.I",
        "[pend.I]",
        "[[pend.I]]",
        "np.array([[pend.I]])",
        "np.float32(pend.I)",
        "np.array([[pend.I]], dtype=np.float32)",
        "pend.I + 0 * q",
        "((pend.I - pend.m * pend.lc**2) + pend.m * pend.lc**2,)",
        "sp.Matrix([[pend.I]])",
        "np.full((1, 1), pend.I)",
    ],
    "p3-C": [
        "0",
        "0.0",
        "[[0]]",
        "np.zeros((1, 1))",
        "0 * qd",
        "[[0 * q[0] * qd[0]]]",
        "(0,)",
        "sp.zeros(1, 1)",
        "np.zeros_like(q)",
        "[[(pend.I - pend.I) / 1e-6 * qd[0]]]",
    ],
    "p3-g_vec": [
        f"{MGL} * np.sin(q)",
        f"{MGL} * np.sin(q[0])",
        f"[{MGL} * np.sin(q[0])]",
        f"np.float32({MGL} * np.sin(np.float32(q)))",
        f"{MGL} * sp.sin(q[0])",
        f"-{MGL} * np.cos(q + np.pi / 2)",
        f"2 * {MGL} * np.sin(q / 2) * np.cos(q / 2)",
        f"{MGL} * (np.cos(q - 1e-6) - np.cos(q + 1e-6)) / 2e-6",
        f"np.array([[{MGL} * np.sin(q[0])]])",
        f"float({MGL} * np.sin(q)[0])",
    ],
    "p3-inertia_about_pivot": [
        "I_com + m * lc**2",
        "I_com + m * lc * lc",
        "[I_com + m * lc**2]",
        "(I_com + m * lc**2,)",
        "[[I_com + m * lc**2]]",
        "np.float32(I_com + m * lc**2)",
        "np.array(I_com + m * np.square(lc))",
        "sp.Float(I_com) + m * sp.Float(lc) ** 2",
        "m * (I_com / m + lc**2)",
        "np.dot([I_com, m], [1, lc**2])",
    ],
    "p3-small_angle_frequency": [
        f"np.sqrt({MGL} / pend.I)",
        f"({MGL} / pend.I) ** 0.5",
        f"sp.sqrt({MGL} / pend.I)",
        f"2 * np.pi / (2 * np.pi * np.sqrt(pend.I / ({MGL})))",
        f"[np.sqrt({MGL} / pend.I)]",
        f"np.array([[np.sqrt({MGL} / pend.I)]])",
        f"np.float32(np.sqrt({MGL} / pend.I))",
        f"np.hypot(0, ({MGL} / pend.I) ** 0.5)",
        f"abs(np.roots([pend.I, 0, {MGL}])[0])",
        f"np.exp(0.5 * np.log({MGL} / pend.I))",
    ],
}
CASES = [(check_id, returned) for check_id, variants in RIGHT.items() for returned in variants]


@pytest.mark.parametrize(("check_id", "returned"), CASES)
def test_right_in_any_style(check_id, returned):
    assert_right(judged(check_id, returned, seed=1))


@A_THOUSAND
@pytest.mark.parametrize("check_id", [c.id for c in P3 if c.id != "p3-lagrangian"])
def test_no_false_alarm_over_a_thousand_seeds(check_id, seeds):
    single = f"np.float32({RIGHT[check_id][0]})"
    namespaces = [namespace_of(check_id, r) for r in (RIGHT[check_id][0], single)]
    for seed in seeds:
        for namespace in namespaces:
            assert judged_in(namespace, check_id, seed, VISIBLE_CASES).state is State.CORRECT


@A_THOUSAND
def test_no_false_alarm_on_the_lagrangian(seeds):
    """The same expression each time, as SymPy takes most of the time."""
    L = eval(f"lambda q, qd, m, lc, I, g: {RIGHT['p3-lagrangian'][1]}", {"sp": sp})
    written = L(*(sp.Symbol(name, real=True) for name in ("q", "qd", "m", "lc", "I", "g")))
    for seed in seeds:
        verdict = judged_in(
            {"lagrangian": lambda *symbols: written}, "p3-lagrangian", seed, VISIBLE_CASES
        )
        assert verdict.state is State.CORRECT, f"seed {seed}: {verdict}"


def test_ten_variants_at_least():
    assert all(len(variants) >= 10 for variants in RIGHT.values())


@pytest.mark.parametrize("check_id", RIGHT)
def test_wrong_by_1e_4_fails_at_any_seed(check_id):
    exact = check_id == "p3-C"  # zero has no relative error
    returned = "1e-4 * qd" if exact else f"({RIGHT[check_id][0]}) * 1.0001"
    namespace = namespace_of(check_id, returned)
    for seed in range(20):
        assert judged_in(namespace, check_id, seed).state is not State.CORRECT


def test_references_agree_with_the_library():
    """The checks' own references, against armdyn.Pendulum, at the checks' own cases."""
    checks = {check.name: check for check in P3}
    rng = np.random.default_rng(3)
    for name in ("M", "g_vec"):
        for call in checks[name].calls(rng, 50):
            q, pend = call.args
            model = Pendulum(**vars(pend))
            expected = getattr(model, name)(q).item()
            assert checks[name].reference(q, pend) == pytest.approx(expected, rel=1e-13)
    for call in checks["C"].calls(rng, 50):
        q, qd, pend = call.args
        assert checks["C"].reference(q, qd, pend) == Pendulum(**vars(pend)).C(q, qd).item()
    for call in checks["lagrangian"].calls(rng, 50):
        for point in call.at:
            q, qd, *parameters = point.values()
            model = Pendulum(**dict(zip(("m", "lc", "I", "g"), parameters, strict=True)))
            L = model.kinetic_energy([q], [qd]) - model.potential_energy([q])
            assert checks["lagrangian"].reference(*point.values()) == pytest.approx(L, rel=1e-13)
    for call in checks["inertia_about_pivot"].calls(rng, 50):
        I_com, m, lc = call.args
        expected = Pendulum.from_com(m=m, lc=lc, I_com=I_com).I
        assert checks["inertia_about_pivot"].reference(*call.args) == pytest.approx(expected)


def test_frequency_is_that_of_the_linearised_pendulum():
    """q̈ = −ω² q near hanging, with q̈ from armdyn's dynamics."""
    check = CHECKS["p3-small_angle_frequency"]
    for call in check.calls(np.random.default_rng(4), 50):
        (pend,) = call.args
        qdd = Pendulum(**vars(pend)).dynamics([1e-6], [0.0], [0.0]).item()
        assert check.reference(pend) ** 2 == pytest.approx(-qdd / 1e-6, rel=1e-9)


def test_failing_reference_blames_the_check():
    """A check whose reference breaks is our fault, and says so."""
    check = CHECKS["p3-M"]
    broken = type(check)(
        check.id, check.signature, lambda q, pend: pend.mass, check.calls, check.criteria
    )
    verdict = broken.run(lambda calls: [], np.random.default_rng(0))
    assert verdict.state is State.CHECK_FAILED
    assert "not your fault" in verdict.next_step
