"""Answers to the checks of lesson 05."""

from tests.autograder.lesson_checks.answers import Answers

OUT = "np.cos(np.radians(50))"
A, B = "34.335", "7.848"
TABLE = {
    "05-lever": Answers(
        right=("28.3", f"2 * 9.81 * ({OUT} + 0.8)", f"np.array([2 * arm.g * ({OUT} + arm.l2)])"),
        wrong={
            "mass for weight": f"2 * ({OUT} + 0.8)",
            "q2 from the x axis": f"2 * 9.81 * ({OUT} + 0.8 * {OUT})",
            "at the centre of mass": f"2 * 9.81 * ({OUT} + 0.4)",
            "straight distance": f"2 * 9.81 * np.hypot({OUT} + 0.8, np.sin(np.radians(50)))",
            "vertical distance": "2 * 9.81 * np.sin(np.radians(50))",
            "from the elbow": "2 * 9.81 * 0.8",
            "to the elbow": f"2 * 9.81 * {OUT}",
            "stretched and level": "2 * 9.81 * 1.8",
            "all weights": f"arm.g_vec(np.radians([50, -50]))[0] + 2 * 9.81 * ({OUT} + 0.8)",
            "sign": "-28.3",
        },
        other=("0", "2 * 9.81 * (np.cos(50) + 0.8)", "40"),
    ),
    "05-moon": Answers(
        right=('"c"', '"C"', "' c '", '"(c)"', '"c)"', '"c."'),
        wrong={letter: f'"{letter}"' for letter in "abd"},
    ),
    "05-spring": Answers(
        right=("10.17", f"{A} * {B} / ({A} - {B})", f"{B} + {B}**2 / ({A} - {B})"),
        wrong={
            "H22 alone": B,
            "H22 without gravity": f"{B}**2 / ({A} - {B})",
            "both up": f"{B} - {B}**2 / ({A} + {B})",
            "both down": f"{B}**2 / ({A} + {B}) - {B}",
            "the other saddle": "-10.17",
            "without gravity": "1.04",
        },
        other=("0", A, f"{A} - {B}", "20"),
    ),
    "05-sag": Answers(
        right=("225", "7.848 * np.cos(np.radians(2)) / np.radians(2)", "7.848 / np.radians(2)"),
        wrong={
            "degrees": "7.848 / 2",
            "mass for weight": "0.8 / np.radians(2)",
            "length of link 2": "2 * 9.81 * 0.8 / np.radians(2)",
            "torque of joint 1": "arm.g_vec([0, 0])[0] / np.radians(2)",
            "sine": "7.848 * np.sin(np.radians(2)) / np.radians(2)",
            "upside down": "np.radians(2) / 7.848",
        },
        other=("0", "60", "-225"),
    ),
    "05-upright": Answers(
        right=('"c"',),
        wrong={letter: f'"{letter}"' for letter in "abd"},
    ),
}
