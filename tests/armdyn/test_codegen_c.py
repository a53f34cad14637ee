import decimal
import pickle
import sys

import numpy as np
import pytest
import sympy as sp
from hypothesis import given

from armdyn.codegen import (
    CompiledModel,
    NoCompilerError,
    NumpyModel,
    build,
    c_model,
    fastest_model,
    numpy_model,
)
from armdyn.derive import from_energies, planar_2r, planar_chain
from armdyn.manipulator import Manipulator
from armdyn.simulate import simulate
from tests.armdyn.arms import a_few, arms_and_states, assert_close, planar_arms
from tests.armdyn.derivations import EXAMPLES, hiding, parameters, states, values, with_friction


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    """A fresh cache: what these tests run is compiled by them."""
    with pytest.MonkeyPatch.context() as patch:
        folder = tmp_path_factory.mktemp("cache")
        patch.setenv("ARMDYN_CACHE", str(folder))
        patch.setattr(build, "_loaded", {})
        yield folder


@pytest.fixture(scope="module")
def arm(compiler):
    return c_model(planar_2r(), values(planar_2r()))


@pytest.mark.usefixtures("compiler")
@a_few
@given(arms_and_states(planar_arms()))
def test_agrees_with_the_closed_form(arm_and_states):
    arm, q, qd, u = arm_and_states
    model = c_model(with_friction(planar_2r()), parameters(arm))
    needed = arm.dynamics(q, qd, u)
    spread = np.linalg.cond(arm.M(q)).max() * max(1.0, np.max(np.abs(needed)))
    assert_close(model.dynamics(q, qd, u), needed, spread, 1e-13)
    assert_close(model.dynamics_many(q, qd, u), needed, spread, 1e-13)


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("name", ["spherical pendulum", "3 links, offsets"])
def test_agrees_with_numpy(name):
    d = EXAMPLES[name]()
    model, reference = c_model(d, values(d)), numpy_model(d, values(d))
    q, qd, u = states(d.n, batch=(3, 37))
    assert_close(model.dynamics(q, qd, u), reference.dynamics(q, qd, u), tolerance=1e-12)
    x0 = np.concatenate([q, qd], axis=-1)[0, :5]
    x, dt = model.rk4(x0, u[0, :5], 1e-2, 3), 1e-2
    for k in range(3):
        k1 = reference.state_derivative(x[:, k], u[0, :5])
        k2 = reference.state_derivative(x[:, k] + dt / 2 * k1, u[0, :5])
        k3 = reference.state_derivative(x[:, k] + dt / 2 * k2, u[0, :5])
        k4 = reference.state_derivative(x[:, k] + dt * k3, u[0, :5])
        assert_close(x[:, k + 1], x[:, k] + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4))


def test_one_many_and_floats_agree(arm):
    q, qd, u = states(2, batch=(100,))
    many = arm.dynamics_many(q, qd, u)
    for k in (0, 31, 32, 99):
        one = arm.dynamics(q[k].copy(), qd[k].copy(), u[k].copy())
        assert_close(one, many[k], tolerance=1e-14)
        floats = arm.dynamics_floats(*map(float, (*q[k], *qd[k], *u[k])))
        assert isinstance(floats, tuple)
        assert floats == tuple(one)


def test_forms_of_the_same_state(arm):
    q, qd, u = states(2, batch=(4,))
    needed = arm.dynamics(q[1], qd[1], u[1])
    column = np.asfortranarray(q)
    for form in (q[1].tolist(), column[1], q[1].astype(">f8"), q[1][::-1].copy()[::-1]):
        assert np.array_equal(arm.dynamics(form, qd[1], u[1]), needed)
    whole = np.array([1, 2])
    assert np.array_equal(arm.dynamics(whole, qd[0], u[0]), arm.dynamics(whole * 1.0, qd[0], u[0]))
    wide = arm.dynamics(q[:, np.newaxis], qd, u[0])
    assert wide.shape == (4, 4, 2)
    assert_close(wide[3, 2], arm.dynamics(q[3], qd[2], u[0]), tolerance=1e-14)
    assert arm.dynamics(q[:0], qd[:0], u[:0]).shape == (0, 2)
    out = np.empty((4, 2))
    assert arm.dynamics_many(q, qd, u, out=out) is out
    assert np.array_equal(out, arm.dynamics(q, qd, u))


