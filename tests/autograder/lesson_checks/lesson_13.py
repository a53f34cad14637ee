"""Answers to the checks of lesson 13."""

from tests.autograder.lesson_checks.answers import Answers

TORQUES = "u - f_vec - g_vec"
RATIO = "(1 - np.cos(np.radians(120)))"
TABLE = {
    "13-momentum": Answers(
        right=(
            f"{TORQUES} + C.T @ qd",
            f"{TORQUES} + qd @ C",
            f"{TORQUES} - C @ qd + (C + C.T) @ qd",
            '[float(t) for t in u - f_vec - g_vec + np.einsum("ji,j->i", C, qd)]',
        ),
        wrong={
            "M q̈": f"{TORQUES} - C @ qd",
            "not transposed": f"{TORQUES} + C @ qd",
            "rate of M twice": f"{TORQUES} + (C + C.T) @ qd",
            "no velocity term": TORQUES,
            "transposed, with a minus": f"{TORQUES} - C.T @ qd",
            "halved": f"{TORQUES} + C.T @ qd / 2",
            "gravity added": "u - f_vec + g_vec + C.T @ qd",
            "friction added": "u + f_vec - g_vec + C.T @ qd",
            "gravity left out": "u - f_vec + C.T @ qd",
            "friction left out": "u - g_vec + C.T @ qd",
            "sign of the whole": f"-({TORQUES} + C.T @ qd)",
        },
        other=("u", "C @ qd", f"{TORQUES} + 2 * C.T @ qd"),
    ),
    "13-library": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
    "13-heat": Answers(
        right=(
            "42.2",
            "9.81 * (3 * 0.5 + 2 * 1.4)",
            "smooth.potential_energy([0, 0]) - smooth.potential_energy([-np.pi / 2, 0])",
        ),
        wrong={
            "from upright": "2 * 9.81 * (3 * 0.5 + 2 * 1.4)",
            "link 2 as if about joint 2": "9.81 * 2 * 0.4",
            "elbow at rest": "9.81 * (3 * 0.5 + 2 * 0.4)",
            "link 2 to the elbow": "9.81 * (3 * 0.5 + 2 * 1.0)",
            "ends of the links": "9.81 * (3 * 1.0 + 2 * 1.8)",
            "mass for weight": "3 * 0.5 + 2 * 1.4",
            "sign": "-42.2",
            "link 1 alone": "9.81 * 3 * 0.5",
            "half": "21.1",
        },
        other=("0", "100", "9.81"),
    ),
    "13-swing": Answers(
        right=("4.9", f"np.sqrt(2 * 8 * {RATIO})", "np.sqrt(24)"),
        wrong={
            "height from above": "np.sqrt(2 * 8 * 0.5)",
            "half forgotten": f"np.sqrt(8 * {RATIO})",
            "from level": "4",
            "root forgotten": "24",
            "acceleration held constant": "np.sqrt(2 * 8 * np.radians(120))",
            "sine for height": "np.sqrt(16 * np.sin(np.radians(120)))",
            "point mass": "np.sqrt(2 * 9.81 * 1.5)",
            "torque for inertia": "np.sqrt(2 * 6 * 1.5)",
        },
        other=("0", "8", "1"),
    ),
    "13-scale": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
}
