"""Every mistake about gravity, as a student would type it: its exact sentence, credit and witness."""

import itertools

import numpy as np
import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.problems.p4_gravity import mistakes as p4_gravity
from autograder.problems import CHECKS
from autograder.judging.verdict import State
from tests.autograder.verdicts import assert_named, judged, sentences_of

NAMES = "\n".join(f"{name} = arm.{name}" for name in ("l1", "l2", "lc1", "lc2", "m1", "m2", "g"))
ANGLES = "q1, q2 = q\n"


def P(returned):
    """A body that names the arm's parameters, as most students begin."""
    return f"{NAMES}\n{ANGLES}return {returned}"


def of_links(kind="np.sin", first="q1", second="q1 + q2"):
    return P(f"g * (m1*lc1*{kind}({first}) + m2*(l1*{kind}({first}) + lc2*{kind}({second})))")


def torque(kind="np.cos", first="q1", second="q1 + q2", sign=""):
    return P(
        f"[{sign}((m1*lc1 + m2*l1)*g*{kind}({first}) + m2*lc2*g*{kind}({second})), "
        f"{sign}m2*lc2*g*{kind}({second})]"
    )


def with_lines(body, *lines):
    """The body, with these lines before its last."""
    *first, last = body.splitlines()
    return "\n".join([*first, *lines, last])


HARD_CODED_G = (
    "Your answer is right on Earth only: 9.81 is written into it. The check also puts the arm on "
    "other planets; which parameter of arm gives g?"
)
EXAMPLE_ARM = (
    "These are the numbers of the arm in the set-up cell, whatever arm is given. Where does your "
    "function read the parameters of its own argument?"
)
EXAMPLE_LINES = (
    "l1, lc1, m1 = 0.45, 0.21, 4.2",
    "lc2, m2, g = 0.17, 2.6, 9.81",
)
ONCE_TOO_OFTEN = (
    "The angles are turned from degrees to radians once too often: q comes in radians already."
)
IN_DEGREES = (
    "NumPy takes angles in radians, and q is in radians already: nothing is to be converted."
)
LINK_1_LENGTH = (
    "You let the weight of link 1 act at its end. Which of l1 and lc1 leads to the centre of mass "
    "of link 1?"
)
LINK_2_LENGTH = (
    "You let the weight of link 2 act at its tip. Which of l2 and lc2 leads to the centre of mass "
    "of link 2?"
)
ELBOW_AT_LC1 = (
    "You let link 2 begin at the centre of mass of link 1. Where on link 1 is the elbow, and which "
    "parameter says so?"
)
MASSES_MISSING = "The masses are missing. What is the weight of a link?"
MASSES_SWAPPED = "m1 and m2 have changed places. Which link carries which mass?"
G_MISSING = "The gravitational acceleration g is missing. What is the weight of a link?"
LENGTH_OF_G0 = (
    "You use the length of g0 and let gravity point straight along one axis. What does the "
    "direction of the vector g0 say?"
)
ONE_COMPONENT = (
    "You use one component of g0 only. A robot may hang on a wall or on a slope: which components "
    "of g0 do work when a centre of mass moves?"
)
EARTH = "9.81 is written into your function. How strong gravity is, and where it points, are both in g0."
LOADS = (
    "You add the masses up along the chain. Each Jacobian belongs to one centre of mass: the mass "
    "of how many links is there?"
)
LEVEL = (
    "Your configurations hold the links level, where gravity pulls hardest. From which axis is q1 "
    "measured, and is it P or its gradient that must vanish?"
)
STRETCHED = (
    "Yours are equilibria, but only with the arm stretched. Must both links point the same way for "
    "both torques to vanish?"
)
QUARTER = (
    "Where you fold the elbow by a quarter turn, link 2 lies level and pulls on both joints. By how "
    "much must the elbow turn from stretched to folded?"
)
ABSOLUTE = "You take q2 for the direction of link 2 in space. From what is q2 measured?"
DIFFERENCE = (
    "You take the difference of the angles for the direction of link 2. Turn the elbow a little "
    "counter-clockwise: does the direction of link 2 grow or shrink?"
)
ELBOW_FIXED = (
    "Your P does not change as the elbow turns: the whole mass of link 2 seems to sit at the elbow, "
    "or is left out. Where is its centre of mass?"
)
NO_ELBOW = (
    "Your P lifts link 2 from the height of the shoulder. At what height is the elbow, where link 2 "
    "begins?"
)
NO_LINK_2 = (
    "In your g1 the term of link 2's direction is missing. Does that direction change when joint 1 "
    "turns and q2 stays?"
)
NO_ELBOW_IN_G1 = (
    "In your g1 the mass m2 lifted with the elbow is missing. What does joint 1 carry besides its "
    "own link?"
)
ABOUT_SHOULDER = (
    "Your g2 is the torque of link 2's weight about the shoulder. About which axis does joint 2 "
    "turn, and does the elbow move with q2?"
)
SUM = "sum({} for m, Jv in zip(masses, jacobians_v))"
LOOP = """
g = np.zeros(jacobians_v.shape[2])
for i in range({}):
    g {} -masses[i] * jacobians_v[i].T @ g0
return g
"""
HALF_PI = "np.pi / 2"

