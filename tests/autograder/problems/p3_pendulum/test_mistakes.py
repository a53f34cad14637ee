"""Every mistake, as a student would type it: its exact sentence, its credit and its witness.

The table is typed out on purpose: a mistake's wording is read by students, and changes only with
intent.
"""

import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.problems.p3_pendulum import mistakes as p3_pendulum
from autograder.problems.start_here import mistakes as start_here
from autograder.judging.verdict import State
from tests.autograder.verdicts import assert_named, judged, sentences_of

MGL = "pend.m * pend.g * pend.lc"
PIVOT = (
    "The inertia you use is too large by m ℓc²: pend.I is about the pivot already. Where has the "
    "parallel-axis theorem been applied once too often?"
)
KINETIC, POTENTIAL = "I * qd**2 / 2", "m * g * lc * (1 - sp.cos(q))"

# check, the body that a student would return, the credit left, the sentences.
TABLE = [
    (
        "start-kinetic-energy",
        "I * qd**2",
        0,
        "Your kinetic energy is twice the right one. What stands in front of a kinetic energy?",
    ),
    (
        "start-kinetic-energy",
        "I * qd / 2",
        0,
        "Your kinetic energy changes sign with the velocity. Can a moving body's be negative?",
    ),
    ("p3-M", "pend.I + pend.m * pend.lc**2", 0, PIVOT),
    (
        "p3-M",
        "[[pend.I - pend.m * pend.lc**2]]",
        0,
        "This is the inertia about the centre of mass. The pendulum turns about its pivot: about "
        "which point must the inertia in K = ½ M q̇² be taken?",
    ),
    (
        "p3-M",
        "pend.m * pend.lc**2",
        0,
        "This is the inertia of a point mass at the centre of mass. The body has a size: which "
        "parameter of pend tells how its mass is spread?",
    ),
    (
        "p3-M",
        "np.linalg.inv([[pend.I]])",
        0,
        "This is the inverse of the inertia. Which of M and M⁻¹ multiplies q̈ in the equation?",
    ),
    (
        "p3-M",
        "pend.m",
        0,
        "This is the mass. The coordinate is an angle: what resists an angular acceleration?",
    ),
    (
        "p3-C",
        f"[[{MGL} * np.sin(q[0])]]",
        0,
        "This is the gravity torque. Gravity does not depend on q̇: where does it belong in the "
        "equation of motion?",
    ),
    (
        "p3-C",
        "pend.I",
        0,
        "This is the inertia. It multiplies q̈; C multiplies q̇ and comes from how M changes with q.",
    ),
    (
        "p3-C",
        "pend.m * pend.lc * qd",
        0,
        "C is not zero here, but proportional to m ℓc q̇. The centripetal force points at the "
        "pivot: what is its torque about the pivot?",
    ),
    (
        "p3-C",
        "pend.I * qd",
        0,
        "C is not zero here, but M q̇, the angular momentum. C comes from ∂M/∂q: does this M change "
        "with q?",
    ),
    (
        "p3-C",
        "0.3 + q",
        0,
        "Your C is not zero. Every entry of C is made of derivatives of M with respect to q: how "
        "does this M change with q?",
    ),
    (
        "p3-g_vec",
        f"-{MGL} * np.sin(q)",
        0,
        "Your gravity torque has the wrong sign: it pushes the pendulum away from hanging. Is q "
        "measured from hanging down, and is g on the left of the equation?",
    ),
    (
        "p3-g_vec",
        f"{MGL} * np.cos(q)",
        0,
        "You have the cosine of q where the sine belongs: hanging straight down (q = 0) your "
        "pendulum feels its largest torque. From which direction is q measured?",
    ),
    (
        "p3-g_vec",
        f"-{MGL} * np.cos(q)",
        0,
        "Your torque varies as −cos q, as if q were measured from the horizontal. From which "
        "direction is q measured here, and where must the torque vanish?",
    ),
    (
        "p3-g_vec",
        f"{MGL} * np.sin(np.radians(q))",
        0,
        "The angle is turned from degrees to radians once too often: q comes in radians already.",
    ),
    (
        "p3-g_vec",
        f"{MGL} * np.sin(np.degrees(q))",
        0,
        "The sine is taken of an angle in degrees: NumPy's sine wants radians, and q is in radians "
        "already.",
    ),
    (
        "p3-g_vec",
        "pend.m * pend.g * np.sin(q)",
        0,
        "This is a force, in newtons: the lever arm ℓc is missing. What turns a force into a torque?",
    ),
    (
        "p3-g_vec",
        "pend.m * pend.lc * np.sin(q)",
        0,
        "The gravitational acceleration g is missing from your torque. What is the weight of m?",
    ),
    (
        "p3-g_vec",
        "pend.g * pend.lc * np.sin(q)",
        0,
        "The mass is missing from your torque. What is the weight of the body?",
    ),
    (
        "p3-g_vec",
        "pend.m * 9.81 * pend.lc * np.sin(q)",
        0,
        "Your torque is right on Earth only: 9.81 is written into it. The check also swings the "
        "pendulum on other planets; which parameter of pend gives g?",
    ),
    (
        "p3-g_vec",
        f"{MGL} * q",
        0,
        "This holds for small angles only. g(q) is asked for at any q.",
    ),
    (
        "p3-g_vec",
        f"{MGL} * (1 - np.cos(q))",
        0,
        "This is the potential energy P. What turns P(q) into the gravity torque g(q)?",
    ),
    (
        "p3-g_vec",
        f"{MGL} * np.sin(q) / pend.I",
        0,
        "This is an acceleration: the torque has been divided by I already. In M q̈ + g = u, what "
        "does M multiply?",
    ),
    (
        "p3-lagrangian",
        f"I * qd**2 - {POTENTIAL}",
        0.5,
        "The kinetic part of your L is twice the right one. What stands in front of a kinetic energy?",
    ),
    (
        "p3-lagrangian",
        f"(I + m * lc**2) * qd**2 / 2 - {POTENTIAL}",
        0.5,
        "The kinetic part of your L counts the motion of the centre of mass twice: I is about the "
        "pivot already. What does the parallel-axis theorem add, and has it been added before?",
    ),
    (
        "p3-lagrangian",
        f"(I - m * lc**2) * qd**2 / 2 - {POTENTIAL}",
        0.5,
        "The kinetic part of your L uses the inertia about the centre of mass and leaves out the "
        "motion of that centre. About which point does the body turn?",
    ),
    (
        "p3-lagrangian",
        f"m * lc**2 * qd**2 / 2 - {POTENTIAL}",
        0.5,
        "The kinetic part of your L is that of a point mass. Which parameter tells how the mass is "
        "spread?",
    ),
    (
        "p3-lagrangian",
        f"{KINETIC} + {POTENTIAL}",
        0.5,
        "The potential part of your L has the wrong sign. Is L the sum of K and P or their "
        "difference, and does your P grow as the pendulum rises?",
    ),
    (
        "p3-lagrangian",
        f"{KINETIC} - m * g * lc * sp.sin(q)",
        0.5,
        "The potential part of your L varies with sin q. At what height is the centre of mass when "
        "the pendulum hangs straight down (q = 0), and at q = π/2?",
    ),
    (
        "p3-lagrangian",
        f"{KINETIC} + m * g * lc * sp.sin(q)",
        0.5,
        "The potential part of your L varies with −sin q. At what height is the centre of mass when "
        "the pendulum hangs straight down (q = 0), and at q = π/2?",
    ),
    (
        "p3-lagrangian",
        f"{KINETIC} - m * g * (1 - sp.cos(q))",
        0.5,
        "The length ℓc is missing from the potential part of your L. How high does the centre of "
        "mass rise?",
    ),
    (
        "p3-lagrangian",
        f"{KINETIC} - m * g * lc * (1 - sp.cos(q * sp.pi / 180))",
        0.5,
        "The angle in the potential part of your L is turned from degrees to radians once too "
        "often: q is in radians already.",
    ),
    (
        "p3-lagrangian",
        KINETIC,
        0.5,
        "Your L has no potential part. Which energy does the body gain as it rises?",
    ),
    (
        "p3-inertia_about_pivot",
        "I_com",
        0,
        "This is the inertia about the centre of mass, as it was given. What does moving the axis "
        "from there to the pivot add?",
    ),
    (
        "p3-inertia_about_pivot",
        "I_com - m * lc**2",
        0,
        "You moved the axis the wrong way. About which of all parallel axes is the inertia smallest?",
    ),
    (
        "p3-inertia_about_pivot",
        "I_com + m * lc",
        0,
        "What you add is not an inertia: look at its unit. What power of the distance gives kg·m²?",
    ),
    (
        "p3-inertia_about_pivot",
        "m * lc**2",
        0,
        "This is a point mass at the centre of mass. Where does the body's own inertia enter?",
    ),
    (
        "p3-inertia_about_pivot",
        "I_com + m * lc**2 / 2",
        0,
        "The parallel-axis term is too small by half. The ½ belongs to a kinetic energy; does it "
        "belong to an inertia?",
    ),
    (
        "p3-small_angle_frequency",
        "np.sqrt(pend.g / pend.lc)",
        0,
        "This is the frequency of a point mass on a string. Which inertia does this pendulum have?",
    ),
    (
        "p3-small_angle_frequency",
        f"{MGL} / pend.I",
        0,
        "This is the square of the frequency: look at its unit.",
    ),
    (
        "p3-small_angle_frequency",
        f"2 * np.pi * np.sqrt(pend.I / ({MGL}))",
        0,
        "This is the period, in seconds. The angular frequency, in rad/s, is asked for.",
    ),
    (
        "p3-small_angle_frequency",
        f"np.sqrt({MGL} / pend.I) / (2 * np.pi)",
        0,
        "This is the frequency in hertz (turns per second). In rad/s is asked for.",
    ),
    (
        "p3-small_angle_frequency",
        f"np.sqrt(pend.I / ({MGL}))",
        0,
        "Your ratio is upside down: does a pendulum of larger inertia swing faster or slower?",
    ),
    (
        "p3-small_angle_frequency",
        f"np.sqrt({MGL} / (pend.I + pend.m * pend.lc**2))",
        0,
        PIVOT,
    ),
]


