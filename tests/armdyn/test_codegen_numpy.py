import pickle

import numpy as np
import pytest
import sympy as sp
from hypothesis import given

from armdyn.codegen import numpy_model
from armdyn.codegen.buffers import in_buffers
from armdyn.codegen.numpy_function import BLOCK
from armdyn.derive import Derivation, from_energies, planar_2r, planar_chain
from armdyn.manipulator import Manipulator
from tests.armdyn.arms import a_few, arms_and_states, assert_close, planar_arms
from tests.armdyn.derivations import (
    EXAMPLES,
    hiding,
    numbers,
    parameters,
    states,
    values,
    with_friction,
)

DERIVED = {"textbook": with_friction(planar_2r()), "chain": with_friction(planar_chain(2))}


@pytest.mark.parametrize("name", EXAMPLES)
def test_terms_are_the_derivations(name):
    d = EXAMPLES[name]()
    chosen, (q, qd) = values(d), states(d.n, parts=2)
    model = numpy_model(d, chosen)
    for found, expression in (
        (model.M(q), d.M),
        (model.C(q, qd), d.C),
        (model.g_vec(q)[:, np.newaxis], d.g_vec),
        (model.potential_energy(q)[np.newaxis, np.newaxis], [d.P]),
    ):
        needed = numbers(expression, d, chosen, q, qd)
        assert found == pytest.approx(needed, rel=1e-13, abs=1e-13)


@pytest.mark.parametrize("name", EXAMPLES)
def test_dynamics_undoes_inverse_dynamics(name):
    d = EXAMPLES[name]()
    model = numpy_model(d, values(d))
    q, qd, qdd = states(d.n, batch=(2, 5))
    u = model.inverse_dynamics(q, qd, qdd)
    assert_close(model.dynamics(q, qd, u), qdd, tolerance=1e-11)
    assert_close(model.dynamics(q[0, 0], qd[0, 0], u[0, 0]), qdd[0, 0], tolerance=1e-11)


@pytest.mark.parametrize("derived", DERIVED.values(), ids=DERIVED)
@a_few
@given(arms_and_states(planar_arms()))
def test_agrees_with_the_closed_form(derived, arm_and_states):
    arm, q, qd, u = arm_and_states
    model = numpy_model(derived, parameters(arm))
    M, C = arm.M(q), arm.C(q, qd)
    assert_close(model.M(q), M, 0, 1e-13)
    assert_close(model.C(q, qd), C, np.max(np.abs(M)) * 30, 1e-13)
    weight = arm.g * (arm.m1 * abs(arm.lc1) + arm.m2 * (arm.l1 + abs(arm.lc2)))
    assert_close(model.g_vec(q), arm.g_vec(q), weight, 1e-13)
    assert_close(model.f_vec(qd), arm.f_vec(qd), 0, 1e-13)
    assert_close(model.potential_energy(q), arm.potential_energy(q), weight, 1e-13)
    # What rounding of M, C q̇ and g may do to q̈, through the conditioning of M.
    spread = np.linalg.cond(M).max() * max(1.0, np.max(np.abs(arm.dynamics(q, qd, u))))
    assert_close(model.dynamics(q, qd, u), arm.dynamics(q, qd, u), spread, 1e-13)


def test_a_batch_over_many_blocks_is_its_states():
    d = planar_2r()
    model = numpy_model(d, values(d))
    q, qd, u = states(2, batch=(2 * BLOCK + 3,))
    found = model.dynamics(q, qd, u)
    for k in (0, BLOCK - 1, BLOCK, 2 * BLOCK + 2):
        assert_close(found[k], model.dynamics(q[k], qd[k], u[k]), tolerance=1e-13)
    assert np.array_equal(found, model.dynamics(q.tolist(), qd, u))


def test_results_and_inputs_are_not_the_buffers():
    d = planar_chain(3)
    model = numpy_model(d, values(d))
    first, second = (states(3, batch=(5,), seed=seed) for seed in (1, 2))
    kept = [s.copy() for s in first]
    found = [model.dynamics(*first), model.M(first[0]), model.C(*first[:2])]
    before = [f.copy() for f in found]
    model.dynamics(*second), model.M(second[0]), model.C(*second[:2])
    assert all(map(np.array_equal, [*found, *first], [*before, *kept]))