@pytest.mark.parametrize("out", [np.empty((4, 3)), np.empty((2, 4)).T, np.empty((4, 2), int), 3])
def test_out_must_fit(arm, out):
    with pytest.raises(ValueError, match="out: needs a C-contiguous"):
        arm.dynamics_many(*states(2, batch=(4,)), out=out)


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-8, 1.0, 1e3, 0.99e6, 1.01e6, 1e15])
def test_sine_and_cosine_at_any_angle(size):
    """A pendulum whose g is sin q and whose M needs cos q: C's own sine against NumPy's."""
    q, qd = sp.symbols("q qd", real=True)
    d = from_energies((3 + sp.cos(q)) * qd**2 / 2, -sp.cos(q), [q], [qd])
    model = c_model(d, {})
    angles = size * np.concatenate([np.linspace(-1, 1, 1001), np.pi / 4 * np.arange(-9, 10)])
    found = model.dynamics(angles[:, np.newaxis], np.zeros(1), np.zeros(1))[:, 0]
    assert np.max(np.abs(found + np.sin(angles) / (3 + np.cos(angles)))) <= 4e-16
    assert found[600] == model.dynamics(angles[600:601], np.zeros(1), np.zeros(1))[0]


def test_rk4_is_of_fourth_order(arm):
    x0 = np.array([1.0, 0.5, 0.0, 0.0])
    ends = [arm.rk4(x0, [0.3, 0.1], 1.0 / n, n, final=True) for n in (100, 200, 400)]
    errors = [np.max(np.abs(end - arm.rk4(x0, [0.3, 0.1], 1e-4, 10_000)[-1])) for end in ends]
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([4, 4], abs=0.5)


@pytest.mark.parametrize("arms", [1, 7, 8, 33, 70])
def test_rk4_of_many_arms_is_that_of_each(arm, arms):
    q, qd, u = states(2, batch=(arms,))
    x0 = np.concatenate([q, qd], axis=-1)
    together = arm.rk4(x0, u, 1e-3, 20)
    assert together.shape == (arms, 21, 4)
    assert np.array_equal(together[:, 0], x0)
    assert np.array_equal(arm.rk4(x0, u, 1e-3, 20, final=True), together[:, -1])
    for k in (0, arms - 1):
        assert_close(together[k], arm.rk4(x0[k], u[k], 1e-3, 20), tolerance=1e-14)
    shared = arm.rk4(x0[0], u, 1e-3, 5, final=True)
    assert_close(shared[-1], arm.rk4(x0[0], u[-1], 1e-3, 5)[-1], tolerance=1e-14)
    assert arm.rk4(x0, u, 1e-3, 0).shape == (arms, 1, 4)
    assert arm.rk4(x0[:0], u[:0], 1e-3, 2).shape == (0, 3, 4)


@pytest.mark.usefixtures("compiler")
def test_rk4_has_the_friction(arm):
    """It takes energy out at the rate q̇ᵀ f."""
    d = with_friction(planar_2r())
    model = c_model(
        d, arm.values | {"viscous1": 0.3, "viscous2": 0.2, "coulomb1": 0.1, "coulomb2": 0}
    )
    x, dt = model.rk4([1.0, 0.5, 0.0, 0.0], [0.0, 0.0], 1e-3, 1000), 1e-3
    q, qd = x[:, :2], x[:, 2:]
    lost = np.trapezoid(np.vecdot(qd, model.f_vec(qd)), dx=dt)
    energy = model.energy(q, qd)
    assert lost > 0.01
    assert energy[0] - energy[-1] == pytest.approx(lost, rel=1e-4)


def test_rk4_keeps_the_energy(arm):
    x = arm.rk4([1.0, 0.5, 0.0, 0.0], [0.0, 0.0], 1e-3, 2000)
    energy = arm.energy(x[:, :2], x[:, 2:])
    assert np.max(np.abs(energy - energy[0])) <= 1e-6 * np.max(np.abs(energy))


def test_rk4_says_what_stopped_it(arm):
    with pytest.raises(FloatingPointError, match=r"stopped being finite at t = .* s \(state 1 of"):
        arm.rk4([[0, 0, 0, 0], [0, 0, 1e150, 1e160]], [0, 0], 0.1, 50)
    singular = c_model(planar_2r(), {**arm.values, "I1": 0.0, "I2": 0.0, "lc2": 0.0})
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        singular.rk4(np.ones(4), [0, 0], 0.1, 5)


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ((np.zeros(3), [0, 0], 0.1, 2), r"x0: got shape \(3,\)"),
        ((np.zeros(4), [0], 0.1, 2), r"u: got shape \(1,\)"),
        ((np.zeros((2, 4)), np.zeros((3, 2)), 0.1, 2), "broadcast"),
        ((np.zeros(4), [0, 0], np.nan, 2), "dt = nan"),
        ((np.zeros(4), [0, 0], 0.1, -1), "steps = -1"),
        ((np.zeros(4), [0, 0], 0.1, 1.5), "steps"),
        ((np.full(4, np.inf), [0, 0], 0.1, 1), r"x0\[0\] = inf"),
    ],
)
def test_rk4_names_a_bad_argument(arm, arguments, complaint):
    with pytest.raises(ValueError, match=complaint):
        arm.rk4(*arguments)


