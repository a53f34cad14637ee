"""MATLAB in GNU Octave: long motions, ode45, the demo, and that it is MATLAB that Octave runs."""

import re
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import sympy as sp

from armdyn import Planar2R, ports
from armdyn.derive import from_energies
from armdyn.ports import matlab
from armdyn.simulate import simulate
from tests.ports.agreement import TOLERANCE

SOURCES = sorted(matlab.FOLDER.rglob("*.m"))


@pytest.fixture(autouse=True)
def octave(needs):
    return needs("octave")


def test_parameters_whose_names_are_taken_in_matlab():
    x, v, M, pi = sp.symbols("x v M pi")
    cart = from_energies(M * v**2 / 2, pi * x**2 / 2, [x], [v])
    found = ports.run("matlab", cart, [3.0, 5.0], [1.0], values={"M": 2.0, "pi": 4.0})
    assert found.M == [[2.0]]
    assert found.g_vec == [12.0]
    assert found.qdd == [(1.0 - 12.0) / 2.0]


# Both motions are regular, so that the rounding of ten thousand steps grows no faster than they
# last: by hand an arm with friction, driven and in the end at rest; generated one that swings a
# little about hanging straight down. Of a chaotic motion no two programs agree for 10 s.
DAMPED = Planar2R(1.0, 0.8, 0.5, 0.3, 2.0, 1.5, 0.2, 0.1, viscous=(2.0, 1.5))
HANGING = Planar2R(1.0, 0.8, 0.5, 0.3, 2.0, 1.5, 0.2, 0.1)
RUNS = {
    False: (DAMPED, [0.3, -0.8, 1.0, -2.0], [6.0, -1.0]),
    True: (HANGING, [-np.pi / 2 + 0.15, -0.1, 0.1, 0.0], [0.0, 0.0]),
}


@pytest.mark.parametrize("steps", [1000, pytest.param(10_000, marks=pytest.mark.long)])
def test_motions_in_steps_of_a_millisecond_agree(steps):
    """Octave takes a millisecond a step and more: one motion each, both at once."""
    t = 1e-3 * np.arange(steps + 1)

    def states(generated):
        arm, x0, u = RUNS[generated]
        return ports.simulate("matlab", arm, x0, u, t, generated=generated, seconds=300)

    with ThreadPoolExecutor(2) as both:
        found = list(both.map(states, RUNS))
    for generated, x in zip(RUNS, found, strict=True):
        arm, x0, u = RUNS[generated]
        right = simulate(arm.state_derivative, x0, u, t)
        assert np.ptp(right, axis=0).min() > 0.1  # it moves
        assert np.abs(x - right).max() <= TOLERANCE * np.abs(right).max()


@pytest.mark.parametrize("lc2", [0.5, 0.4], ids=["exactly", "to rounding"])
def test_a_singular_arm_is_no_least_squares_problem(lc2):
    points = Planar2R(1.0, 0.8, 0.0, lc2, 2.0, 2.0, 0.0, 0.0)
    with pytest.raises(ports.ProgramError, match="matrix singular to machine precision"):
        ports.run("matlab", points, [0.0, 0.0, 0.0, 0.0])


def in_octave(octave, script):
    command = [octave, "--norc", "--quiet", "--path", matlab.FOLDER, "--eval", script]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    return np.array([[float(x) for x in line.split()] for line in done.stdout.splitlines()])


ARM = (
    "arm = struct('l1', 1, 'l2', 0.8, 'lc1', 0.5, 'lc2', 0.3, 'm1', 2, 'm2', 1.5, 'I1', 0.2, "
    "'I2', 0.1, 'g', 9.81, 'viscous', [2, 1.5], 'coulomb', [0; 0]);"
)


