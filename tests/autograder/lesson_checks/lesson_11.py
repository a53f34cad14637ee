"""Answers to the checks of lesson 11."""

from tests.autograder.lesson_checks.answers import Answers

FREE = "J @ np.linalg.inv(M) @ J.T"
TABLE = {
    "11-triangle": Answers(
        right=("0.0785", "0.066 + 0.0125"),
        wrong={
            "the larger of the two": "0.066",
            "difference of the two": "0.066 - 0.0125",
            "as printed": "0.086",
            "what is missing": "0.086 - 0.0785",
            "about the joint": "0.0785 + 4.8 * 0.07**2",
        },
        other=("0", "0.1", "-0.0785"),
    ),
    "11-fling": Answers(
        right=("-3.47", "-3.472"),
        wrong={
            "sign": "3.472",
            "speed not squared": "-1.736",
            "without the half": "-6.944",
            "with gravity": "-25.64 - 3.47",
            "gravity alone": "-25.64",
            "the elbow's row": "-0.444",
        },
        other=("0", "-40", "1.736"),
    ),
    "11-gear": Answers(
        right=("409e-6 * (107.815 / 2) ** 2", "1.19", "1.1886"),
        wrong={
            "halved": "107.815**2 * 409e-6 / 2",
            "as before": "107.815**2 * 409e-6",
            "what is saved": "107.815**2 * 409e-6 * 0.75",
            "twice the ratio": "(2 * 107.815) ** 2 * 409e-6",
            "ratio not squared": "107.815 / 2 * 409e-6",
            "rotor alone": "409e-6",
        },
        other=("0", "-1.19", "107.815 / 2"),
    ),
    "11-feel": Answers(
        right=(
            f"1 / (e @ {FREE} @ e)",
            "1 / np.dot(e, J @ np.linalg.solve(M, J.T @ e))",
        ),
        wrong={
            "on rails": f"e @ np.linalg.inv({FREE}) @ e",
            "not inverted": f"e @ {FREE} @ e",
            "M for its inverse": "1 / (e @ J @ M @ J.T @ e)",
            "M, not inverted": "e @ J @ M @ J.T @ e",
            "whole acceleration": f"1 / np.linalg.norm({FREE} @ e)",
        },
        other=("0.0", "np.trace(M)", "e @ e"),
    ),
    "11-wall": Answers(
        right=('"d"', '"D"'),
        wrong={letter: f'"{letter}"' for letter in "abce"},
    ),
}