@pytest.mark.parametrize(("check_id", "returned", "credit", "sentence"), TABLE)
def test_sentence_credit_and_witness(check_id, returned, credit, sentence):
    assert_named(check_id, returned, credit, sentence)


def test_every_mistake_has_its_row():
    said = {sentence for _, _, _, sentence in TABLE}
    known = sentences_of(start_here) | sentences_of(p3_pendulum)
    assert known <= said


def test_two_mistakes_in_different_terms_are_both_named():
    verdict = judged("p3-lagrangian", f"I * qd**2 + {POTENTIAL}")
    assert len(verdict.diagnosis) == 2
    assert "twice the right one" in verdict.diagnosis[0]
    assert "wrong sign" in verdict.diagnosis[1]


@pytest.mark.parametrize(
    ("check_id", "returned", "said"),
    [
        (
            "p3-M",
            "1.1 * pend.I",
            "inertia about the pivot varies like the inertia about the pivot (+0.1",
        ),
        (
            "p3-g_vec",
            f"{MGL} * np.sin(q) * 1.0001",
            "gravity torque varies like the torque of the weight (+0.0001",
        ),
        (
            "p3-g_vec",
            f"-{MGL} * np.sin(q) * 1.0001",
            "gravity torque varies like the torque of the weight (-2",
        ),
        (
            "p3-inertia_about_pivot",
            "I_com + 0.9 * m * lc**2",
            "inertia moved to the pivot varies like the inertia of a point mass (-0.1",
        ),
        (
            "p3-lagrangian",
            f"1.2 * {KINETIC} - {POTENTIAL}",
            "kinetic part of L varies like the kinetic energy of the body (+0.2",
        ),
        (
            "p3-lagrangian",
            f"{KINETIC} - 0.7 * {POTENTIAL}",
            "potential part of L varies like the potential energy of the raised mass (-0.3",
        ),
    ],
)
def test_unknown_error_is_traced_to_its_term(check_id, returned, said):
    verdict = judged(check_id, returned)
    assert verdict.diagnosis == (f"The error in your {said} times it).",)
    assert verdict.witness is not None


@pytest.mark.parametrize(
    ("check_id", "returned"),
    [("p3-M", "q[0]"), ("p3-g_vec", "q[0] ** 4"), ("p3-small_angle_frequency", "1.0")],
)
def test_unknown_error_is_not_diagnosed(check_id, returned):
    verdict = judged(check_id, returned)
    assert verdict.state is State.INCORRECT
    assert verdict.diagnosis == ()
    assert verdict.witness is not None


def test_mistake_is_named_only_where_it_matches_to_rounding():
    close = f"{MGL} * np.cos(q) * (1 + {20 * TOLERANCE})"
    assert judged("p3-g_vec", close).diagnosis == ()
    assert judged("p3-g_vec", f"np.float32({MGL} * np.cos(q))").diagnosis != ()
