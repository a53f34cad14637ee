"""Answers to the checks of lesson 06."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "06-motor": Answers(
        right=("1.02", "0.11 + 2 * 0.4**2 + 0.05 + 1.5 * 0.6**2"),
        wrong={
            "motor as a point": "0.43 + 1.5 * 0.6**2",
            "link about its centre": "0.11 + 0.05 + 1.5 * 0.6**2",
            "motor about its centre": "0.43 + 0.05",
            "both about their centres": "0.11 + 0.05",
            "about the common centre": "1.02 - 1.7**2 / 3.5",
            "distance not squared": "0.43 + 0.05 + 1.5 * 0.6",
            "distance from the link's centre": "0.43 + 0.05 + 1.5 * 0.2**2",
            "distance from the shoulder": "0.43 + 0.05 + 1.5 * 1.6**2",
            "motor alone": "0.05 + 1.5 * 0.6**2",
        },
        other=("0", "0.43", "3.5"),
    ),
    "06-count": Answers(
        right=("5", "3 * 3 - 4", "5.0"),
        wrong={
            "all columns": "9",
            "one less": "8",
            "two less": "7",
            "with gravity": "6",
            "two links with gravity": "4",
            "two links": "3",
        },
        other=("12", "2", "0"),
    ),
    "06-tool": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
    "06-row": Answers(
        right=(
            "[g * np.sin(q), qdd, qd, np.sign(qd)]",
            "np.array([[np.sin(q) * g, qdd, qd, qd / abs(qd)]])",
            "(g * np.sin(q), qdd, qd, 1 if qd > 0 else -1)",
        ),
        wrong={
            "cosine": "[g * np.cos(q), qdd, qd, np.sign(qd)]",
            "sign of gravity": "[-g * np.sin(q), qdd, qd, np.sign(qd)]",
            "without g": "[np.sin(q), qdd, qd, np.sign(qd)]",
            "weight at every angle": "[g, qdd, qd, np.sign(qd)]",
            "radians converted": "[g * np.sin(np.radians(q)), qdd, qd, np.sign(qd)]",
            "in degrees": "[g * np.sin(np.degrees(q)), qdd, qd, np.sign(qd)]",
            "inertia and damping exchanged": "[g * np.sin(q), qd, qdd, np.sign(qd)]",
            "velocity for its sign": "[g * np.sin(q), qdd, qd, qd]",
            "sign of the angle": "[g * np.sin(q), qdd, qd, np.sign(q)]",
            "exchanged": "[qdd, g * np.sin(q), qd, np.sign(qd)]",
            "friction exchanged": "[g * np.sin(q), qdd, np.sign(qd), qd]",
            "friction drives": "[g * np.sin(q), qdd, -qd, -np.sign(qd)]",
            "Coulomb without its sign": "[g * np.sin(q), qdd, qd, 1]",
            "speeds": "[g * np.sin(q), qdd, abs(qd), 1]",
        },
        other=(
            "[0, 0, 0, 0]",
            "[q, q, g, qdd]",
            "[g * np.sin(2 * q), 0, 0, qd**2]",
            "[g * q, qdd**2, qd**2, qd**3]",
        ),
    ),
    "06-bodies": Answers(
        right=("0.178", "(0.5 * 0.8)**2 / 0.9"),
        wrong={
            "without the length": "0.8**2 / 0.9",
            "length not squared": "0.5 * 0.8**2 / 0.9",
            "nothing squared": "0.5 * 0.8 / 0.9",
            "not divided": "(0.5 * 0.8)**2",
            "positive alone": "0",
            "upside down": "0.9 / (0.5 * 0.8)**2",
            "the other bound on m2": "0.9 / 0.5**2",
        },
        other=("1", "-0.178", "0.8"),
    ),
}
