"""Answers to the checks of lesson 03."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "03-energy": Answers(
        right=("2.76", "0.5 * 2 * (1 + 2 * 0.3) ** 2 + 0.5 * 0.1 * 2**2", "2.75"),
        wrong={
            "no coupling": "0.5 * 2 * 1**2 + 0.5 * (0.1 + 2 * 0.3**2) * 2**2",
            "coupling once": "0.5 * (0.1 + 2 * 0.3**2) * 2**2 + 0.5 * 2 + 0.5 * 2 * 0.3 * 2 * 1",
            "no Steiner": "0.5 * 0.1 * 2**2 + 0.5 * 2 * 1**2 + 2 * 0.3 * 2 * 1",
            "the joint as the centre of mass": "0.5 * 2 * 1**2 + 0.5 * 0.1 * 2**2",
            "Steiner twice": "0.5 * 2 * 1.6**2 + 0.5 * (0.1 + 2 * 0.3**2) * 2**2",
            "minus": "0.5 * 2 * (1 - 0.6) ** 2 + 0.5 * 0.1 * 2**2",
            "no turning": "0.5 * 2 * 1.6**2",
            "without the half": "2 * 1.6**2 + 0.1 * 2**2",
        },
        other=("0", "10"),
    ),
    "03-turned": Answers(
        right=(
            "R @ I_link @ R.T",
            'np.einsum("ia,ab,jb->ij", R, I_link, R)',
            "R @ I_link @ np.linalg.inv(R)",
            "np.dot(R, np.dot(I_link, np.transpose(R)))",
        ),
        wrong={
            "not turned": "I_link",
            "the other way": "R.T @ I_link @ R",
            "left alone": "R @ I_link",
            "right alone": "I_link @ R.T",
            "left alone, back": "R.T @ I_link",
            "right alone, back": "I_link @ R",
            "no transpose": "R @ I_link @ R",
            "entry by entry": "R * I_link * R.T",
            "entry by entry, left": "R * I_link @ R.T",
            "entry by entry, right": "R @ I_link * R.T",
        },
        other=("R", "np.zeros((3, 3))", "np.linalg.inv(I_link)", "R * I_link @ R"),
    ),
    "03-hand": Answers(
        right=('"c"',),
        wrong={letter: f'"{letter}"' for letter in "abd"},
    ),
    "03-ellipse": Answers(
        right=("12.5", "2 / 0.4**2", "2 * 1 / (0.4 * 0.4)"),
        wrong={
            "the smallest": "2 / 2.5**2",
            "without the half of K": "1 / 0.4**2",
            "the smallest, without the half of K": "1 / 2.5**2",
            "not squared": "2 / 0.4",
            "upside down": "0.4**2 / 2",
            "half-axis": "0.4",
        },
        other=("1", "2.5"),
    ),
    "03-brake": Answers(
        right=('"d"', '"D"'),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
}
