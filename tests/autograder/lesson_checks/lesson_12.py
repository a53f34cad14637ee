"""Answers to the checks of lesson 12."""

from tests.autograder.lesson_checks.answers import Answers

ONE = "2 * np.pi / 16384 / np.sqrt(12)"
TABLE = {
    "12-noise": Answers(
        right=("67.8", f"np.sqrt(6) * {ONE} / 0.002**2", "2 * np.pi / 16384 / np.sqrt(2) / 4e-6"),
        wrong={
            "weights of one": f"np.sqrt(3) * {ONE} / 0.002**2",
            "middle squared no": f"np.sqrt(1 + 2 + 1) * {ONE} / 0.002**2",
            "errors added": f"4 * {ONE} / 0.002**2",
            "one error": f"{ONE} / 0.002**2",
            "whole step": "np.sqrt(6) * 2 * np.pi / 16384 / 0.002**2",
            "half a step": "np.sqrt(6) * np.pi / 16384 / 0.002**2",
            "velocity": f"np.sqrt(2) * {ONE} / (2 * 0.002)",
            "divided once": f"np.sqrt(6) * {ONE} / 0.002",
            "twice the time": f"np.sqrt(6) * {ONE} / 0.004**2",
            "counts": "np.sqrt(0.5) / 0.002**2",
            "degrees": "360 / 16384 / np.sqrt(2) / 0.002**2",
            "the old encoder": "np.sqrt(6) * 2 * np.pi / 4096 / np.sqrt(12) / 0.002**2",
        },
        other=("0", "-67.8", "1000"),
    ),
    "12-late": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
    "12-payload": Answers(
        right=("0.68", "0.612 / 0.9", "0.612 * 2 * 0.5 / (1.512 - 0.612)"),
        wrong={
            "as recorded": "0.612",
            "multiplied": "0.612 * 0.9",
            "the factor": "(1.512 - 0.612) / (2 * 0.5)",
            "loaded arm": "1.512 / 0.9",
            "loaded for added": "0.612 / 1.512",
            "mass alone": "0.612 / (0.9 / 2)",
            "square of the length": "0.612 / (0.9 / (2 * 0.5**2))",
            "less the payload": "1.512 - 2 * 0.5",
        },
        other=("0", "-0.68", "5"),
    ),
    "12-share": Answers(
        right=('"a"',),
        wrong={letter: f'"{letter}"' for letter in "bcd"},
    ),
}