@pytest.mark.parametrize("which", range(3))
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_is_not_finite_is_named(arm, which, bad):
    one = list(states(2))
    one[which][1] = bad
    named = rf"{['q', 'qd', 'u'][which]}\[1\] = {bad}"
    with pytest.raises(ValueError, match=named):
        arm.dynamics(*one)
    with pytest.raises(ValueError, match=named):
        arm.dynamics_floats(*np.concatenate(one).tolist())


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("which", range(2))
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_named_where_the_acceleration_is(which, bad):
    model = c_model(hiding(), {})
    for row in (0, 40):
        many = np.zeros((3, 41, 1))
        many[which, row] = bad
        named = rf"{['q', 'qd'][which]}\[{row}, 0\] = {bad}"
        for call in (model.dynamics, model.dynamics_many):
            with pytest.raises(ValueError, match=named):
                call(*many)
    with pytest.raises(ValueError, match=rf"{['q', 'qd'][which]}\[0\] = {bad}"):
        model.dynamics(*many[:, 40])
    with pytest.raises(ValueError, match=rf"{['q', 'qd'][which]}\[0\] = {bad}"):
        model.dynamics_floats(*many[:, 40, 0].tolist())


def test_wrong_calls(arm):
    with pytest.raises(ValueError, match=r"q: got shape \(3,\)"):
        arm.dynamics(np.zeros(3), np.zeros(2), np.zeros(2))
    with pytest.raises(TypeError, match="got 5 numbers, needs 6: 2 each of q, qd and u"):
        arm.dynamics_floats(*[0.0] * 5)
    with pytest.raises(TypeError):
        arm.dynamics_floats(*["a"] * 6)


def test_singular_and_nearly_singular_are_left_to_the_reference(arm):
    singular = c_model(planar_2r(), {**arm.values, "I1": 0.0, "I2": 0.0, "lc2": 0.0})
    q = np.ones((40, 2))
    for call in (
        lambda: singular.dynamics(q[0], q[0], q[0]),
        lambda: singular.dynamics(q, q, q),
        lambda: singular.dynamics_floats(*[1.0] * 6),
    ):
        with pytest.raises(np.linalg.LinAlgError, match="singular at q"):
            call()
    close = c_model(planar_2r(), {**arm.values, "I2": 1e-13, "lc2": 0.0})
    q, qd, u = states(2, batch=(40,))
    assert np.array_equal(close.dynamics(q, qd, u), Manipulator.dynamics(close, q, qd, u))


class Springs:
    """A mixin with another potential: beside gravity, a spring in each joint."""

    def g_vec(self, q):
        return super().g_vec(q) + 40 * np.asarray(q)


class SpringModel(Springs, CompiledModel):
    pass


class Wind:
    def bias(self, q, qd):
        return super().bias(q, qd) + 5.0


class WindyModel(Wind, CompiledModel):
    pass


class SpringNumpyModel(Springs, NumpyModel):
    pass


class Damped(CompiledModel):
    def dynamics(self, q, qd, u):
        return super().dynamics(q, qd, u - 3 * qd)


def test_a_subclass_moves_by_its_own_terms_in_every_call(arm):
    """Loops and floats too: none of them may still have the generated gravity in it."""
    q, qd, u = states(2, (3,))
    at_rest = np.concatenate([q, qd], axis=-1)
    for kind in (SpringModel, WindyModel, SpringNumpyModel, Damped):
        other = kind(arm.derivation, arm.values)
        pulled = u - {Damped: 3 * qd, WindyModel: 5.0}.get(kind, 40 * q)
        expected = arm.dynamics(q, qd, pulled)
        np.testing.assert_allclose(other.dynamics(q, qd, u), expected, rtol=1e-9)
        np.testing.assert_allclose(other.dynamics(q[0], qd[0], u[0]), expected[0], rtol=1e-9)
        if kind is SpringNumpyModel:
            continue
        np.testing.assert_allclose(other.dynamics_many(q, qd, u), expected, rtol=1e-9)
        found = other.dynamics_floats(*q[0], *qd[0], *u[0])
        np.testing.assert_allclose(found, expected[0], rtol=1e-9)
        t = np.linspace(0, 0.1, 11)
        path = simulate(other.state_derivative, at_rest, u[:, np.newaxis, :], t)
        np.testing.assert_allclose(other.rk4(at_rest, u, 0.01, 10), path, rtol=1e-9)
        last = other.rk4(at_rest, u, 0.01, 10, final=True)
        np.testing.assert_allclose(last, path[:, -1], rtol=1e-9)
        with pytest.raises(FloatingPointError, match="stopped being finite at t = "):
            other.rk4(100 * at_rest, u, 5.0, 100)


