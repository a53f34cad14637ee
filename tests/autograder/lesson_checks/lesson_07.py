"""Answers to the checks of lesson 07."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "07-hand": Answers(
        right=("2.6", "np.hypot(1, 0.8 * 3)", "np.sqrt(1 + 0.8**2 * 9)"),
        wrong={
            "rate of joint 2 alone": "np.hypot(1, 0.8 * 2)",
            "centre of mass": "np.hypot(1, 0.4 * 3)",
            "speeds added": "1 + 0.8 * 3",
            "one rigid body": "np.hypot(1, 0.8)",
            "squared": "1 + (0.8 * 3) ** 2",
            "relative to the elbow": "0.8 * 3",
            "speed of the elbow": "1 * 1",
        },
        other=("0", "5", "-2.6"),
    ),
    "07-load": Answers(
        right=("1.64", "1**2 + 0.8**2", "1 * (arm.l1**2 + arm.l2**2)"),
        wrong={
            "stretched": "1.8**2",
            "about joint 2": "0.8**2",
            "at the centre of mass": "1 + 0.4**2",
            "distance not squared": "np.hypot(1, 0.8)",
            "halved": "0.5 * 1.64",
            "all of M11": "3.43 + 1.64",
            "at the elbow": "1.0",
        },
        other=("0", "2.5", "-1.64"),
    ),
    "07-push": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
    "07-degrees": Answers(
        right=(
            "0.001045",
            "3.43 * (np.pi / 180) ** 2",
            "arm.M([0, np.pi / 2])[0, 0] * np.radians(1) ** 2",
        ),
        wrong={
            "once": "3.43 * np.radians(1)",
            "unchanged": "3.43",
            "the other way": "3.43 * (180 / np.pi) ** 2",
            "once, the other way": "3.43 * 180 / np.pi",
            "halved": "3.43 * np.radians(1) ** 2 / 2",
            "half a turn for a whole one": "3.43 * (2 * np.pi / 180) ** 2",
        },
        other=("0", "1", "0.43 * np.radians(1) ** 2"),
    ),
    "07-reversed": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
}
