"""C++, Java and MATLAB, by hand and generated, say what the closed form and the derivation say."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from armdyn import Planar2R, ports
from armdyn.codegen import c_model
from armdyn.ports import java
from armdyn.ports.toolchain import Conversation
from armdyn.simulate import simulate
from tests.ports.agreement import (
    PLANAR_2R,
    PLANAR_3R,
    RUBBING_2R,
    TOLERANCE,
    Evaluated,
    assert_agreement,
    closed_form,
    random_arm,
    random_states,
    random_values,
)

ROWS = 1000
PACKAGES = {
    "cpp": ("g++", "libeigen3-dev"),
    "java": ("default-jdk-headless", "libejml-java"),
    "matlab": ("octave",),
}
# Octave takes a millisecond for a step and more: its two runs of ten seconds are in test_matlab.
fast = pytest.mark.parametrize("language", ["cpp", "java"], indirect=True, scope="module")
# Each example is a thousand arms; a smaller seed is no simpler.
thousands = settings(deadline=None, max_examples=2, phases=[Phase.reuse, Phase.generate])
seeds = st.integers(0, 2**32 - 1)


@cache
def evaluated(derivation):
    return Evaluated(derivation)


@pytest.fixture(scope="module", params=PACKAGES)
def language(request, needs):
    for package in PACKAGES[request.param]:
        needs(package)
    return request.param


@pytest.fixture(scope="module")
def by_hand(language):
    with ports.start(language) as program:
        yield program


@pytest.fixture(scope="module")
def generated_2r(language):
    with ports.start(language, RUBBING_2R) as program:
        yield program


@pytest.fixture(scope="module")
def generated_3r(language):
    with ports.start(language, PLANAR_3R) as program:
        yield program


def sizes_2r(arms, states):
    return evaluated(RUBBING_2R).sizes([values(arm) for arm in arms], states)


def values(arm):
    return dict(zip((s.name for s in RUBBING_2R.parameters), rubbing(arm), strict=True))


def flat(arm):
    return [arm.l1, arm.l2, arm.lc1, arm.lc2, arm.m1, arm.m2, arm.I1, arm.I2, arm.g]


def rubbing(arm):
    return [*flat(arm), *arm.viscous, *arm.coulomb]


@thousands
@given(seed=seeds)
def test_a_thousand_arms(by_hand, generated_2r, seed):
    rng = np.random.default_rng(seed)
    arms = [random_arm(rng, friction=True) for _ in range(ROWS)]
    states, u = random_states(rng, ROWS, 2)
    right, sizes = closed_form(arms, states, u), sizes_2r(arms, states)
    for program in (by_hand, generated_2r):
        found = program.terms([rubbing(arm) for arm in arms], states, u)
        assert_agreement(found, right, sizes, states, u)
        assert not found.f_vec[states[:, 2:] == 0].any()


@thousands
@given(seed=seeds)
def test_a_thousand_generated_arms_of_three_links(generated_3r, seed):
    rng = np.random.default_rng(seed)
    values = [random_values(rng, PLANAR_3R) for _ in range(ROWS)]
    states, u = random_states(rng, ROWS, 3)
    parameters = [[v[s.name] for s in PLANAR_3R.parameters] for v in values]
    found = generated_3r.terms(parameters, states, u)
    right = evaluated(PLANAR_3R)
    assert_agreement(found, right.terms(values, states, u), right.sizes(values, states), states, u)


def test_run_takes_models_as_start_takes_their_numbers(language, by_hand, generated_2r):
    rng = np.random.default_rng(1)
    arms = [random_arm(rng, friction=True) for _ in range(3)]
    states, u = random_states(rng, 3, 2)
    for generated, program in ((False, by_hand), (True, generated_2r)):
        found = ports.run(language, arms, states, u, generated=generated)
        right = program.terms([rubbing(arm) for arm in arms], states, u)
        for name in vars(found):
            np.testing.assert_array_equal(getattr(found, name), getattr(right, name))


def test_batch_axes_broadcast(by_hand):
    arm = Planar2R(1, 0.8, 0.5, 0.3, 2, 1.5, 0.2, 0.1, viscous=(2, 1.5), coulomb=(0.3, 0.2))
    rng = np.random.default_rng(2)
    states, u = rng.normal(size=(3, 1, 4)), rng.normal(size=(2, 2))
    found = by_hand.terms(rubbing(arm), states, u)
    q, qd = states[..., :2], states[..., 2:]
    assert found.M.shape == (3, 2, 2, 2)
    assert found.potential_energy.shape == (3, 2)
    np.testing.assert_allclose(found.f_vec, np.broadcast_to(arm.f_vec(qd), (3, 2, 2)), 1e-14)
    np.testing.assert_allclose(found.qdd, arm.dynamics(q, qd, u), rtol=1e-11)
    one = by_hand.terms(rubbing(arm), states[0, 0])
    assert one.C.shape == (2, 2)
    assert one.potential_energy.shape == ()


T = np.linspace(0, 10, 10_001)
# Only of motions that do not amplify rounding can programs agree for 10 s: a free 2R that swings
# over is chaotic, and parts from itself after a few seconds. Here arms with friction, driven, come
# to rest; and free ones swing by about a tenth of a radian around hanging straight down.
STARTS = np.random.default_rng(3).uniform(-1, 1, (2, 4)) * [2, 2, 3, 3]
SMALL = 0.1 * np.random.default_rng(4).uniform(-1, 1, (3, 6))
HANGING = {
    "l": (1.0, 0.8, 0.5),
    "lc": (0.5, 0.3, 0.2),
    "ly": (0.0, 0.05, -0.02),
    "m": (2.0, 1.5, 1.0),
    "I": (0.2, 0.1, 0.05),
    "g": (9.81,),
}


@cache
def damped_motions():
    """(arm, u, its states by Planar2R) of driven arms with friction."""
    rng, motions = np.random.default_rng(5), []
    for x0 in STARTS:
        free = random_arm(rng, friction=False)
        d = rng.uniform(5, 10, 2)
        arm = replace(free, viscous=tuple(d))
        u = rng.uniform(-20, 20, 2)
        # Friction as a part of the input: Planar2R takes a tenth of the time without it.
        states = simulate(free.state_derivative, x0, lambda t, x: u - d * x[2:], T)  # noqa: B023
        motions.append((arm, u, states))
    return motions


def hanging(derivation):
    """(values, starts (3, 2n)) of free swings."""
    n = derivation.n
    places = [(s.name.rstrip("123"), s.name[-1]) for s in derivation.parameters]
    values = [HANGING[name][int(i) - 1 if i.isdigit() else 0] for name, i in places]
    starts = SMALL[:, : 2 * n].copy()
    starts[:, 0] -= np.pi / 2
    return values, starts


def assert_same_motion(found, right):
    assert np.ptp(right, axis=0).min() > 0.01  # it moves
    assert np.max(np.abs(found - right)) <= TOLERANCE * np.max(np.abs(right))


@fast
def test_ten_seconds_with_friction(by_hand):
    for arm, u, right in damped_motions():
        found = by_hand.simulate(rubbing(arm), right[0], u, T)
        assert_same_motion(found, right)


@fast
def test_ten_free_seconds_by_hand(by_hand, needs):
    needs("g++")  # a C compiler comes with it
    values, starts = hanging(PLANAR_2R)
    for x0, right in zip(starts, compiled_motions(PLANAR_2R), strict=True):
        assert_same_motion(by_hand.simulate([*values, 0, 0, 0, 0], x0, [0, 0], T), right)


@cache
def compiled_motions(derivation):
    """The free swings by armdyn's own generated C, which agrees with Planar2R elsewhere."""
    values, starts = hanging(derivation)
    names = [s.name for s in derivation.parameters]
    model = c_model(derivation, dict(zip(names, values, strict=True)))
    return model.rk4(starts, np.zeros(derivation.n), T[-1] / (len(T) - 1), len(T) - 1)


