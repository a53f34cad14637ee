"""The mechanisms: their equations are those that others derive, and bad ones are refused by name."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from armdyn import Planar2R
from autograder.mechanisms import (
    MECHANISMS,
    Coordinate,
    EnergyTerm,
    FrictionTerm,
    Mechanism,
    Parameter,
    joint_friction,
)
from autograder.mechanisms.friction import coefficient
from autograder.mechanisms.kinetic import refuse_other_than_positive
from autograder.mechanisms.unused import refuse_unused
from autograder.mutation.references import reference

EVERY = pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=list(MECHANISMS))
DRAWS = 5


def lagranges_method(mechanism: Mechanism):
    """M and C q̇ + g as SymPy's own route gives them, as a function of numbers."""
    q = dynamicsymbols(" ".join(f"x{i}" for i in range(mechanism.n)) + ",")
    t = dynamicsymbols._t
    moving = dict(zip(mechanism.q, q, strict=True))
    moving |= {v: x.diff(t) for v, x in zip(mechanism.qd, q, strict=True)}
    method = LagrangesMethod((mechanism.K - mechanism.P).xreplace(moving), q)
    method.form_lagranges_equations()
    names = [*mechanism.q, *mechanism.qd, *(p.symbol for p in mechanism.parameters)]
    back = {x.diff(t): v for v, x in zip(mechanism.qd, q, strict=True)}
    back |= dict(zip(q, mechanism.q, strict=True))
    parts = [part.subs(back) for part in (method.mass_matrix, -method.forcing)]
    return sp.lambdify(names, parts)


@EVERY
def test_the_references_are_those_of_lagranges_method(mechanism):
    theirs = lagranges_method(mechanism)
    rng = np.random.default_rng(1)
    for _ in range(DRAWS):
        arm, q, qd = mechanism.drawn(rng), mechanism.placed(rng), mechanism.moving(rng)
        M, bias = theirs(*q, *qd, *vars(arm).values())
        ours = reference(mechanism, "C")(q, qd, arm) @ qd + reference(mechanism, "g_vec")(q, arm)
        np.testing.assert_allclose(reference(mechanism, "M")(q, arm), M, rtol=1e-10, atol=1e-12)
        np.testing.assert_allclose(ours, np.ravel(bias), rtol=1e-10, atol=1e-10)


@EVERY
def test_its_inertia_is_that_of_a_body(mechanism):
    rng = np.random.default_rng(2)
    for _ in range(DRAWS):
        arm, q = mechanism.drawn(rng), mechanism.placed(rng)
        M = reference(mechanism, "M")(q, arm)
        assert np.linalg.eigvalsh(M)[0] > 0
        points = np.array(mechanism.points(q, arm))
        assert points.shape[1] == 2
        assert np.isfinite(points).all()


def test_the_planar_2r_is_the_librarys():
    mechanism, rng = MECHANISMS["planar-2r"], np.random.default_rng(3)
    for _ in range(DRAWS):
        arm, q, qd = mechanism.drawn(rng), mechanism.placed(rng), mechanism.moving(rng)
        model = Planar2R(**vars(arm))
        np.testing.assert_allclose(reference(mechanism, "M")(q, arm), model.M(q), rtol=1e-12)
        np.testing.assert_allclose(
            reference(mechanism, "C")(q, qd, arm), model.C(q, qd), atol=1e-12
        )
        np.testing.assert_allclose(
            reference(mechanism, "g_vec")(q, arm), model.g_vec(q), rtol=1e-12
        )
        P = reference(mechanism, "potential_energy")(q, arm)
        assert pytest.approx(model.potential_energy(q)) == P


@pytest.mark.parametrize("other", ["planar-2r-absolute", "planar-2r-hanging"])
def test_another_zero_of_the_angles_is_the_same_arm(other):
    """One arm in two conventions has one kinetic and, but for a constant, one potential energy."""
    mechanism, rng = MECHANISMS[other], np.random.default_rng(4)
    arm = mechanism.drawn(rng)
    energies = []
    for _ in range(DRAWS):
        q, qd = mechanism.placed(rng), mechanism.moving(rng)
        if other.endswith("absolute"):
            q2, qd2 = np.array([q[0], q[1] - q[0]]), np.array([qd[0], qd[1] - qd[0]])
        else:
            q2, qd2 = q - [np.pi / 2, 0], qd
        model = Planar2R(**vars(arm))
        K = qd @ reference(mechanism, "M")(q, arm) @ qd / 2
        assert pytest.approx(model.kinetic_energy(q2, qd2)) == K
        energies.append(
            reference(mechanism, "potential_energy")(q, arm) - model.potential_energy(q2)
        )
    np.testing.assert_allclose(energies, energies[0], atol=1e-9)