def test_no_value_is_overwritten_before_its_last_use():
    # Written out as operators and in buffers: the same operations in the same order.
    lines = [
        "c = a*b + a",
        "d = (c - b)*(c - b) - c/a",
        "e = select([c > d], [c], d)",
        "f = -e + a",
    ]
    results = ["f", "c*d", "a", "k", "2"]
    lines += ["h = f*b", "same = real(h)", "i = h + same", "j = -i*a"]  # a view of h
    results.append("same*j")
    names = {**vars(np), "a": np.linspace(1, 2, 7), "b": np.linspace(-1, 3, 7), "k": 3.0}
    buffered, found, count = in_buffers(lines, results, ["a", "b"])
    buffers = np.full((count, 7), np.nan)
    plain, reused = dict(names), names | {f"b_{i}": b for i, b in enumerate(buffers)}
    exec("\n".join(lines), plain)
    exec("\n".join(buffered), reused)
    for needed, got in zip(results, found, strict=True):
        assert np.array_equal(eval(needed, plain), eval(got, reused))


def test_buffers_are_few():
    lines = ["x_0 = a + b", *(f"x_{i + 1} = x_{i}*a + b*{i}" for i in range(50))]
    assert in_buffers(lines, ["x_50"], ["a", "b"])[2] <= 4


def test_batch_axes_broadcast():
    d = planar_chain(3)
    model = numpy_model(d, values(d))
    q, qd, u = states(3, batch=(4,))
    wide = model.dynamics(q[:, np.newaxis], qd, u[0])
    assert wide.shape == (4, 4, 3)
    assert_close(wide[2, 1], model.dynamics(q[2], qd[1], u[0]), tolerance=1e-13)
    assert model.M(q[:0]).shape == (0, 3, 3)
    assert model.dynamics(q[:0], qd[:0], u[:0]).shape == (0, 3)
    assert model.C(q[0], qd).shape == (4, 3, 3)


def test_is_a_manipulator():
    d = planar_chain(2)
    model = numpy_model(d, values(d))
    assert isinstance(model, Manipulator)
    q, qd, u = states(2, batch=(7,))
    again = pickle.loads(pickle.dumps(model))
    assert np.array_equal(again.dynamics(q, qd, u), model.dynamics(q, qd, u))
    assert model.f_vec(qd) == pytest.approx(0)
    assert model.state_derivative(np.concatenate([q, qd], -1), u).shape == (7, 4)


def test_a_singular_inertia_is_refused_and_located():
    d = planar_2r()
    model = numpy_model(d, {**values(d), "I1": 0.0, "I2": 0.0, "lc2": 0.0})
    q = np.ones((5, 2))
    with pytest.raises(np.linalg.LinAlgError, match="singular at q"):
        model.dynamics(q, q, q)
    with pytest.raises(np.linalg.LinAlgError, match="singular at q"):
        model.dynamics(q[0], q[0], q[0])


def test_nearly_singular_is_left_to_the_reference():
    d = planar_2r()
    model = numpy_model(d, {**values(d), "I2": 1e-13, "lc2": 0.0})
    q, qd, u = states(2)
    assert np.array_equal(model.dynamics(q, qd, u), Manipulator.dynamics(model, q, qd, u))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("which", range(3))
@pytest.mark.parametrize("batch", [(), (3,)])
def test_what_is_not_finite_is_named(bad, which, batch):
    d = planar_2r()
    model = numpy_model(d, values(d))
    given_states = list(states(2, batch=batch))
    given_states[which][..., 1] = bad
    with pytest.raises(ValueError, match=rf"{['q', 'qd', 'u'][which]}\[.*needs finite numbers"):
        model.dynamics(*given_states)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("which", range(2))
@pytest.mark.parametrize("batch", [(), (3,)])
def test_what_is_not_finite_is_named_where_the_acceleration_is(bad, which, batch):
    model = numpy_model(hiding(), {})
    given_states = [np.zeros((*batch, 1)) for _ in range(3)]
    assert np.isfinite(model.dynamics(*given_states)).all()
    given_states[which][..., 0] = bad
    with pytest.raises(ValueError, match=rf"{['q', 'qd'][which]}\[.*needs finite numbers"):
        model.dynamics(*given_states)


def test_wrong_shapes_are_named():
    d = planar_2r()
    model = numpy_model(d, values(d))
    with pytest.raises(ValueError, match=r"qd: got shape \(3,\), needs .*\(\.\.\., 2\)"):
        model.dynamics(np.zeros(2), np.zeros(3), np.zeros(2))
    with pytest.raises(ValueError, match="broadcast"):
        model.dynamics(np.zeros((2, 2)), np.zeros((3, 2)), np.zeros(2))


