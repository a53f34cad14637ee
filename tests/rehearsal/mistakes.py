"""Wrong answers, and which part of a test's points each keeps, as the problem's own text gives them."""

import random
from collections.abc import Iterator
from dataclasses import dataclass, field

from tests.submissions.c6_regressor import RIGHT as C6
from tests.submissions.c7_recursive import RIGHT as C7
from tests.submissions.c8_control import RIGHT as C8
from tests.submissions.p1_inertia import RIGHT as P1
from tests.submissions.p2_energy_skew import RIGHT as P2
from tests.submissions.p3_pendulum import RIGHT as P3
from tests.submissions.p4_gravity import RIGHT as P4
from tests.submissions.p5_state_space import RIGHT as P5


@dataclass(frozen=True)
class Mistake:
    """What is wrong in one hand-in; the rest of it is right.

    answers: the cells in which it is, by the name of the function. kept: the part of its points that
    each test keeps; those not named keep all. published: the words of the problem that say so. told: by
    check, words that the lecturer reads of it in the report, in which nothing counts that only follows;
    none where the code gives no numbers. often: how often it is made beside the others.
    """

    answers: dict[str, str]
    kept: dict[str, float]
    published: str = ""
    told: dict[str, str] = field(default_factory=dict)
    often: float = 1.0


def made_in(name: str, dice: random.Random) -> Iterator[Mistake]:
    """The mistakes of an assignment: each once, then as often as each is made."""
    known = MISTAKES[name]
    yield from known
    while True:
        yield from dice.choices(known, [one.often for one in known])


# Of what is wrong but follows from an earlier wrong answer, half counts (docs/grading-rules.md).
CARRIED = 0.5
OF_A_LAGRANGIAN = "# Checks the kinetic and the potential part of L, each for half of the points."
OF_TORQUES = "at random angles, on several planets, half of the points each."