# check, what a student would return or the whole body, the credit left, the sentence.
TABLE = [
    (
        "p4-potential_energy",
        P("-(m1*g*lc1*np.sin(q1) + m2*g*(l1*np.sin(q1) + lc2*np.sin(q1 + q2)))"),
        0,
        "Your P has the wrong sign: it falls as the arm rises. Which way does the gravitational "
        "acceleration point, and does it take work to lift a link?",
    ),
    (
        "p4-potential_energy",
        of_links("np.cos"),
        0,
        "Your P uses cosines: how far out the links reach, or their heights if the angles were "
        "measured from upright. From which axis is q1 measured, and how high is link 1 at q1 = 0?",
    ),
    (
        "p4-potential_energy",
        P("g*(m1*lc1*(1-np.cos(q1)) + m2*(l1*(1-np.cos(q1)) + lc2*(1-np.cos(q1+q2))))"),
        0,
        "Your P measures the angles from hanging down, as the pendulum of problem 3 does. From which "
        "axis is q1 measured here, and how high is link 1 at q1 = 0?",
    ),
    (
        "p4-potential_energy",
        of_links(second="q2"),
        0,
        "Your P takes q2 for the direction of link 2 in space. From what is q2 measured?",
    ),
    (
        "p4-potential_energy",
        of_links(second="q1 - q2"),
        0,
        "Your P takes the difference of the angles for the direction of link 2. Turn the elbow a "
        "little counter-clockwise: does the direction of link 2 grow or shrink?",
    ),
    ("p4-potential_energy", P("m1*g*lc1*np.sin(q1) + m2*g*l1*np.sin(q1)"), 0.5, ELBOW_FIXED),
    ("p4-potential_energy", P("m1*g*lc1*np.sin(q1) + m2*g*lc2*np.sin(q1 + q2)"), 0.5, NO_ELBOW),
    (
        "p4-potential_energy",
        P("m2*g*(l1*np.sin(q1) + lc2*np.sin(q1 + q2))"),
        0.5,
        "Link 1 does not add to your P. Which mass does link 1 lift by itself?",
    ),
    ("p4-potential_energy", with_lines(of_links(), "lc1 = l1"), 0.5, LINK_1_LENGTH),
    ("p4-potential_energy", with_lines(of_links(), "lc2 = l2"), 0.5, LINK_2_LENGTH),
    ("p4-potential_energy", with_lines(of_links(), "l1 = lc1"), 0.5, ELBOW_AT_LC1),
    (
        "p4-potential_energy",
        with_lines(of_links(), "g = 0.5 * g"),
        0,
        "Your P is half the right one. The ½ belongs to a kinetic energy; does it belong here?",
    ),
    (
        "p4-potential_energy",
        P("g * (lc1*np.sin(q1) + l1*np.sin(q1) + lc2*np.sin(q1 + q2))"),
        0,
        MASSES_MISSING,
    ),
    ("p4-potential_energy", with_lines(of_links(), "m1, m2 = m2, m1"), 0, MASSES_SWAPPED),
    (
        "p4-potential_energy",
        P("m1*lc1*np.sin(q1) + m2*(l1*np.sin(q1) + lc2*np.sin(q1 + q2))"),
        0,
        G_MISSING,
    ),
    ("p4-potential_energy", with_lines(of_links(), "g = 9.81"), 0, HARD_CODED_G),
    ("p4-potential_energy", with_lines(of_links(), *EXAMPLE_LINES), 0, EXAMPLE_ARM),
    ("p4-potential_energy", with_lines(of_links(), "q1, q2 = np.deg2rad(q)"), 0, ONCE_TOO_OFTEN),
    ("p4-potential_energy", with_lines(of_links(), "q1, q2 = np.degrees(q)"), 0, IN_DEGREES),
    (
        "p4-g_vec",
        torque(sign="-"),
        0,
        "Your gravity torque has the wrong sign. On which side of M q̈ + C q̇ + g = u does g stand, "
        "and which way must a motor push to hold the arm out to the right?",
    ),
    (
        "p4-g_vec",
        torque("np.sin"),
        0,
        "You have the sine where the cosine belongs: with the links level, your arm feels no "
        "gravity. Has P been differentiated, and from which axis is q1 measured?",
    ),
    (
        "p4-g_vec",
        torque("np.sin", sign="-"),
        0,
        "Your torque varies like −sin, as the gradient of a P made of cosines does. From which axis "
        "is q1 measured, and what is the height of link 1 at q1 = 0?",
    ),
    ("p4-g_vec", torque(second="q2"), 0, ABSOLUTE),
    ("p4-g_vec", torque(second="q1 - q2"), 0, DIFFERENCE),
    ("p4-g_vec", P("[(m1*lc1 + m2*l1)*g*np.cos(q1), m2*lc2*g*np.cos(q1+q2)]"), 0.5, NO_LINK_2),
    (
        "p4-g_vec",
        P("[m1*lc1*g*np.cos(q1) + m2*lc2*g*np.cos(q1+q2), m2*lc2*g*np.cos(q1+q2)]"),
        0.5,
        NO_ELBOW_IN_G1,
    ),
    (
        "p4-g_vec",
        P("[m2*g*(l1*np.cos(q1) + lc2*np.cos(q1+q2)), m2*lc2*g*np.cos(q1+q2)]"),
        0.5,
        "In your g1 the weight of link 1 is missing.",
    ),
    (
        "p4-g_vec",
        P(
            "[(m1*lc1 + m2*l1)*g*np.cos(q1) + m2*lc2*g*np.cos(q1+q2), "
            "m2*g*(l1*np.cos(q1) + lc2*np.cos(q1+q2))]"
        ),
        0.5,
        ABOUT_SHOULDER,
    ),
    (
        "p4-g_vec",
        P("[m1*g*lc1*np.sin(q1), m2*g*(l1*np.sin(q1) + lc2*np.sin(q1 + q2))]"),
        0,
        "These are the potential energies of the links, one by one. What turns P(q) into g(q)?",
    ),
    (
        "p4-g_vec",
        P("np.ones(2) * g * (m1*lc1*np.sin(q1) + m2*(l1*np.sin(q1) + lc2*np.sin(q1 + q2)))"),
        0,
        "This is the potential energy P, in joules. What turns P(q) into g(q)?",
    ),
    (
        "p4-g_vec",
        torque() + "[::-1]",
        0,
        "The torques of the two joints have changed places.",
    ),
    ("p4-g_vec", with_lines(torque(), "lc1 = l1"), 0.5, LINK_1_LENGTH),
    ("p4-g_vec", with_lines(torque(), "lc2 = l2"), 0, LINK_2_LENGTH),
    ("p4-g_vec", with_lines(torque(), "l1 = lc1"), 0.5, ELBOW_AT_LC1),
    (
        "p4-g_vec",
        P("[g*((lc1 + l1)*np.cos(q1) + lc2*np.cos(q1 + q2)), g*lc2*np.cos(q1 + q2)]"),
        0,
        MASSES_MISSING,
    ),
    ("p4-g_vec", with_lines(torque(), "m1, m2 = m2, m1"), 0, MASSES_SWAPPED),
    ("p4-g_vec", with_lines(torque(), "g = 1"), 0, G_MISSING),
    ("p4-g_vec", with_lines(torque(), "g = 9.81"), 0, HARD_CODED_G),
    ("p4-g_vec", with_lines(torque(), *EXAMPLE_LINES), 0, EXAMPLE_ARM),
    ("p4-g_vec", with_lines(torque(), "q1, q2 = np.deg2rad(q)"), 0, ONCE_TOO_OFTEN),
    ("p4-g_vec", with_lines(torque(), "q1, q2 = np.degrees(q)"), 0, IN_DEGREES),
    (
        "p4-gravity_from_jacobians",
        SUM.format("m * Jv.T @ g0"),
        0,
        "Your gravity torque is reversed. g0 points down: does P grow or fall when a centre of mass "
        "moves along g0?",
    ),
    (
        "p4-gravity_from_jacobians",
        SUM.format("m * np.linalg.norm(g0) * Jv[1]"),
        0,
        LENGTH_OF_G0,
    ),
    (
        "p4-gravity_from_jacobians",
        SUM.format("m * np.linalg.norm(g0) * Jv[2]"),
        0,
        LENGTH_OF_G0,
    ),
    ("p4-gravity_from_jacobians", SUM.format("-m * np.linalg.norm(g0) * Jv[1]"), 0, LENGTH_OF_G0),
    ("p4-gravity_from_jacobians", SUM.format("-m * np.linalg.norm(g0) * Jv[2]"), 0, LENGTH_OF_G0),
    ("p4-gravity_from_jacobians", SUM.format("-m * Jv[1] * g0[1]"), 0, ONE_COMPONENT),
    ("p4-gravity_from_jacobians", SUM.format("-m * Jv[2] * g0[2]"), 0, ONE_COMPONENT),
    (
        "p4-gravity_from_jacobians",
        SUM.format("-m * Jv.T @ np.array([0, -9.81, 0])"),
        0,
        EARTH,
    ),
    ("p4-gravity_from_jacobians", SUM.format("m * Jv.T @ np.array([0, 0, 9.81])"), 0, EARTH),
    (
        "p4-gravity_from_jacobians",
        SUM.format("-9.81 * m * Jv.T @ (g0 / np.linalg.norm(g0))"),
        0,
        EARTH,
    ),
    (
        "p4-gravity_from_jacobians",
        SUM.format("-m * Jv.T @ (g0 / np.linalg.norm(g0))"),
        0,
        "You use the direction of g0 only. How strong is gravity?",
    ),
    (
        "p4-gravity_from_jacobians",
        SUM.format("-Jv.T @ g0"),
        0,
        "The masses are left out. What turns the acceleration g0 into a force on a link?",
    ),
    (
        "p4-gravity_from_jacobians",
        "masses = np.cumsum(masses)\nreturn " + SUM.format("-m * Jv.T @ g0"),
        0,
        LOADS,
    ),
    (
        "p4-gravity_from_jacobians",
        "-sum(masses[i:].sum() * jacobians_v[i].T @ g0 for i in range(len(masses)))",
        0,
        LOADS,
    ),
    (
        "p4-gravity_from_jacobians",
        "-np.sum(masses) * np.sum(jacobians_v, axis=0).T @ g0",
        0,
        "Every centre of mass carries the mass of the whole robot here. Which mass belongs to which "
        "Jacobian?",
    ),
    (
        "p4-gravity_from_jacobians",
        LOOP.format("1, len(masses)", "+="),
        0,
        "The first link is left out of your sum. At which index does a list begin?",
    ),
    (
        "p4-gravity_from_jacobians",
        LOOP.format("len(masses) - 1", "+="),
        0,
        "The last link is left out of your sum. Where does your loop end?",
    ),
    (
        "p4-gravity_from_jacobians",
        LOOP.format("len(masses)", "="),
        0,
        "Only the last link is in your result. Is each link added, or does it replace the one before?",
    ),
    (
        "p4-gravity_from_jacobians",
        SUM.format("-m * Jv.reshape(-1, 3) @ g0"),
        0,
        "Reshaping an array is not transposing it: the shape fits, but the entries are in other "
        "places.",
    ),
    ("p4-equilibria", f"[({HALF_PI}, 0), (-{HALF_PI}, 0)]", 0.5, STRETCHED),
    (
        "p4-equilibria",
        f"[-{HALF_PI}, 0]",
        0.5,
        "Only the arm hanging down is in your answer. An equilibrium need not be stable: where else "
        "do both torques vanish?",
    ),
    (
        "p4-equilibria",
        "q1 = np.arccos(0)\nreturn [(q1, np.arccos(0) - q1)]",
        0.5,
        "Only the arm standing upright is in your answer. An inverse cosine gives one angle: how "
        "many angles on the circle have this cosine?",
    ),
    (
        "p4-equilibria",
        f"[({HALF_PI}, 0), ({HALF_PI}, np.pi)]",
        0.5,
        "Yours are equilibria, but in all of them link 1 points up. Which other direction of link 1 "
        "asks for no torque?",
    ),
    (
        "p4-equilibria",
        f"[(-{HALF_PI}, 0), (3 * {HALF_PI}, -np.pi)]",
        0.5,
        "Yours are equilibria, but in all of them link 1 hangs down. Which other direction of link 1 "
        "asks for no torque?",
    ),
    ("p4-equilibria", "[(0, 0), (0, np.pi), (np.pi, 0), (np.pi, np.pi)]", 0, LEVEL),
    ("p4-equilibria", "[(0, 0), (np.pi, 0)]", 0, LEVEL),
    (
        "p4-equilibria",
        f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (-{HALF_PI}, {HALF_PI})]",
        0,
        "Your second angle is the direction of link 2 in space. From what is q2 measured?",
    ),
    (
        "p4-equilibria",
        f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (0, {HALF_PI})]",
        0,
        QUARTER,
    ),
    (
        "p4-equilibria",
        f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (0, -{HALF_PI})]",
        0,
        QUARTER,
    ),
    (
        "p4-equilibria",
        "[(90, 0), (-90, 0), (90, 180), (-90, 180)]",
        0,
        "These are the right angles in degrees. In which unit are angles asked for?",
    ),
]


