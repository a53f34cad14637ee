"""Answers to the checks of lesson 10."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "10-ahead": Answers(
        right=("3/4", "0.5 / (2/3)", "sp.Rational(3, 4)"),
        wrong={
            "weight of the first": "1/4",
            "half of c": "1/3",
            "without the half": "3/2",
            "a plain mean": "0.5",
            "c itself": "0.67",
            "the second alone": "1",
        },
        other=("0", "-0.75", "3"),
    ),
    "10-halved": Answers(
        right=("3", "np.log2(3.2e-4 / 4e-5)", "np.log(8) / np.log(2)"),
        wrong={
            "ratio": "3.2e-4 / 4e-5",
            "order 4": "4",
            "natural logarithm": "np.log(8)",
            "logarithm to base 10": "np.log10(8)",
            "from first to last": "1.5",
            "upside down": "np.log2(4e-5 / 3.2e-4)",
            "inverse ratio": "4e-5 / 3.2e-4",
        },
        other=("0", "1", "2"),
    ),
    "10-promise": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
    "10-balance": Answers(
        right=("1.7", "-7.4 - (5.1 - 14.2)", "14.2 - 5.1 - 7.4"),
        wrong={
            "sign": "7.4 + 5.1 - 14.2",
            "without the motors": "14.2 - 7.4",
            "without friction": "-7.4 - 5.1",
            "by the balance": "5.1 - 14.2",
            "change of the run": "-7.4",
            "rise for fall": "7.4 - (5.1 - 14.2)",
            "motors counted as a loss": "-7.4 + 5.1 + 14.2",
        },
        other=("0", "7.4", "-19.3"),
    ),
    "10-tips": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
}