PENDULUM = MECHANISMS["pendulum"]
Q = PENDULUM.q[0]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"coordinates": (Coordinate("m", "rad", "down"),)},
            "two of its symbols are 'm'",
        ),
        (
            {"coordinates": (Coordinate("q", "°", "down"),)},
            "q has the unit '°', needs rad or m",
        ),
        (
            {
                "parameters": (
                    *PENDULUM.parameters[:-1],
                    Parameter("g", "m/s²", "gravity", 3.0, 3.0),
                )
            },
            "g is drawn from 3.0 to 3.0; needs 0 < low < high",
        ),
        (
            {"potential": (EnergyTerm("the weight", sp.Symbol("k") * Q),)},
            "'the weight' holds k, which is neither a coordinate, nor a velocity, nor a parameter",
        ),
        (
            {"potential": (EnergyTerm("the rotation of the body", Q),)},
            "two of its energy terms are 'the rotation of the body'",
        ),
        ({"sentences": ["What falls?"]}, "sentences needs a dict of texts"),
        ({"sentences": {"dropped": "What falls?"}}, "'dropped' does not say of which answer"),
    ],
)
def test_what_is_no_mechanism_is_refused(changes, said):
    with pytest.raises(ValueError, match="mechanism 'pendulum': ") as refused:
        replace(PENDULUM, **changes)
    assert said in str(refused.value)


V = PENDULUM.qd[0]
WEIGHT = PENDULUM.potential[0]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"kinetic": (EnergyTerm("the turn", V**3),)}, "'the turn' of K is not quadratic in the"),
        ({"kinetic": (EnergyTerm("the turn", V**2 + V),)}, "'the turn' of K is not quadratic"),
        ({"kinetic": (EnergyTerm("the turn", sp.cos(Q)),)}, "'the turn' of K is not quadratic"),
        (
            {"potential": (EnergyTerm("the spring", V**2),)},
            "'the spring' of P holds qd, a velocity",
        ),
        (
            {"potential": (EnergyTerm("the spring", PENDULUM.parameters[0]),)},
            "'the spring' of P is no expression",
        ),
        ({"potential": WEIGHT}, "potential needs a tuple of EnergyTerm, as (EnergyTerm(…),)"),
        ({"name": "my block"}, "needs a name of small letters, digits and hyphens, as cart-pole"),
        (
            {"parameters": (*PENDULUM.parameters, Parameter("lambda", "N/m", "spring", 1, 2))},
            "the name 'lambda' needs letters and digits alone, and to be no word of Python's",
        ),
        (
            {"parameters": (*PENDULUM.parameters, Parameter("k 1", "N/m", "spring", 1, 2))},
            "the name 'k 1' needs letters and digits",
        ),
        (
            {"parameters": (*PENDULUM.parameters, Parameter("k", "", "spring", 1, 2))},
            "k needs a unit",
        ),
        ({"points": lambda q, arm: [(q[1], 0.0)]}, "points raised IndexError"),
        ({"points": lambda q, arm: [q[0]]}, "points gave (1,), needs one (x, y)"),
    ],
)
def test_what_would_fail_later_is_refused_at_once(changes, said):
    with pytest.raises(ValueError, match=r"^mechanism ") as refused:
        replace(PENDULUM, **changes)
    assert said in str(refused.value)


DRAG = coefficient("viscous", "q")
B = FrictionTerm("the drag", "q", "viscous", "N·m·s/rad", DRAG * V)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"torque": -DRAG * V}, "'the drag' drives q; it must resist"),
        ({"torque": DRAG}, "'the drag' drives q; it must resist"),
        ({"torque": sp.Symbol("k") * V}, "'the drag' holds k; it is made of its coefficient"),
        ({"torque": DRAG * Q * V}, "'the drag' holds q; it is made of its coefficient"),
        ({"coordinate": "x"}, "'the drag' resists 'x', which is none of its coordinates"),
        ({"coefficient": "lc"}, "the coefficient 'lc' of 'the drag' needs letters alone"),
        ({"coefficient": "drag_1"}, "the coefficient 'drag_1' of 'the drag' needs letters alone"),
        ({"low": 2.0, "high": 1.0}, "the coefficient of 'the drag' is drawn from 2.0 to 1.0"),
        ({"name": "the weight of the body"}, "two of its terms are 'the weight of the body'"),
    ],
)
def test_what_is_no_friction_is_refused(changes, said):
    with pytest.raises(ValueError, match=r"^mechanism 'pendulum'") as refused:
        replace(PENDULUM, friction=(replace(B, **changes),))
    assert said in str(refused.value)


def test_one_coefficient_stands_for_one_term():
    with pytest.raises(ValueError, match="two of its coefficients of friction are 'viscous_q'"):
        replace(PENDULUM, friction=(B, replace(B, name="the air")))


@EVERY
def test_friction_is_drawn_only_where_it_is_asked_for(mechanism):
    """And it changes nothing else of the arm."""
    plain, rough = (
        mechanism.drawn(np.random.default_rng(6), friction) for friction in (False, True)
    )
    kinds = {term.coefficient for term in mechanism.friction}
    assert vars(rough).keys() - vars(plain).keys() == kinds
    assert {name: vars(rough)[name] for name in vars(plain)} == vars(plain)
    for kind in kinds:
        assert vars(rough)[kind].shape == (mechanism.n,)
        assert (vars(rough)[kind] > 0).all()