@pytest.mark.parametrize(("check_id", "body", "credit", "sentence"), TABLE)
def test_sentence_credit_and_witness(check_id, body, credit, sentence):
    assert_named(check_id, body, credit, sentence)


def test_every_mistake_has_its_row():
    assert sentences_of(p4_gravity) == {sentence for *_, sentence in TABLE}


@pytest.mark.parametrize("check_id", dict.fromkeys(check_id for check_id, *_ in TABLE))
def test_each_wrong_model_stands_in_the_table(check_id):
    """Sentences are shared by some: every model needs a row of its own."""
    rows = sum(row[0] == check_id for row in TABLE)
    assert rows == len(CHECKS[check_id].mistakes)


@pytest.mark.parametrize(
    ("check_id", "body", "sentences"),
    [
        (
            "p4-potential_energy",
            with_lines(of_links(), "lc1, lc2 = l1, l2"),
            [LINK_2_LENGTH, LINK_1_LENGTH],
        ),
        ("p4-potential_energy", P("m1*g*lc1*np.sin(q1)"), [ELBOW_FIXED, NO_ELBOW]),
        (
            "p4-g_vec",
            with_lines(torque(), "lc1, lc2 = l1, l2"),
            [LINK_1_LENGTH, LINK_2_LENGTH],
        ),
        (
            "p4-g_vec",
            P("[m1*g*lc1*np.cos(q1), m2*lc2*g*np.cos(q1 + q2)]"),
            [NO_LINK_2, NO_ELBOW_IN_G1],
        ),
        (
            "p4-g_vec",
            P("[m1*g*lc1*np.cos(q1), m2*g*(l1*np.cos(q1) + lc2*np.cos(q1 + q2))]"),
            [NO_LINK_2, NO_ELBOW_IN_G1, ABOUT_SHOULDER],
        ),
        (
            "p4-g_vec",
            P("[(m1*lc1 + m2*l1)*g*np.cos(q1), m2*lc2*g*np.cos(q2)]"),
            [NO_LINK_2, ABSOLUTE],
        ),
    ],
)
def test_mistakes_in_different_terms_are_all_named(check_id, body, sentences):
    assert list(judged(check_id, body).diagnosis) == sentences


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p4-potential_energy",
            with_lines(of_links(), "lc2 = 1.1 * lc2"),
            "The error in your change of P as the elbow turns from 0 to q2 varies like the weight "
            "of link 2 beyond the elbow (+0.1 times it).",
        ),
        (
            "p4-potential_energy",
            with_lines(of_links(), "lc1 = 0.8 * lc1"),
            "varies like the weight of link 1 (-0.2 times it).",
        ),
        (
            "p4-g_vec",
            with_lines(torque(), "l1 = 1.3 * l1"),
            "The error in your gravity torque g1 of joint 1 varies like the weight of link 2 at the "
            "elbow (+0.3 times it).",
        ),
        (
            "p4-gravity_from_jacobians",
            SUM.format("-m * Jv.T @ (g0 * [1, 1, 0.75])"),
            "The error in your gravity torque from the Jacobians varies like the pull along z "
            "(-0.25 times it).",
        ),
    ],
)
def test_an_unknown_error_is_traced_to_its_term(check_id, body, said):
    (sentence,) = judged(check_id, body).diagnosis
    assert sentence.endswith(said)


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p4-potential_energy", "q[0] ** 2 + q[1]"),
        ("p4-gravity_from_jacobians", "1e4 * np.ones(jacobians_v.shape[2])"),
    ],
)
def test_an_error_of_no_known_kind_is_not_explained(check_id, body):
    verdict = judged(check_id, body)
    assert verdict.state is State.INCORRECT
    assert verdict.diagnosis == ()
    assert verdict.witness is not None


