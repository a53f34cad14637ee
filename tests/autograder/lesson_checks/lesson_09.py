"""Answers to the checks of lesson 09."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "09-push": Answers(
        right=("2.5", "6/4 - 0.5 * -2", "np.linalg.solve([[4, 2], [2, 1.5]], [6, 2])[0]"),
        wrong={
            "joint 2": "np.linalg.solve([[4, 2], [2, 1.5]], [6, 2])[1]",
            "as if alone": "6 / 4",
            "sign upwards": "6/4 + 0.5 * -2",
            "nothing downwards": "6/4 - 0.5 * 2 / 0.5",
            "sign downwards": "6/4 - 0.5 * (2 + 3) / 0.5",
            "M22 for D2": "6/4 + 0.5 * 1 / 1.5",
            "sign in D2": "6/4 + 0.5 * 1 / (1.5 + 1)",
            "undivided": "6 + 0.5 * 1",
            "D2 not divided by": "6/4 + 0.5 * 1",
            "determinant": "1.5 * 6 - 2 * 2",
        },
        other=("0", "12", "-2.5"),
    ),
    "09-joint": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abce"},
    ),
    "09-loop": Answers(
        right=('"c"',),
        wrong={letter: f'"{letter}"' for letter in "abd"},
    ),
    "09-rod": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abce"},
    ),
    "09-single": Answers(
        right=("4.8", "np.log(0.01 / 6e-8) / 2.5", "(np.log(1e-2) - np.log(2.0**-24)) / 2.5"),
        wrong={
            "logarithm to base 10": "np.log10(0.01 / 6e-8) / 2.5",
            "until 1": "np.log(1 / 6e-8) / 2.5",
            "double precision": "np.log(0.01 / 1e-16) / 2.5",
            "the time of the text": "37 / 2.5",
            "not divided by λ": "np.log(0.01 / 6e-8)",
            "multiplied by λ": "np.log(0.01 / 6e-8) * 2.5",
            "upside down": "np.log(6e-8 / 0.01) / 2.5",
        },
        other=("0", "0.01 / 6e-8 / 2.5", "100"),
    ),
}