@pytest.mark.parametrize(
    ("u_matlab", "u"),
    [
        ("[6; -1]", np.array([6.0, -1.0])),
        ("@(t, x) [sin(t) - x(1); -x(4)]", lambda t, x: np.array([np.sin(t) - x[0], -x[3]])),
    ],
)
def test_ode45_agrees_with_the_solvers_of_python(octave, u_matlab, u):
    x0, t = RUNS[False][1], np.linspace(0.5, 1.5, 11)
    script = (
        f"{ARM} [t, x] = planar_2r.simulate_ode45(arm, {x0}', {u_matlab}, linspace(0.5, 1.5, 11), "
        "1e-9, 1e-12); printf('%.17g %.17g %.17g %.17g %.17g\\n', [t, x]');"
    )
    found = in_octave(octave, script)
    assert found[:, 0] == pytest.approx(t)
    for method in ("DOP853", "RK45"):
        right = simulate(DAMPED.state_derivative, x0, u, t, method, rtol=1e-10, atol=1e-12)
        assert np.abs(found[:, 1:] - right).max() < 1e-7  # the sum of the errors of the steps


def test_both_tolerances_reach_ode45(octave):
    """Without them they are 1e-9 and 1e-12."""
    x0, u = RUNS[False][1:]
    call = f"planar_2r.simulate_ode45(arm, {x0}', {u}', [0, 0.5]"
    script = (
        f"{ARM} [t, a] = {call}, 1e-3, 1e-12); [t, b] = {call}, 1e-12, 1e-3); [t, c] = {call}); "
        "printf('%.17g %.17g %.17g %.17g\\n', [a(end, :); b(end, :); c(end, :)]');"
    )
    right = simulate(DAMPED.state_derivative, x0, u, [0.0, 0.5], "DOP853", rtol=1e-12)[-1]
    relative, absolute, usual = np.abs(in_octave(octave, script) - right).max(axis=1)
    assert 1e-6 < relative < 1e-1
    assert 1e-6 < absolute < 1e-1
    assert usual < 1e-8


def test_state_derivative_is_the_models(octave):
    found = in_octave(
        octave,
        f"{ARM} printf('%.17g ', planar_2r.state_derivative([0.3; -0.8; 1; -2], [6; -1], arm));",
    )
    right = DAMPED.state_derivative([0.3, -0.8, 1, -2], [6, -1])
    assert found[0] == pytest.approx(right, rel=1e-13)


def numbers(text):
    return np.array([[float(x) for x in row.split()] for row in text.split(";")])


def test_the_demo_prints_what_python_says():
    printed = matlab.demo()
    found = {
        name: numbers(value)
        for name, value in re.findall(r"^(?:.*: )?(\w+) = \[?([-+.e\d ;]+)\]?", printed, re.M)
    }
    source = (matlab.FOLDER / "demo_2r.m").read_text(encoding="utf-8")
    fields = {name: float(v) for name, v in re.findall(r"'(\w+)', ([\d.]+)", source)}
    arm = Planar2R(**fields)
    q, qd, u = np.array([0.6, -1.1]), np.array([0.9, 1.7]), np.array([1.0, -2.0])
    end = simulate(
        arm.state_derivative, [*q, *qd], [0, 0], [0.0, 2.0], "DOP853", rtol=1e-12, atol=1e-13
    )[-1]
    right = {
        "M": arm.M(q),
        "C": arm.C(q, qd),
        "g": arm.g_vec(q)[:, np.newaxis],
        "P": arm.potential_energy(q),
        "qdd": arm.dynamics(q, qd, u)[:, np.newaxis],
    }
    assert list(found) == [*right, "q"]
    for name, value in right.items():
        assert found[name] == pytest.approx(value, rel=1e-11), name
    assert found["q"][0] == pytest.approx(end[:2], abs=1e-7)
    assert re.search(r"N \+ N' .*: 0$|N \+ N' .*: \d(\.\d+)?e-1[5-9]$", printed, re.M)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_source_is_matlab_too(path):
    """What Octave takes and MATLAB does not; and each file opens with the line that `help` shows."""
    lines = path.read_text(encoding="ascii").splitlines()
    code = [re.sub(r"'[^']*'|%.*", "", line) for line in lines]
    octave_only = r"[#!\"]|\+=|-=|\+\+|\bend_?(if|for|while|function)|\bprintf\b|\)'?\(:\)"
    assert [line for line in code if re.search(octave_only, line)] == []
    name = path.stem
    if name == "driver":
        return
    first, *rest = lines
    if name != "demo_2r":
        assert re.fullmatch(rf"function .*\b{name}\(.*\)", first)
        first = rest[0]
    assert re.match(rf"%{name.upper()}  \w.*\.$", first)