def test_a_mistake_is_named_only_where_it_matches_to_rounding():
    for check_id, body in (
        ("p4-g_vec", torque("np.sin")),
        ("p4-potential_energy", of_links("np.cos")),
    ):
        named = judged(check_id, body).diagnosis
        close = with_lines(body, f"g = g * (1 + {20 * TOLERANCE})")
        assert named[0] not in judged(check_id, close).diagnosis
        single = body.replace("return ", "return np.float32(") + ")"
        assert judged(check_id, single).diagnosis == named


FOUR = [(s * np.pi / 2, e) for s in (-1, 1) for e in (0.0, np.pi)]
SAID_OF_SUBSETS = {
    (0, 2): STRETCHED,
    (0,): "Only the arm hanging down is in your answer. An equilibrium need not be stable: where "
    "else do both torques vanish?",
    (2,): "Only the arm standing upright is in your answer. An inverse cosine gives one angle: how "
    "many angles on the circle have this cosine?",
    (2, 3): "Yours are equilibria, but in all of them link 1 points up. Which other direction of "
    "link 1 asks for no torque?",
    (0, 1): "Yours are equilibria, but in all of them link 1 hangs down. Which other direction of "
    "link 1 asks for no torque?",
}


@pytest.mark.parametrize(
    "chosen", [chosen for k in (1, 2, 3) for chosen in itertools.combinations(range(4), k)]
)
def test_some_of_the_equilibria_are_half_of_the_answer(chosen):
    """Every choice of fewer than four: each is right, not all are there, and nothing false is said."""
    verdict = judged("p4-equilibria", repr([FOUR[k] for k in chosen]))
    assert verdict.credit == 0.5
    assert [row.met for row in verdict.rows] == [True, False]
    missing = (
        "At least one equilibrium is missing. Each of the two torques gives a condition: how many "
        "angles within one turn meet it?"
    )
    assert verdict.diagnosis == (SAID_OF_SUBSETS.get(chosen, missing),)


