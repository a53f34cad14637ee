from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from armdyn.codegen import numpy_model
from armdyn.derive import (
    Link,
    christoffel_symbols,
    from_energies,
    from_lagrangian,
    from_links,
    planar_2r,
    planar_chain,
)
from tests.armdyn import derivations
from tests.armdyn.derivations import EXAMPLES, numbers, states, values

q, qd, m, l, g = sp.symbols("q qd m l g", real=True)


def zero(difference):
    return sp.simplify(sp.Matrix(difference).doit()).is_zero_matrix


@pytest.mark.parametrize("arm", [planar_2r(), planar_chain(2)], ids=["planar_2r", "planar_chain"])
def test_recovers_the_2r(arm):
    l1, _, lc1, lc2, m1, m2, I1, I2, grav = arm.parameters
    assert " ".join(p.name for p in arm.parameters) == "l1 l2 lc1 lc2 m1 m2 I1 I2 g"
    (q1, q2), (v1, v2) = arm.q, arm.qd
    M12 = I2 + m2 * (lc2**2 + l1 * lc2 * sp.cos(q2))
    M11 = I1 + I2 + m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * sp.cos(q2))
    h = -m2 * l1 * lc2 * sp.sin(q2)
    tip = m2 * lc2 * grav * sp.cos(q1 + q2)
    P = m1 * grav * lc1 * sp.sin(q1) + m2 * grav * (l1 * sp.sin(q1) + lc2 * sp.sin(q1 + q2))
    assert zero(arm.M - sp.Matrix([[M11, M12], [M12, I2 + m2 * lc2**2]]))
    assert zero(arm.C - sp.Matrix([[h * v2, h * (v1 + v2)], [-h * v1, 0]]))
    assert zero(arm.g_vec - sp.Matrix([(m1 * lc1 + m2 * l1) * grav * sp.cos(q1) + tip, tip]))
    assert zero([arm.P - P])


def test_recovers_the_pendulum():
    I, lc = sp.symbols("I lc", real=True)
    pendulum = from_energies(I * qd**2 / 2, m * g * lc * (1 - sp.cos(q)), [q], [qd])
    assert zero(pendulum.M - sp.Matrix([[I]]))
    assert zero(pendulum.C)
    assert pendulum.g_vec == sp.Matrix([m * g * lc * sp.sin(q)])
    assert [p.name for p in pendulum.parameters] == ["I", "g", "lc", "m"]


def test_cart_pole():
    found = derivations.cart_pole()
    names = {s.name: s for s in (*found.parameters, *found.q, *found.qd)}
    M, m, l, g, a, ad = (names[k] for k in ("M", "m", "l", "g", "theta", "thetad"))
    coupling = m * l * sp.cos(a)
    assert zero(found.M - sp.Matrix([[M + m, coupling], [coupling, m * l**2]]))
    assert zero(found.C - sp.Matrix([[0, -m * l * sp.sin(a) * ad], [0, 0]]))
    assert zero(found.g_vec - sp.Matrix([0, m * g * l * sp.sin(a)]))


def test_revolute_prismatic_arm():
    found = derivations.revolute_prismatic()
    I1, I2, g, lc, m1, m2 = found.parameters
    (q1, q2), (v1, v2) = found.q, found.qd
    assert zero(found.M - sp.diag(I1 + I2 + m1 * lc**2 + m2 * q2**2, m2))
    assert zero(found.C - m2 * q2 * sp.Matrix([[v2, v1], [-v1, 0]]))
    torque = (m1 * lc + m2 * q2) * g * sp.cos(q1)
    assert zero(found.g_vec - sp.Matrix([torque, m2 * g * sp.sin(q1)]))


def test_spherical_pendulum():
    found = derivations.spherical_pendulum()
    g, l, m = found.parameters
    (a, _), (ad, bd) = found.q, found.qd
    s, c = sp.sin(a), sp.cos(a)
    assert zero(found.M - m * l**2 * sp.diag(1, s**2))
    assert zero(found.C - m * l**2 * s * c * sp.Matrix([[0, -bd], [bd, ad]]))
    assert zero(found.g_vec - sp.Matrix([m * g * l * s, 0]))


def test_payload_makes_a_heavier_second_link():
    found, bare = derivations.arm_with_payload(), planar_2r()
    l1, l2, _, lc2, _, m2, _, I2, _ = bare.parameters
    load = sp.Symbol("load", real=True)
    # The parallel-axis theorem, with the load at the end of link 2.
    together = (m2 * lc2 + load * l2) / (m2 + load)
    about = I2 + m2 * (lc2 - together) ** 2 + load * (l2 - together) ** 2
    heavier = {m2: m2 + load, lc2: together, I2: about}
    for name in ("M", "C", "g_vec"):
        changed = getattr(bare, name).subs(heavier, simultaneous=True)
        assert zero(getattr(found, name) - changed), name
    assert l1 in found.parameters
    assert load in found.parameters