def test_other_values_and_other_processes_use_the_same_module(arm, cache):
    kept = sorted(cache.rglob("*armdyn_compiled*"))
    other = c_model(planar_2r(), values(planar_2r(), seed=5))
    assert other._compiled is arm._compiled
    assert isinstance(other, CompiledModel)
    q, qd, u = states(2)
    again = pickle.loads(pickle.dumps(arm))
    assert np.array_equal(again.dynamics(q, qd, u), arm.dynamics(q, qd, u))
    assert sorted(cache.rglob("*armdyn_compiled*")) == kept


@pytest.fixture
def no_compiler(monkeypatch, tmp_path):
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(build, "_loaded", {})


def test_no_compiler_is_said_plainly(no_compiler):
    d = planar_chain(2)
    with pytest.raises(NoCompilerError, match="was not found") as caught:
        c_model(d, values(d))
    for system in ("apt install gcc python3-dev", "xcode-select", "Build Tools", "numpy_model"):
        assert system in str(caught.value)
    with pytest.warns(RuntimeWarning, match="was not found.*Using NumPy"):
        model = fastest_model(d, values(d))
    assert type(model) is NumpyModel
    q, qd, u = states(2)
    assert np.array_equal(model.dynamics(q, qd, u), numpy_model(d, values(d)).dynamics(q, qd, u))


@pytest.mark.skipif(sys.platform == "win32", reason="on Windows setuptools finds the compiler")
def test_a_compiler_that_fails_is_quoted(monkeypatch, tmp_path, no_compiler):
    script = tmp_path / "broken-cc"
    script.write_text("#!/bin/sh\necho 'fatal error: Python.h: No such file' >&2\nexit 1\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    monkeypatch.setenv("PATH", "/usr/bin:/bin")
    with pytest.raises(NoCompilerError, match=r"Python\.h: No such file"):
        c_model(planar_chain(2), values(planar_chain(2)))
    assert list(tmp_path.rglob("*armdyn_compiled*")) == []


def test_fastest_is_c_where_it_can_be(arm):
    assert isinstance(fastest_model(planar_2r(), arm.values), CompiledModel)


@pytest.mark.usefixtures("compiler")
def test_setuptools_builds_it_too(tmp_path):
    # The way taken on Windows, where only setuptools knows how to find the compiler.
    file = tmp_path / "armdyn_compiled.c"
    file.write_text(
        "#include <Python.h>\n#include <numpy/arrayobject.h>\n"
        "PyMODINIT_FUNC PyInit_armdyn_compiled(void) { return NULL; }\n"
    )
    assert build._with_setuptools(file, ()).startswith(str(tmp_path))
    file.write_text("#error no\n")
    with pytest.raises(NoCompilerError, match="CompileError"):
        build._with_setuptools(file, ())


def test_cache_folder_has_an_override(monkeypatch, tmp_path):
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path))
    assert build.cache_folder() == tmp_path
    monkeypatch.delenv("ARMDYN_CACHE")
    assert build.cache_folder().name == "armdyn"


def test_what_c_cannot_say_is_named():
    q, qd = sp.symbols("q qd", real=True)
    with pytest.raises(ValueError, match="contains besselj"):
        c_model(from_energies(qd**2, sp.besselj(0, q), [q], [qd]), {})


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("seed", range(6))
def test_an_inertia_singular_by_cancellation_is_refused(seed):
    # Stretched out, with both masses at the ends of massless links: no entry of M is 0, its
    # determinant is, and what rounding leaves of the last pivot may have either sign.
    d = planar_2r()
    model = c_model(d, {**values(d, seed), "I1": 0.0, "I2": 0.0, "lc1": 0.0})
    q = np.array([0.3, 0.0])
    with pytest.raises(np.linalg.LinAlgError, match="singular at q"):
        model.dynamics(q, q, q)


@pytest.mark.usefixtures("compiler")
def test_decimals_keep_their_precision():
    before = decimal.getcontext().prec
    c_model(planar_2r(), values(planar_2r(), 0))
    assert decimal.getcontext().prec == before


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("bad", [np.nan, -np.inf])
def test_what_is_not_finite_is_named_where_no_formula_reads_it(bad):
    """A pendulum's q̈ does not depend on its velocity."""
    q, qd = sp.symbols("q qd", real=True)
    model = c_model(from_energies(3 * qd**2 / 2, -sp.cos(q), [q], [qd]), {})
    for batch in ((), (1,), (40,)):
        with pytest.raises(ValueError, match=rf"qd\[(0, )?0\] = {bad}"):
            model.dynamics(*(np.full((*batch, 1), value) for value in (0.3, bad, 0.1)))
    with pytest.raises(ValueError, match=rf"qd\[0\] = {bad}"):
        model.dynamics_floats(0.3, bad, 0.1)