MISTAKES = {
    "p1-inertia": (
        Mistake(
            {"M": P1["M"].replace("+ 2 * arm.l1", "+ arm.l1")},
            {"p1-M": 0.5},
            "$M_{11}$ counts for half of the points.",
            {"p1-M": "coupling in your M11 is half"},
            often=2,
        ),
        Mistake(
            {
                "inertia_from_links": P1.function(
                    "inertia_from_links", "jacobians[-1].T @ inertias[-1] @ jacobians[-1]"
                )
            },
            {"p1-inertia_from_links": 0.5},
            "# Checks the matrix of one link, and that of several, each for half of the points.",
            {"p1-inertia_from_links": "only the last link"},
        ),
        Mistake(  # raises in each call
            {"is_spd": P1.function("is_spd", "A.is_positive_definite()")}, {"p1-is_spd": 0}
        ),
    ),
    "p2-energy-skew": (
        Mistake(
            {
                "C": P2.function(
                    "C",
                    "h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])\n"
                    "return np.array([[0, h * (2 * qd[0] + qd[1])], [-h * qd[0], 0]])",
                )
            },
            {"p2-C": 3.5 / 5},
            "| 1.5 | $\\dot M - 2C$ is skew-symmetric",
            {"p2-C": "not skew-symmetric"},
            often=3,
        ),
        Mistake(
            {"C": P2["C"].replace("return C", "return -C")},
            {"p2-C": 0, "p2-C_other": CARRIED},
            told={"p2-C": "wrong sign"},
        ),
        Mistake(  # prints megabytes, and is right
            {"M_dot": P2["M_dot"] + 'print("eps = 1e-6, tried again\\n" * 200_000)'}, {}, often=0.1
        ),
        Mistake({"M_dot": P2.function("M_dot", "arm.M_dot")}, {"p2-M_dot": 0}),  # raises
    ),
    "p3-pendulum": (
        Mistake(
            {"g_vec": P3.function("g_vec", "pend.m * pend.g * pend.lc * np.cos(q)")},
            {"p3-g_vec": 0},
            told={"p3-g_vec": "cosine of q where the sine belongs"},
            often=2,
        ),
        Mistake(
            {
                "lagrangian": P3.function("lagrangian", "I * qd**2 + m * g * lc * sp.cos(q)"),
                "M": P3.function("M", "[[2 * pend.I]]"),
            },
            {"p3-lagrangian": 0.5, "p3-M": CARRIED},
            OF_A_LAGRANGIAN,
            {"p3-lagrangian": "kinetic part"},
        ),
        Mistake(
            {
                "lagrangian": P3.function("lagrangian", "I * qd**2 / 2 - m * g * lc * sp.cos(q)"),
                "g_vec": P3.function("g_vec", "-pend.m * pend.g * pend.lc * np.sin(q)"),
            },
            {"p3-lagrangian": 0.5, "p3-g_vec": CARRIED},
            OF_A_LAGRANGIAN,
            {"p3-lagrangian": "potential part"},
        ),
        Mistake(  # never ends
            {
                "inertia_about_pivot": P3.function(
                    "inertia_about_pivot", "while m > 0:\n    lc /= 2\nreturn I_com"
                )
            },
            {"p3-inertia_about_pivot": 0},
            often=0.1,
        ),
    ),
    "p4-gravity": (
        Mistake(
            {
                "g_vec": P4.function(
                    "g_vec",
                    "[(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]),"
                    " arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])]",
                )
            },
            {"p4-g_vec": 0.5},
            OF_TORQUES,
            {"p4-g_vec": "g1 lacks the term with the direction of link 2"},
            often=2,
        ),
        Mistake(
            {
                "potential_energy": P4.function(
                    "potential_energy",
                    "-arm.g * (arm.m1 * arm.lc1 * np.sin(q[0]) + arm.m2"
                    " * (arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])))",
                )
            },
            {"p4-potential_energy": 0, "p4-g_vec": CARRIED},
            told={"p4-potential_energy": "wrong sign"},
        ),
        Mistake(  # g2 is right, g1 is what follows
            {"potential_energy": P4["potential_energy"].replace("arm.l1 * np.sin(q[0]) + ", "")},
            {"p4-potential_energy": 0.5, "p4-g_vec": 0.5 + 0.5 * CARRIED},
            OF_TORQUES,
            {"p4-potential_energy": "height of the shoulder"},
        ),
        Mistake(
            {"gravity_from_jacobians": P4["gravity_from_jacobians"].replace("-=", "+=")},
            {"p4-gravity_from_jacobians": 0},
            told={"p4-gravity_from_jacobians": "wrong sign"},
        ),
    ),
    "p5-state-space": (
        Mistake(
            {"f": P5["f"].replace("-= arm", "+= arm")},
            {"p5-f": 0.25},
            "# Checks the velocities (1 point) and the accelerations (3 points) in f(x, u, arm).",
            {"p5-f": "Friction has the wrong sign"},
            often=2,
        ),
        Mistake(  # a run of such steps keeps two of its five points, and half of what follows
            {"rk4_step": P5.function("rk4_step", "x + dt * f(x, u)")},
            {"p5-rk4_step": 0.25, "p5-simulate": 0.4 + 0.6 * CARRIED},
            "even Euler's method is exact, so that a mistake in part B does not cost you those points",
            {"p5-rk4_step": "This is Euler's method"},
        ),
        Mistake(
            {"energy_drift": P5["energy_drift"].replace("e - E[0]", "E[0] - e")},
            {"p5-energy_drift": 0},
            told={"p5-energy_drift": "wrong sign"},
        ),
        Mistake(  # raises, and so does the run that calls it
            {"rk4_step": P5.function("rk4_step", "x + dt * f(x)")},
            {"p5-rk4_step": 0, "p5-simulate": 0},
        ),
    ),
    "c6-regressor": (
        Mistake(
            {"rank_of_excitation": C6.function("rank_of_excitation", "len(regressors)")},
            {"c6-rank_of_excitation": 0},
        ),
    ),
    "c7-recursive": (Mistake({"count": C7.function("count", "return")}, {"c7-count": 0}),),
    "c8-control": (Mistake({"V_dot": C8.function("V_dot", "V")}, {"c8-V_dot": 0}),),
}