def test_lists_are_taken_for_tuples():
    assert replace(PENDULUM, kinetic=list(PENDULUM.kinetic)).kinetic == PENDULUM.kinetic


X, THETA = Coordinate("x", "m", "the left end"), Coordinate("theta", "rad", "down")
MASS, STIFF = Parameter("m", "kg", "mass", 1.0, 2.0), Parameter("k", "N/m", "stiffness", 1.0, 2.0)


def _with(term, stiffness="N/m"):
    """A block on a track with this term of P."""
    return Mechanism(
        "block",
        (X, THETA),
        (MASS, replace(STIFF, unit=stiffness)),
        (EnergyTerm("the motion", MASS.symbol * X.velocity**2 / 2),),
        (EnergyTerm("the spring", term),),
        lambda q, arm: [(q[0], 0.0)],
    )


x, theta, k = X.symbol, THETA.symbol, STIFF.symbol


@pytest.mark.parametrize(
    ("term", "said"),
    [
        (k * x**3, "'the spring' of P has the unit N·m², an energy needs J"),
        (k * x, "'the spring' of P has the unit N, an energy needs J"),
        (k * x**2 * THETA.symbol + k * x, "cannot be added or compared"),
        (k * (x - sp.Rational(1, 10)) ** 2, "a number that has a unit is a Parameter"),
        (k * x**2 * sp.cos(x), "cos(x) has an argument in m; it needs an angle in rad"),
        (k ** sp.Rational(3, 2) * x**2, "has the unit kg^(3/2)·m²/s³, an energy needs J"),
        (k * x**2 * 2**x, "2 has the power x, which needs to be a number"),
    ],
)
def test_a_term_that_is_no_energy_is_refused(term, said):
    with pytest.raises(ValueError, match=r"^mechanism 'block': 'the spring' of P") as refused:
        _with(term)
    assert said in str(refused.value)


@pytest.mark.parametrize(
    "term",
    [
        k * x**2 * sp.cos(2 * theta) / 2,
        k * sp.sqrt(x**4) * sp.exp(theta),
        k * x**2 * sp.atan2(x, 2 * x) * 2**theta,
        k * sp.Abs(x) * sp.Max(x, 2 * x),
        sp.S.Zero,
    ],
)
def test_a_term_that_is_an_energy_is_taken(term):
    assert _with(term).potential[0].energy == term


@pytest.mark.parametrize("unit", ["N/m", "kg/s²", "kg s^-2", "kg·m/(m·s²)", "J/m²", "N * m / m**2"])
def test_one_unit_written_in_other_ways(unit):
    _with(k * x**2, unit)


@pytest.mark.parametrize(
    ("unit", "said"),
    [
        ("N/cm", "k: the unit 'N/cm' holds 'cm'; known are kg, m, s, rad, 1, N, J, W, Hz"),
        ("N··m", "k: the unit 'N··m' holds ''"),
        ("kg/m·s", "k: the unit 'kg/m·s' may be read in two ways; write …/(…)"),
    ],
)
def test_a_unit_that_is_not_known(unit, said):
    with pytest.raises(ValueError, match=r"^mechanism 'block': k: ") as refused:
        _with(k * x**2, unit)
    assert said in str(refused.value)


@EVERY
def test_its_kinetic_energy_is_positive(mechanism):
    refuse_other_than_positive(mechanism)


def test_a_kinetic_energy_that_is_not_names_the_motion():
    cart = MECHANISMS["cart-pole"]
    for factor, said in [
        (-1, "K is negative for a motion with "),
        (0, "K is 0 for a motion with "),
    ]:
        scaled = tuple(replace(term, energy=factor * term.energy) for term in cart.kinetic)
        with pytest.raises(ValueError, match=said):
            refuse_other_than_positive(replace(cart, kinetic=scaled))


def test_one_of_several_coordinates_is_not_called_q():
    cart = MECHANISMS["cart-pole"]
    with pytest.raises(ValueError, match="'q' is the vector of all its coordinates"):
        replace(cart, coordinates=(Coordinate("q", "m", "the left end"), cart.coordinates[1]))


@pytest.mark.parametrize("joint", ["x", ("x", "the cart"), (Coordinate("x", "m", "the left end"),)])
def test_friction_of_what_is_no_coordinate(joint):
    with pytest.raises(ValueError, match="joint_friction needs a coordinate and its words"):
        joint_friction(joint)


@EVERY
def test_no_parameter_stands_nowhere(mechanism):
    refuse_unused(mechanism)
    idle = Parameter("zz", "m", "length of nothing", 0.1, 0.2)
    with pytest.raises(ValueError, match="the parameter 'zz' is in no energy"):
        refuse_unused(replace(mechanism, parameters=(*mechanism.parameters, idle)))
