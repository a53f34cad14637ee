"""Answers to the checks of lesson 00."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "00-torque": Answers(
        right=(
            "M @ qdd + C @ qd + g_vec + f_vec",
            "np.matvec(M, qdd) + np.matvec(C, qd) + g_vec + f_vec",
            "M.dot(qdd) + (C * qd).sum(axis=1) + f_vec + g_vec",
        ),
        wrong={
            "M and C exchanged": "M @ qd + C @ qdd + g_vec + f_vec",
            "both with the accelerations": "M @ qdd + C @ qdd + g_vec + f_vec",
            "both with the velocities": "M @ qd + C @ qd + g_vec + f_vec",
            "friction left out": "M @ qdd + C @ qd + g_vec",
            "gravity left out": "M @ qdd + C @ qd + f_vec",
            "friction subtracted": "M @ qdd + C @ qd + g_vec - f_vec",
            "gravity subtracted": "M @ qdd + C @ qd - g_vec + f_vec",
            "M with both": "M @ qdd + M @ qd + g_vec + f_vec",
            "C with both": "C @ qdd + C @ qd + g_vec + f_vec",
            "transposed": "qdd @ M + qd @ C + g_vec + f_vec",
            "M transposed": "M.T @ qdd + C @ qd + g_vec + f_vec",
            "C transposed": "M @ qdd + qd @ C + g_vec + f_vec",
        },
        other=(
            "g_vec + f_vec",
            "0 * qd",
            "M @ qdd + C @ np.ones(len(qd)) + g_vec + f_vec",
            "M @ (qdd + 2 * qd) + g_vec + f_vec",
            "M @ qdd + (C + C.T) @ qd / 2 + g_vec + f_vec",
        ),
    ),
    "00-size": Answers(
        right=("216", "6**3", "6 * 6 * 6", "np.zeros((6, 6, 6)).size"),
        wrong={
            "a matrix": "6 * 6",
            "sum of the indices": "6 + 6 + 6",
            "a vector": "6",
            "the different ones": "6 * 6 * 7 // 2",
            "joints and indices exchanged": "3**6",
            "from two joints": "2**3",
        },
        other=("0", "1000"),
    ),
    "00-gripper": Answers(
        right=('"d"',),
        wrong={letter: f'"{letter}"' for letter in "abc"},
    ),
    "00-factor": Answers(
        right=("16", "2**2 * 2**2", "4 * 4"),
        wrong={
            "a square missing": "4 + 4",
            "no squares, or one change": "2 * 2",
            "mass grows with the length": "2**2 * 2**3",
            "a power too high": "2**3 * 2**3",
            "less": "1 / 4",
        },
        other=("1", "2", "0"),
    ),
    "00-typed": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
}