def test_one_configuration_too_many_costs_the_other_half():
    verdict = judged("p4-equilibria", repr([*FOUR, (0.3, 0.0)]))
    assert [row.met for row in verdict.rows] == [False, True]
    assert verdict.diagnosis == (
        "At one of your configurations at least, gravity still asks for a torque. Put each of them "
        "into your g_vec.",
    )


def test_what_is_missing_is_told_apart_though_another_configuration_is_there():
    """The distances alone must not take absolute angles for angles from the vertical."""
    pairs = f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (-{HALF_PI}, {HALF_PI})]"
    said = judged("p4-equilibria", f"{pairs} + [(0, 0)]").diagnosis
    assert said[1:] == (
        "Your second angle is the direction of link 2 in space. From what is q2 measured?",
    )


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p4-g_vec",
            of_links(),
            "returned one number; g has one entry for each joint. Is it P?",
        ),
        ("p4-gravity_from_jacobians", SUM.format("-m * Jv @ g0"), "raised ValueError: matmul"),
        ("p4-equilibria", "[]", "one row (q1, q2) for each configuration is asked for."),
        (
            "p4-equilibria",
            "np.zeros((2, 4))",
            "one row (q1, q2) for each configuration is asked for.",
        ),
    ],
)
def test_numbers_of_another_shape_are_no_physics(check_id, body, said):
    verdict = judged(check_id, body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem
