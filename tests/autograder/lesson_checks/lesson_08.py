"""Answers to the checks of lesson 08."""

from tests.autograder.lesson_checks.answers import Answers

FORCE = "2 * 0.3 * 4"
TABLE = {
    "08-steps": Answers(
        right=("7", "2 + 2 + 1 + 2"),
        wrong={
            "written out": "11",
            "sine and cosine alone": "9",
            "one of two": "8",
            "results alone": "3",
            "steps alone": "4",
        },
        other=("0", "6", "10"),
    ),
    "08-shorter": Answers(
        right=('"a"',),
        wrong={letter: f'"{letter}"' for letter in "bcd"},
    ),
    "08-carries": Answers(
        right=(
            "3.32",
            f"0.05 * 4 + (0.3 + 0.4 + 0.6) * {FORCE}",
            f"0.92 + 0.4 * {FORCE} + 0.6 * 2.4",
        ),
        wrong={
            "nothing": "0",
            "joint 3": f"0.05 * 4 + 0.3 * {FORCE}",
            "joint 2": f"0.05 * 4 + 0.7 * {FORCE}",
            "forces alone": f"(0.3 + 0.4 + 0.6) * {FORCE}",
            "to joint 3 alone": f"0.05 * 4 + (0.4 + 0.6) * {FORCE}",
            "torques not passed on": f"0.6 * {FORCE}",
            "forces not passed on": f"0.05 * 4 + (0.3 + 0.6) * {FORCE}",
            "turning link 3 alone": "0.05 * 4",
            "for 1 rad/s²": "3.32 / 4",
        },
        other=("1", "-3.32", "5"),
    ),
    "08-calls": Answers(
        right=("7", "12 + 4 * (10.3 - 12) + 3 * (12.6 - 12)"),
        wrong={
            "velocity once": "12 + 2 * (10.3 - 12) + 3 * (12.6 - 12)",
            "as it was": "12 - 1.7 + 0.6",
            "acceleration once": "12 - 4 * 1.7 + 0.6",
            "without gravity": "4 * (10.3 - 12) + 3 * (12.6 - 12)",
            "calls added": "4 * 10.3 + 3 * 12.6",
            "sum of calls": "10.3 + 12.6",
            "sign of the velocity terms": "12 + 4 * 1.7 + 3 * 0.6",
        },
        other=("0", "12", "-7"),
    ),
    "08-drake": Answers(
        right=("32.5", "2.5 - (-30)"),
        wrong={
            "as they are": "2.5 + (-30)",
            "bias alone": "2.5",
            "gravity alone": "30",
            "difference": "30 - 2.5",
            "gravity of Drake alone": "-30",
        },
        other=("0", "-32.5", "60"),
    ),
}
