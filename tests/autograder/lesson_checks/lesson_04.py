"""Answers to the checks of lesson 04."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "04-entry": Answers(
        right=("-6", "(5 * 2 + 4 * -1) / -1", "-6.0"),
        wrong={
            "sign of the velocity": "5 * 2 - 4",
            "entry kept": "4",
            "sum of the row": "5 + 4",
            "speeds for velocities": "5 * 2 + 4 * 1",
            "speed, then sign": "(5 * 2 + 4 * 1) / -1",
        },
        other=("0", "10"),
    ),
    "04-power": Answers(
        right=("qd @ (u - f)", "sum(qd * u) - np.dot(qd, f)", "np.vecdot(qd, u - f)"),
        wrong={
            "friction added": "qd @ (u + f)",
            "friction left out": "u @ qd",
            "sign of the whole": "qd @ f - qd @ u",
            "halved": "0.5 * qd @ (u - f)",
            "torques alone": "sum(u - f)",
            "sizes": "np.sum(np.abs(qd * (u - f)))",
        },
        other=("0.0", "sum(qd)", "u @ u - f @ f"),
    ),
    "04-rate": Answers(
        right=("-3", "2 + (-5)"),
        wrong={
            "twice C12": "2 * 2",
            "twice C21": "2 * -5",
            "difference": "2 - (-5)",
            "difference the other way": "-5 - 2",
            "mean": "(2 - 5) / 2",
            "sign": "3",
        },
        other=("0", "2", "-5"),
    ),
    "04-upright": Answers(
        right=("84.4", "2 * 9.81 * (3 * 0.5 + 2 * (1 + 0.4))", "84"),
        wrong={
            "down to level": "42.2",
            "without gravity": "2 * (3 * 0.5 + 2 * 1.4)",
            "nothing": "0",
            "sign": "-84.4",
            "elbow at the base": "2 * 9.81 * (3 * 0.5 + 2 * 0.4)",
            "at the ends": "2 * 9.81 * (3 * 1 + 2 * 1.8)",
        },
        other=("100", "1"),
    ),
    "04-needs": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
}
