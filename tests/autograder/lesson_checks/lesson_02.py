"""Answers to the checks of lesson 02."""

from tests.autograder.lesson_checks.answers import Answers

TABLE = {
    "02-slide": Answers(
        right=("-10.8", "-0.5 * (2 * 2 * 0.6) * 3**2", "-2 * 0.6 * 9.0"),
        wrong={
            "sign": "10.8",
            "without the half": "-(2 * 2 * 0.6) * 3**2",
            "none": "0",
            "the other joint": "(2 * 2 * 0.6) * 3 * 0.4",
            "both velocities": "-0.5 * (2 * 2 * 0.6) * 3 * 0.4",
            "not squared": "-0.5 * (2 * 2 * 0.6) * 3",
            "no slope": "-0.5 * 2 * 0.6**2 * 3**2",
        },
        other=("1", "21.6"),
    ),
    "02-minus": Answers(
        right=('"c"', '" C) "'),
        wrong={letter: f'"{letter}"' for letter in "abd"},
    ),
    "02-torque": Answers(
        right=(
            "h @ qd @ qd",
            'np.einsum("ijk,j,k->i", h, qd, qd)',
            "[qd @ symbols @ qd for symbols in h]",
            "np.matvec(h, qd) @ qd",
            "sum(h[:, j, k] * qd[j] * qd[k] for j in range(len(qd)) for k in range(len(qd)))",
        ),
        wrong={
            "times ones": "(h @ qd).sum(axis=1)",
            "centrifugal alone": 'np.einsum("ijj,j->i", h, qd**2)',
            "Coriolis alone": "h @ qd @ qd - sum(h[:, j, j] * qd[j] ** 2 for j in range(len(qd)))",
            "each product once": (
                "sum(h[:, j, k] * qd[j] * qd[k] for j in range(len(qd)) for k in range(j + 1))"
            ),
            "last index free": 'np.einsum("ijk,i,j->k", h, qd, qd)',
            "halved": "h @ qd @ qd / 2",
            "reversed": "-(h @ qd @ qd)",
            "squares alone": "(h @ qd**2).sum(axis=1)",
            "without velocities": "h.sum(axis=(1, 2))",
        },
        other=("0 * qd", "qd", "abs(h @ qd @ qd)"),
    ),
    "02-cart": Answers(
        right=('"b"',),
        wrong={letter: f'"{letter}"' for letter in "acd"},
    ),
    "02-crank": Answers(
        right=("9.6", "0.5 * 0.3 * 8**2"),
        wrong={
            "none": "0",
            "d/dt alone": "0.3 * 8**2",
            "slope of K alone": "-0.5 * 0.3 * 8**2",
            "the entry of C": "0.5 * 0.3 * 8",
            "rate of M": "0.3 * 8",
            "momentum": "0.8 * 8",
            "energy": "0.5 * 0.8 * 8**2",
        },
        other=("1", "51.2"),
    ),
}