def chain_of_links(n):
    """planar_chain(n, offsets=True) by M = Σ JᵀIJ and its derivatives."""
    names = {
        name: sp.symbols(f"{name}1:{n + 1}", real=True) for name in ("l", "lc", "ly", "m", "I")
    }
    links = [
        Link(
            "revolute",
            names["m"][i],
            position=(names["l"][i - 1] if i else 0, 0, 0),
            com=(names["lc"][i], names["ly"][i], 0),
            inertia=sp.diag(0, 0, names["I"][i]),
        )
        for i in range(n)
    ]
    return from_links(links, gravity=(0, -sp.Symbol("g", real=True), 0))


@pytest.mark.parametrize("n", [1, 2, 3])
def test_chain_is_the_chain_of_its_links(n):
    chain, links = planar_chain(n, offsets=True), chain_of_links(n)
    for seed in range(3):
        given = values(chain, seed)
        place = states(n, parts=2, seed=seed)
        for name in ("M", "C", "g_vec"):
            one = numbers(getattr(chain, name), chain, given, *place)
            other = numbers(getattr(links, name), links, given, *place)
            assert one == pytest.approx(other, rel=1e-12, abs=1e-12), name
        one, other = (numbers([d.P], d, given, *place) for d in (chain, links))
        assert one == pytest.approx(other, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("name", EXAMPLES)
def test_structure(name):
    """M symmetric, C the Christoffel one (by h), Ṁ = C + Cᵀ, g = ∂P/∂q; at a state, to 30 digits."""
    d = EXAMPLES[name]()
    given, place = values(d), states(d.n, parts=2)
    h = d.christoffel()
    C = sp.Matrix(d.n, d.n, lambda i, j: sum(h[i, j, k] * d.qd[k] for k in range(d.n)))
    M_dot = sum((d.M.diff(x) * v for x, v in zip(d.q, d.qd, strict=True)), sp.zeros(d.n, d.n))
    for found, needed in (
        (d.M, d.M.T),
        (d.C, C),
        (d.C + d.C.T, M_dot),
        (d.g_vec, [d.P.diff(x) for x in d.q]),
    ):
        a, b = numbers(found, d, given, *place), numbers(needed, d, given, *place)
        assert a == pytest.approx(b, rel=1e-13, abs=1e-13)


@pytest.mark.parametrize("name", ["cart-pole", "spherical pendulum", "2R"])
def test_equations_are_lagranges(name):
    """Beside SymPy's own LagrangesMethod, which knows nothing of M, C, g."""
    d = EXAMPLES[name]()
    t = dynamicsymbols._t
    functions = [sp.Function(f"x{i}")(t) for i in range(d.n)]
    rates = [f.diff(t) for f in functions]
    moving = {**dict(zip(d.q, functions, strict=True)), **dict(zip(d.qd, rates, strict=True))}
    velocity = sp.Matrix(d.qd)
    L = ((velocity.T * d.M * velocity)[0] / 2 - d.P).subs(moving)
    theirs = LagrangesMethod(L, functions).form_lagranges_equations()
    qdd, u = sp.symbols(f"a:{d.n}"), sp.symbols(f"b:{d.n}")
    back = [(f.diff(t, 2), a) for f, a in zip(functions, qdd, strict=True)]
    back += [(r, v) for r, v in zip(rates, d.qd, strict=True)]
    back += [(f, x) for f, x in zip(functions, d.q, strict=True)]
    theirs = theirs.subs(back)
    equations = d.equations(qdd, u)
    assert [e.rhs for e in equations] == list(u)
    accelerate = {a: sp.Rational(k + 1, 3) for k, a in enumerate(qdd)}
    given, place = values(d), states(d.n, parts=2)
    mine = numbers([e.lhs.subs(accelerate) for e in equations], d, given, *place)
    needed = numbers(theirs.subs(accelerate), d, given, *place)
    assert mine == pytest.approx(needed, rel=1e-12, abs=1e-12)


def test_sharing_survives():
    # Ten links: suffix sums keep the growth at n². Flattened, they would lose it.
    for n, most in ((2, 80), (6, 500), (10, 1200)):
        chain = planar_chain(n)
        steps, results = sp.cse([chain.M, chain.C, chain.g_vec])
        count = sum(e.count_ops() for _, e in steps)
        count += sum(e.count_ops() for matrix in results for e in matrix)
        assert count <= most, n


def test_christoffel_symbols_by_hand():
    a, b = sp.symbols("a b")
    h = christoffel_symbols(sp.Matrix([[b**2, 0], [0, 1]]), (a, b))
    assert (h[0, 0, 1], h[0, 1, 0], h[1, 0, 0], h[1, 1, 1]) == (b, b, -b, 0)


def test_symbols_and_functions_give_the_same():
    t = dynamicsymbols._t
    f = dynamicsymbols("q1")
    by_time = from_energies(m * f.diff(t) ** 2 * f**2, m * g * f, [f])
    q1, qd1 = sp.symbols("q1 qd1", real=True)
    assert by_time == from_energies(m * qd1**2 * q1**2, m * g * q1, [q1], [qd1])


def test_a_lagrangian_may_hide_that_it_is_quadratic():
    K = ((qd + 1) ** 3 - qd**3 - 3 * qd - 1) * m / 6
    K += m * qd * (sp.sin(q) ** 2 + sp.cos(q) ** 2 - 1)
    assert from_lagrangian(K - m * g * q, [q], [qd]).M.doit() == sp.Matrix([[m]])


@pytest.mark.parametrize(
    ("K", "complaint"),
    [
        (m * qd**3, r"the term m\*qd\*\*3 is not quadratic"),
        (m * qd**2 + m * qd**4, r"the term m\*qd\*\*4 is not quadratic"),
        (m * qd**2 - sp.sqrt(1 - qd**2), r"the term -sqrt\(1 - qd\*\*2\) is not quadratic"),
        (m * qd * sp.Abs(qd), r"the term m\*qd\*Abs\(qd\) is not quadratic"),
        (m * qd**2 + l * qd * q, r"the term l\*q\*qd is linear in q̇ \(a gyroscopic"),
        (m * (qd + l) ** 2, r"the term 2\*l\*m\*qd is linear in q̇"),
    ],
)
def test_names_the_term_that_is_not_quadratic(K, complaint):
    with pytest.raises(ValueError, match=complaint):
        from_lagrangian(K - m * g * q, [q], [qd])
    with pytest.raises(ValueError, match=complaint):
        from_energies(K, m * g * q, [q], [qd])


f, t = dynamicsymbols("q"), dynamicsymbols._t


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: from_energies(m * qd**2 + m * q**2, 0, [q], [qd]), r"m\*q\*\*2 does not depend"),
        (lambda: from_energies(m * qd**2, m * qd, [q], [qd]), r"P = m\*qd: depends on qd"),
        (lambda: from_energies(m * qd**2, 0, [q]), "qd: needs 1 symbols"),
        (lambda: from_energies(m * qd**2, 0, [q], [q]), "all different"),
        (lambda: from_energies(m * qd**2, 0, [q, l], [qd]), "as many velocities"),
        (lambda: from_energies(m * qd**2, 0, [q + l], [qd]), r"dynamicsymbols\('q1 q2'\)"),
        (lambda: from_energies(m * f.diff() ** 2, 0, [q], [qd]), "pass the functions of time as q"),
        (lambda: from_energies(m * f.diff() ** 2, 0, [f], [qd]), "leave qd out"),
        (lambda: from_energies(m * f.diff() ** 2 * sp.exp(t), 0, [f]), "depends on time"),
        (lambda: from_energies("m q", 0, [q], [qd]), "K = 'm q': needs a SymPy expression"),
        (lambda: from_energies(sp.eye(2), 0, [q], [qd]), "needs a SymPy expression"),
        (lambda: from_energies(m * qd**2, 0, 3, [qd]), "q = 3: needs a sequence"),
        (lambda: planar_chain(0), "n = 0: needs a positive integer"),
        (lambda: planar_chain(True), "n = True: needs a positive integer"),
        (lambda: from_links([]), "needs one or more Link"),
        (lambda: from_links([Link("revolute", m)], q=[q, l]), "needs 1 SymPy symbols"),
        (lambda: from_links([Link("revolute", m)], gravity=(0, 1)), r"gravity .* shape \(3,\)"),
        (lambda: Link("spherical", m), "needs one of revolute, prismatic"),
        (lambda: Link("revolute", m, axis=(1, 1, 0)), "axis = .* length 1"),
        (lambda: Link("revolute", m, com=(1, 0)), r"com = \(1, 0\): needs shape \(3,\)"),
        (lambda: Link("revolute", sp.eye(3)), "mass = "),
        (lambda: Link("revolute", m, inertia=sp.Matrix(3, 3, range(9))), "symmetric"),
        (lambda: planar_2r().equations([1], [0, 0]), "qdd: got 1 entries, needs 2"),
    ],
)
def test_refuses(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()


def test_friction_stands_on_the_left_beside_gravity():
    arm = planar_2r()
    d, k = sp.symbols("d1 d2"), sp.symbols("k1 k2")
    rubbing = arm.with_friction(viscous=d, coulomb=k)
    assert rubbing.parameters == (*arm.parameters, *d, *k)
    assert rubbing.f_vec == sp.Matrix([d[i] * v + k[i] * sp.sign(v) for i, v in enumerate(arm.qd)])
    qdd, u = sp.symbols("a1 a2"), sp.symbols("u1 u2")
    for with_f, without, f in zip(
        rubbing.equations(qdd, u), arm.equations(qdd, u), rubbing.f_vec, strict=True
    ):
        assert (with_f.lhs - without.lhs - f).expand() == 0
    at_rest = rubbing.f_vec.subs(dict.fromkeys(arm.qd, 0))
    assert at_rest.is_zero_matrix


def test_frictions_add():
    arm = planar_2r()
    d, k = sp.symbols("d1 d2"), sp.symbols("k1 k2")
    both = arm.with_friction(viscous=d).with_friction(coulomb=k)
    assert both == arm.with_friction(viscous=d, coulomb=k)
    assert arm.with_friction() == arm
    assert arm.f_vec.is_zero_matrix
    # A coefficient may be one that the model has, a number, or a function of q̇.
    stribeck = arm.with_friction(coulomb=[arm.parameters[0] * sp.exp(-(arm.qd[0] ** 2)), 0.5])
    assert stribeck.parameters == arm.parameters


@pytest.mark.parametrize(
    ("friction", "complaint"),
    [
        ({"viscous": [1]}, "viscous: got 1 entries, needs 2, one per coordinate"),
        ({"coulomb": sp.symbols("a b c")}, "coulomb: got 3 entries"),
        ({"viscous": sp.Symbol("d")}, "viscous = d: needs a sequence of 2"),
        ({"coulomb": [0, sp.Symbol("q1", real=True)]}, r"coulomb\[1\] = q1: depends on q1"),
        ({"viscous": [sp.Function("q1")(sp.Symbol("t")), 0]}, r"viscous\[0\] = .*depends on q1"),
        ({"viscous": [sp.true, 0]}, r"viscous\[0\] = True: needs a symbol or an expression"),
        ({"viscous": [sp.Symbol("l1"), 0]}, "l1 is not the model's own symbol l1"),
        ({"viscous": [sp.Symbol("qd1"), 0]}, "qd1 is not the model's own symbol qd1"),
    ],
)
def test_bad_friction_is_named(friction, complaint):
    with pytest.raises(ValueError, match=complaint):
        planar_2r().with_friction(**friction)


@pytest.mark.parametrize(
    ("f", "complaint"),
    [
        ([[0]], r"f_vec = .*needs shape \(2, 1\)"),
        (sp.zeros(1, 2), r"f_vec = .*needs shape \(2, 1\)"),
        ("f", r"f_vec = 'f': needs shape \(2, 1\)"),
        ([sp.Symbol("q1", real=True), 0], "f_vec depends on q1: friction is a function of q̇ and"),
        ([sp.Symbol("mu"), 0], "f_vec depends on mu"),
    ],
)
def test_friction_depends_on_velocities_and_parameters_alone(f, complaint):
    with pytest.raises(ValueError, match=complaint):
        replace(planar_2r(), f_vec=f)


@pytest.mark.parametrize("x", [0.0, 1e-9, -1e-4, 0.2, 0.25, 0.3, -3.0])
def test_sinc_has_slopes_everywhere(x):
    q, v = sp.symbols("q v", real=True)
    d = from_energies((2 + sp.sinc(q)) * v**2, 5 * sp.sinc(q), [q], [v])
    model = numpy_model(d, {})
    near = sp.series(sp.sin(q) / q, q, 0, 30).removeO()
    first, second = (float(near.diff(q, k).subs(q, sp.Rational(x))) for k in (1, 2))
    assert model.g_vec([x]) == pytest.approx([5 * first], abs=1e-14)
    assert model.C([x], [2.0]) == pytest.approx(np.array([[2 * first]]), abs=1e-14)
    slope = model.slope_in_q([x], [0.0], [0.0])
    assert slope == pytest.approx(np.array([[5 * second]]), abs=1e-12)