def test_any_name_will_do():
    # Names that Python, NumPy or the generated code use themselves.
    q, qd = sp.symbols("lambda x_0")
    odd = sp.symbols("k_0 sin for α s_0")
    P = odd[1] * sp.sin(q) * odd[3] + odd[2] * sp.cos(q) + odd[4] * q
    model = numpy_model(from_energies(odd[0] * qd**2 / 2, P, [q], [qd]), dict.fromkeys(
        (s.name for s in odd), 2.0
    ))  # fmt: skip
    assert model.g_vec([0.3])[0] == pytest.approx(4 * np.cos(0.3) - 2 * np.sin(0.3) + 2)
    assert model.dynamics([0.3], [1.0], [0.0])[0] == pytest.approx(-model.g_vec([0.3])[0] / 2)


def test_functions_other_than_sine_and_cosine():
    q, qd = sp.symbols("q qd", real=True)
    K = sp.exp(-q) * (1 + sp.sin(sp.cos(q))) * qd**2
    P = sp.sqrt(1 + q**2) + sp.Piecewise((q, q > 0), (q**3, True)) + sp.tan(q) + sp.Abs(q)
    d = from_energies(K, P, [q], [qd])
    model = numpy_model(d, {})
    for x in (-0.7, 0.4):
        needed = numbers([*d.M, *d.C, *d.g_vec], d, {}, [x], [2.0])[:, 0]
        for form in (np.array([x]), np.array([[x]])):
            found = [model.M(form), model.C(form, form * 0 + 2), model.g_vec(form)]
            assert np.concatenate([f.ravel() for f in found]) == pytest.approx(needed, rel=1e-13)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"m1": None}, "values: needs a number for m1"),
        ({"m9": 1.0}, "the derivation has no parameter m9"),
        ({"m1": np.nan}, r"values\['m1'\] = nan: needs one finite number"),
        ({"m1": "1"}, r"values\['m1'\] = '1'"),
    ],
)
def test_bad_values_are_named(change, complaint):
    d = planar_2r()
    chosen = {k: v for k, v in {**values(d), **change}.items() if v is not None}
    with pytest.raises(ValueError, match=complaint):
        numpy_model(d, chosen)


def test_two_parameters_of_one_name_are_refused():
    q, qd = sp.symbols("q qd", real=True)
    K, P = sp.Symbol("m") * qd**2 / 2, sp.Symbol("m", positive=True) * q
    with pytest.raises(ValueError, match="K and P: 2 different symbols are called m"):
        from_energies(K, P, [q], [qd])


def test_other_bad_models():
    q, qd, m = sp.symbols("q qd m")
    with pytest.raises(ValueError, match="needs a mapping"):
        numpy_model(planar_2r(), [1.0])
    reciprocal = numpy_model(from_energies(qd**2 / m, 0, [q], [qd]), {"m": 0.0})
    with pytest.raises(ValueError, match="no finite value"):
        reciprocal.M([0.0])
    unknown = sp.Function("h")(q)
    one = sp.ImmutableMatrix([[unknown]])
    with pytest.raises(ValueError, match=r"contains h\(q\)"):
        numpy_model(Derivation((q,), (qd,), (), one, one, one, sp.S.Zero), {})


@pytest.mark.parametrize("seed", range(6))
def test_an_inertia_singular_by_cancellation_is_refused(seed):
    # Stretched out, with both masses at the ends of massless links: no entry of M is 0, its
    # determinant is, and what rounding leaves of the last pivot may have either sign.
    d = planar_2r()
    model = numpy_model(d, {**values(d, seed), "I1": 0.0, "I2": 0.0, "lc1": 0.0})
    q = np.array([0.3, 0.0])
    with pytest.raises(np.linalg.LinAlgError, match="singular at q"):
        model.dynamics(q, q, q)


def test_one_singular_state_among_others_is_found():
    d = planar_2r()
    model = numpy_model(d, {**values(d), "I1": 0.0, "I2": 0.0, "lc1": 0.0})
    q = np.array([[0.3, 1.0], [0.3, 0.0], [0.3, 2.0]])
    with pytest.raises(np.linalg.LinAlgError, match="singular at q"):
        model.dynamics(q, q, q)
