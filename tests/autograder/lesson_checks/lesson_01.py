"""Answers to the checks of lesson 01."""

from tests.autograder.lesson_checks.answers import Answers

SHOWN = "(-2 * 0.4 * np.sin(np.radians(45)) * (2 * 2 * 3 + 3**2))"
TABLE = {
    "01-bead": Answers(
        right=("-2.4", "-0.5 * 4**2 * 0.3", "np.array(-2.4)"),
        wrong={
            "sign": "0.5 * 4**2 * 0.3",
            "halved": "-0.5 * 0.5 * 4**2 * 0.3",
            "doubled": "-(4**2) * 0.3",
            "turn not squared": "-0.5 * 4 * 0.3",
            "velocity for place": "-0.5 * 4**2 * 2",
            "nothing": "0",
            "place left out": "-0.5 * 4**2",
        },
        other=("1", "-100", "0.5 * 2"),
    ),
    "01-twice": Answers(
        right=("-47.6", f"4 * {SHOWN}", "-11.9 * 4"),
        wrong={
            "sign": "47.5",
            "doubled": "-2 * 11.9",
            "doubled and turned": "2 * 11.9",
            "the same": "-11.9",
            "turned": "11.9",
            "cubed": f"8 * {SHOWN}",
        },
        other=("0", "-30"),
    ),
    "01-swing": Answers(
        right=('"c"',),
        wrong={letter: f'"{letter}"' for letter in "abde"},
    ),
    "01-ring": Answers(
        right=("1.41", "np.sqrt(2)", "2**0.5"),
        wrong={
            "not rooted": "2",
            "upside down": "1 / np.sqrt(2)",
            "upside down, not rooted": "1 / 2",
            "no difference": "1",
            "accelerations of the rod": "4",
        },
        other=("0", "3"),
    ),
    "01-program": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
}