@fast
def test_ten_free_seconds_generated(generated_2r, generated_3r, needs):
    needs("g++")  # a C compiler comes with it
    for program, derivation in ((generated_2r, PLANAR_2R), (generated_3r, PLANAR_3R)):
        values, starts = hanging(derivation)
        for x0, right in zip(starts, compiled_motions(derivation), strict=True):
            given_values = [*values, *[0] * (program.count - len(values))]
            found = program.simulate(given_values, x0, np.zeros(derivation.n), T)
            assert_same_motion(found, right)


def test_times_may_be_further_apart_than_steps(language):
    arm, u, right = damped_motions()[0]
    t = T[:51]
    found = ports.simulate(language, arm, right[0], u, t[::10], substeps=10)
    assert np.max(np.abs(found - right[:51:10])) <= TOLERANCE * np.max(np.abs(right))


def test_a_singular_inertia_matrix_ends_the_program(language):
    points = Planar2R(1.0, 0.8, 0.0, 0.4, 2.0, 1.5, 0.0, 0.0)
    with pytest.raises(
        ports.ProgramError, match=r"exit status 1: (.|\n)*(M\(q\) is|matrix) (singular|not)"
    ):
        ports.run(language, points, np.zeros(4))


def test_javas_solvers_agree(needs):
    for package in PACKAGES["java"]:
        needs(package)
    rng = np.random.default_rng(6)
    arms = [random_arm(rng, friction=True) for _ in range(ROWS)]
    states, u = random_states(rng, ROWS, 2)
    command = java.toolchain().started_in(ports.built("java"))
    conversation = Conversation([*command, "two-by-two"])
    with ports.Program(conversation, 2, 13) as program:
        parameters = [rubbing(arm) for arm in arms]
        found = program.terms(parameters, states, u)
        assert_agreement(found, closed_form(arms, states, u), sizes_2r(arms, states), states, u)
        singular = [1.0, 0.8, 0.0, 0.4, 2.0, 1.5, 0.0, 0.0, 9.81, 0, 0, 0, 0]
        with pytest.raises(ports.ProgramError, match="not positive definite"):
            program.terms(singular, np.zeros(4))


@pytest.mark.parametrize(
    "derivation", [None, PLANAR_2R, RUBBING_2R, PLANAR_3R], ids=["hand", "2R", "friction", "3R"]
)
def test_compilers_have_nothing_to_say(language, derivation):
    """All warnings are on: see toolchain.languages."""
    said = ports.built(language, derivation) / "compiler.txt"
    assert said.read_text(encoding="utf-8") == ""
