"""Names: symbols that look alike are refused, and all others may be called as one likes."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.physics.mechanics import dynamicsymbols

from armdyn import Planar2R
from armdyn.codegen import numpy_model
from armdyn.derive import Derivation, Link, from_energies, from_lagrangian, from_links, planar_2r

t = dynamicsymbols._t
x, xd, q1 = dynamicsymbols("x xd q1")
m, k = sp.symbols("m k", positive=True)
place, speed = sp.symbols("x v", real=True)


def taken(name, **assumptions):
    return sp.Symbol(name, **assumptions)


@pytest.mark.parametrize("assumptions", [{}, {"real": True}, {"positive": True}])
@pytest.mark.parametrize(
    ("coordinate", "name", "role"),
    [
        (x, "xd", "the velocity of x(t)"),
        (q1, "qd1", "the velocity of q1(t)"),
        (x, "x", "the coordinate x(t)"),
        (q1, "q1", "the coordinate q1(t)"),
    ],
)
def test_a_parameter_with_a_name_that_we_give_is_refused_by_name(
    coordinate, name, role, assumptions
):
    """Once M came out wrong here: the parameter was taken for the velocity."""
    other = taken(name, **assumptions)
    K, P = (m + other) * coordinate.diff(t) ** 2 / 2, k * coordinate**2 / 2
    says = (
        rf"^{{}}: the symbol {name} has the name of {role.replace('(', '[(]').replace(')', '[)]')}"
    )
    with pytest.raises(ValueError, match=says.format("K")):
        from_energies(K, P, [coordinate])
    with pytest.raises(ValueError, match=says.format("L")):
        from_lagrangian(K - P, [coordinate])
    with pytest.raises(ValueError, match=says.format("P")):
        from_energies(m * coordinate.diff(t) ** 2, other * coordinate, [coordinate])
    # As it says, symbols for q and qd leave the name free.
    q, v = sp.symbols("position speed", real=True)
    moved = {coordinate.diff(t): v}
    found = from_energies(K.subs(moved).subs(coordinate, q), k * q**2 / 2, [q], [v])
    assert found.M[0] == m + other


@pytest.mark.parametrize(
    "make",
    [
        lambda: from_energies(m * speed**2, taken("m") * place, [place], [speed]),
        lambda: from_lagrangian((m - taken("m", real=True)) * speed**2, [place], [speed]),
        lambda: from_energies(m * x.diff(t) ** 2, taken("m") * x, [x]),
        lambda: from_energies(m * taken("v") ** 2, k * place**2, [place], [speed]),
        lambda: from_energies(m * speed**2, k * taken("x") ** 2, [place], [speed]),
        lambda: from_energies(m * speed**2, k * sp.Dummy("k"), [place], [speed]),
        lambda: from_energies(m * speed**2, 0, [place], [taken("x")]),
        lambda: from_links([Link("revolute", m, com=(taken("m"), 0, 0))]),
        lambda: replace(planar_2r(), parameters=(*planar_2r().parameters, taken("l1"))),
        lambda: replace(planar_2r(), parameters=(*planar_2r().parameters, taken("q1"))),
    ],
)
def test_two_symbols_of_one_name_are_refused_by_name(make):
    with pytest.raises(
        ValueError, match=r": 2 different symbols are called (m|v|x|k|l1|q1): \w+\("
    ):
        make()


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: from_energies(m * x.diff(t) ** 2, 0, [x, x]), "all different"),
        (
            lambda: from_energies(m * x.diff(t) ** 2 + m * xd.diff(t) ** 2, 0, [x, xd]),
            r"the velocity of x\(t\) would be called xd, as is the coordinate xd\(t\)",
        ),
        (
            lambda: from_energies(m * x.diff(t) ** 2, 0, [x, sp.Function("x", real=True)(t)]),
            r"would be called x, as is the coordinate x\(t\)",
        ),
        (
            lambda: from_energies(m * x.diff(t) ** 2, 0, [x, sp.Function("y")(place)]),
            "needs functions of one symbol, time",
        ),
        (
            lambda: from_links([Link("revolute", taken("q1", real=True))]),
            r"^links\[0\].mass: the symbol q1 has the name of a coordinate",
        ),
        (
            lambda: from_links(
                [Link("revolute", m), Link("revolute", m, com=(taken("qd2"), 0, 0))]
            ),
            r"^links\[1\].com: the symbol qd2 has the name of a velocity",
        ),
        (
            lambda: from_links([Link("revolute", m, inertia=taken("g", real=True) * sp.eye(3))]),
            r"^links\[0\].inertia: the symbol g has the name of the gravitational acceleration",
        ),
        (
            lambda: from_links([Link("revolute", m)], gravity=(0, taken("q1"), 0)),
            "^gravity: the symbol q1 has the name of a coordinate",
        ),
        (
            lambda: numpy_model(
                Derivation(
                    (place,),
                    (speed,),
                    (m,),
                    sp.ImmutableMatrix([[m * taken("m")]]),
                    sp.zeros(1, 1).as_immutable(),
                    sp.zeros(1, 1).as_immutable(),
                    sp.S.Zero,
                ),
                {"m": 1.0},
            ),
            "^M depends on m: needs q and parameters only",
        ),
    ],
)
def test_other_collisions(make, says):
    with pytest.raises(ValueError, match=says):
        make()


def test_gravity_by_its_usual_symbol():
    """The same g in gravity and nowhere else is no collision, nor is g in a link beside another."""
    g = taken("g", real=True)
    assert from_links([Link("revolute", m)], gravity=(0, 0, -g)).parameters == (g, m)
    found = from_links([Link("revolute", m, com=(g, 0, 0))], gravity=(0, taken("down"), 0))
    assert [p.name for p in found.parameters] == ["down", "g", "m"]


# What generated code calls its own: none of it may be taken for a symbol of the user's.
OURS = (
    "q_0 q_1 v_0 v_1 u_0 u_1 k_0 k_1 s_0 c_0 x_0 x_1 t_0 M_0_0 D_0 i_0 W_1_0 L_1_0 y_0 a_0 b_0 w_0"
)
OURS += " q qd u sin cos tan pi E lambda compute sincos tan_s_0 two_c_0 self theta_1"


@settings(max_examples=15)
@given(st.permutations(OURS.split()))
def test_generated_code_takes_no_name_of_ours_for_one_of_its_own(names):
    arm = planar_2r()
    old = (*arm.q, *arm.qd, *arm.parameters)
    new = [sp.Symbol(name) for name in names[: len(old)]]
    swap = dict(zip(old, new, strict=True))
    renamed = Derivation(
        tuple(new[:2]),
        tuple(new[2:4]),
        tuple(new[4:]),
        *(e.xreplace(swap) for e in (arm.M, arm.C, arm.g_vec, arm.P)),
    )
    values = np.linspace(0.4, 1.6, 9)
    model = numpy_model(renamed, {s.name: float(v) for s, v in zip(new[4:], values, strict=True)})
    closed = Planar2R(*values)
    states = np.array([[0.3, 0.4], [1.0, 2.0], [0.1, 0.2]])
    for q, qd, u in (states, np.stack([states, states], axis=1)):
        np.testing.assert_allclose(model.M(q), closed.M(q), rtol=1e-13)
        np.testing.assert_allclose(model.C(q, qd), closed.C(q, qd), atol=1e-13)
        np.testing.assert_allclose(model.g_vec(q), closed.g_vec(q), rtol=1e-13)
        np.testing.assert_allclose(model.dynamics(q, qd, u), closed.dynamics(q, qd, u), rtol=1e-11)
