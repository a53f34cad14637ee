"""The right answers of lesson 09 once more, by programs in place of formulas."""

import re
import subprocess

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.ports import block_diagram
from armdyn.simulate import rk4_step
from autograder.lesson_checks import checks_of
from autograder.lesson_checks.arm import ARM
from tests.autograder.lesson_checks.lesson_09 import TABLE

CHECKS = checks_of("09")
arm = Planar2R(**vars(ARM))


def test_the_accelerations_are_the_solution():
    wrong = {one.name: one.number for one in CHECKS["09-push"].wrong}
    M, r = np.array([[4.0, 2.0], [2.0, 1.5]]), np.array([6.0, 2.0])
    assert np.allclose(np.linalg.solve(M, r), [CHECKS["09-push"].right, wrong["joint 2"]])
    assert np.isclose(wrong["determinant"] / np.linalg.det(M), CHECKS["09-push"].right)


def test_octave_gives_the_number_of_java_for_the_right_line_alone(needs):
    """The terms have no symmetry that could hide a mistake, but for that of M."""
    terms = "M = [4 2; 2 1.5]; C = [1 7; 3 5]; g = [11; 13]; qdd = [2; 3]; qd = [17; 19];"
    M, C = np.array([[4, 2], [2, 1.5]]), np.array([[1, 7], [3, 5]])
    torque = (M @ [2, 3] + C @ [17, 19] + [11, 13])[1]
    lines = {
        letter: re.fullmatch(r"`(.+)`", option.text)[1]
        for letter, option in CHECKS["09-joint"].by_letter.items()
    }
    source = terms + "".join(f"disp(mat2str({line}));" for line in lines.values())
    command = [needs("octave"), "--no-gui", "--quiet", "--norc", "--eval", source]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    given = dict(zip(lines, done.stdout.split("\n"), strict=False))
    right = TABLE["09-joint"].right[0].strip('"')
    assert {letter for letter, text in given.items() if text == f"{torque:g}"} == {right}
    assert given["e"].startswith("[")  # a row and a column, entry by entry: a matrix


def test_the_diagram_without_one_wire_turns_faster_and_faster():
    pytest.importorskip("bdsim", reason="needs bdsim: pip install 'armdyn[ports]'")

    class Unwired(Planar2R):
        """The function block reads 0 for both angles."""

        def dynamics(self, q, qd, u):
            return super().dynamics(np.zeros_like(q), qd, u)

    hanging, t = np.array([-np.pi / 2, 0.0, 0.0, 0.0]), np.linspace(0, 1, 11)
    whole = block_diagram.simulate(arm, hanging, np.zeros(2), t)
    assert np.allclose(whole, hanging, atol=1e-12)
    cut = block_diagram.simulate(Unwired(**vars(ARM)), hanging, np.zeros(2), t)
    constant = arm.dynamics(np.zeros(2), np.zeros(2), np.zeros(2))
    assert np.allclose(cut[:, 2:], t[:, np.newaxis] * constant)
    assert np.abs(constant).min() > 1


def free_arm(number):
    """ẋ of the free arm, with each operation in one type of numbers."""
    l1, lc1, lc2, m1, m2, I1, I2, g = (
        number(getattr(ARM, name)) for name in ("l1", "lc1", "lc2", "m1", "m2", "I1", "I2", "g")
    )

    def rate(x, u):
        q1, q2, qd1, qd2 = x
        b, h = m2 * l1 * lc2 * np.cos(q2), -m2 * l1 * lc2 * np.sin(q2)
        M22 = I2 + m2 * lc2 * lc2
        M12, M11 = M22 + b, I1 + m1 * lc1 * lc1 + m2 * l1 * l1 + M22 + b + b
        g2 = m2 * lc2 * g * np.cos(q1 + q2)
        r1 = -h * (qd1 * qd2 + qd1 * qd2 + qd2 * qd2) - (m1 * lc1 + m2 * l1) * g * np.cos(q1) - g2
        r2 = h * qd1 * qd1 - g2
        L21 = M12 / M11
        qdd2 = (r2 - L21 * r1) / (M22 - L21 * M12)
        return np.array([qd1, qd2, r1 / M11 - L21 * qdd2, qdd2], dtype=number)

    return rate


def run(number, steps=600):
    rate, dt = free_arm(number), number(0.01)
    states = [np.array([1.5, -1.0, 0.0, 0.0], dtype=number)]  # the wild start of the lesson
    for _ in range(steps):
        x = states[-1]
        k1 = rate(x, None)
        k2 = rate(x + dt / number(2) * k1, None)
        k3 = rate(x + dt / number(2) * k2, None)
        k4 = rate(x + dt * k3, None)
        states.append(x + dt / number(6) * (k1 + number(2) * (k2 + k3) + k4))
    assert states[-1].dtype == number
    return np.array(states, dtype=float)


def test_single_precision_stays_nearly_as_long_as_estimated():
    double = run(np.float64)
    step = rk4_step(arm.state_derivative, double[0], np.zeros(2), 0.01)
    assert np.allclose(double[1], step, rtol=1e-12)
    apart = np.linalg.norm(run(np.float32) - double, axis=-1)
    leaves = 0.01 * np.argmax(apart > 0.01)
    assert 0 < CHECKS["09-single"].right - leaves < 2  # "about a second less", on any processor
