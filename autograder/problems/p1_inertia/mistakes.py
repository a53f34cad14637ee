"""Mistakes about the inertia matrix of the 2R arm in closed form."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.material import planar_2r, sentences

# The arm that stands in the notebook, for those who write its numbers into a function.
EXAMPLE = SimpleNamespace(
    l1=0.45, l2=0.40, lc1=0.20, lc2=0.18, m1=2.4, m2=1.6, I1=0.045, I2=0.025, g=9.81
)

HALF = "Your M is half the right one. There is a ½ in K = ½ q̇ᵀ M q̇: is it a part of M?"

ABSOLUTE = (
    "Your M belongs to an absolute second angle: its link 2 turns with q̇2 alone. Hold joint 2 "
    "still and move joint 1: does link 2 turn?"
)


def _at_distance(squared):
    """M with a wrong M11: that of a link 2 whose centre of mass is as far away as `squared` says."""

    def wrong(q, arm):
        M = planar_2r.M(q, arm)
        M[0, 0] = arm.I1 + arm.m1 * arm.lc1**2 + arm.I2 + arm.m2 * squared(q[1], arm.l1, arm.lc2)
        return M

    return wrong


COUPLED_TWICE = (
    "Your M11 has the inertia of the stretched arm, and the coupling on top of it. How far is the "
    "centre of mass of link 2 from the shoulder when the elbow is bent?"
)
COSINE_ON_A_SUM = (
    "In your M11, the cosine multiplies more than it should. How far is the centre of mass of link 2 "
    "from the shoulder when the elbow makes a right angle?"
)
ALONG_ONE_LINK = (
    "Your M11 counts only how far the centre of mass of link 2 is from the shoulder along one of the "
    "links. How far is it when the elbow makes a right angle?"
)
# What stands in M11 for the square of the distance from the shoulder to the centre of mass of link 2.
INERTIA = tuple(
    Mistake(name, _at_distance(squared), sentence)
    for name, squared, sentence in (
        (
            "square of the sum and twice the coupling",
            lambda q2, a, b: (a + b) ** 2 + 2 * a * b * np.cos(q2),
            COUPLED_TWICE,
        ),
        (
            "square of the sum and the coupling",
            lambda q2, a, b: (a + b) ** 2 + a * b * np.cos(q2),
            COUPLED_TWICE,
        ),
        (
            "cosine on the square of the sum",
            lambda q2, a, b: (a + b) ** 2 * np.cos(q2),
            COSINE_ON_A_SUM,
        ),
        (
            "cosine on the whole distance",
            lambda q2, a, b: (a**2 + b**2 + 2 * a * b) * np.cos(q2) ** 2,
            COSINE_ON_A_SUM,
        ),
        (
            "distance along link 1",
            lambda q2, a, b: (a + b * np.cos(q2)) ** 2,
            ALONG_ONE_LINK,
        ),
        (
            "distance along link 2",
            lambda q2, a, b: (a * np.cos(q2) + b) ** 2,
            ALONG_ONE_LINK,
        ),
    )
)

INERTIA_SAID = {
    "dropped / the rotation of link 2 / M12": (
        "Your M12 is right except that I2 is missing. Where does link 2's own rotation enter, if "
        "its angular velocity is made of both q̇1 and q̇2?"
    ),
    "dropped / the rotation of link 2 / M11": (
        "Your M11 is right except that I2 is missing. Hold joint 2 and move joint 1: which of the "
        "two links turn?"
    ),
    "dropped / the rotation of link 2": (
        "I2 is missing: in your M, link 2 moves but does not turn. What is its angular velocity?"
    ),
    "dropped / the rotation of link 1": (
        "I1 is missing. Link 1 turns about the shoulder: is all its energy in the motion of its "
        "centre of mass?"
    ),
    "dropped / the mass of link 2 at the elbow": (
        "A term is missing from your M11. Joint 1 carries the whole of link 2 around: how fast "
        "does the elbow move?"
    ),
    "dropped / the centre of mass of link 1 about the shoulder": (
        "I1 is the inertia of link 1 about its centre of mass, but the centre of mass moves as "
        "well. What must you add to M11 to get the inertia about the shoulder?"
    ),
    "dropped / the centre of mass of link 2 about the elbow": (
        "I2 is the inertia of link 2 about its centre of mass, but the centre of mass moves about "
        "the elbow as well. What must you add to get the inertia about the elbow?"
    ),
    "doubled / the centre of mass of link 1 about the shoulder": (
        "Your M11 counts the motion of link 1's centre of mass twice. Have you applied the "
        "parallel-axis theorem once too often?"
    ),
    "doubled / the centre of mass of link 2 about the elbow": (
        "Your M counts the motion of link 2's centre of mass about the elbow twice. Have you "
        "applied the parallel-axis theorem once too often?"
    ),
    "wrong parameter / the centre of mass of link 1 about the shoulder / l1 / lc1": (
        "You put m1 at the end of link 1. How far is link 1's centre of mass from the shoulder?"
    ),
    "wrong parameter / l2 / lc2": (
        "You put m2 at the hand. How far from the elbow is the centre of mass of link 2?"
    ),
    "wrong parameter / the coupling of the two links / l2 / lc2": (
        "You use ℓ2 in the coupling of the two links. At which point of link 2 does its mass act?"
    ),
    "wrong parameter / lc1 / l1": (
        "You hinge link 2 at the centre of mass of link 1. How far from the shoulder is the elbow?"
    ),
    "wrong parameter / the coupling of the two links / lc1 / l1": (
        "You use ℓc1 in the coupling of the two links. Which point of link 1 carries link 2?"
    ),
    "wrong parameter / the mass of link 2 at the elbow / lc1 / l1": (
        "Your M11 carries m2 at the distance ℓc1 from the shoulder. Which point of link 1 carries "
        "link 2?"
    ),
    "wrong parameter / the coupling of the two links / m1 / m2": (
        "You use m1 in the coupling of the two links. Which link has a speed that depends on both "
        "joints?"
    ),
    "wrong angle / the coupling of the two links / q1 / q2": (
        "Your M changes with q1. Turn the whole arm about the shoulder with the elbow locked: does "
        "its inertia change? Which angle sets its shape?"
    ),
    "wrong angle / the coupling of the two links / q1 + q2 / q2": (
        "Your coupling measures the angle of link 2 from the x axis. Which angle lies between the "
        "two links?"
    ),
    "sine for cosine / the coupling of the two links": (
        "Your coupling vanishes when the arm is stretched out. At which q2 is link 2 farthest "
        "from the shoulder, and what must the coupling be there?"
    ),
    "wrong sign / the coupling of the two links": (
        "Your coupling has the wrong sign: your arm resists most when it is folded. Which way "
        "does link 2 point at q2 = 0?"
    ),
    "wave lost / the coupling of the two links / q2": (
        "Your M is that of the stretched arm in every configuration. What changes when the elbow "
        "bends?"
    ),
    "radians converted / the coupling of the two links": sentences.RADIANS_CONVERTED,
    "angle in degrees / the coupling of the two links": sentences.IN_DEGREES,
    "halved / the coupling of the two links / M11": (
        "The coupling in your M11 is half of what it should be. Square the speed of link 2's centre "
        "of mass: how often does the mixed product occur?"
    ),
    "dropped / the coupling of the two links": (
        "Your M does not change with q2. When the elbow bends, mass comes nearer to the shoulder: "
        "which term should show it?"
    ),
    "dropped / the coupling of the two links / M11": (
        "Your M11 does not change with q2. When the elbow bends, mass comes nearer to the "
        "shoulder: which term of M11 should show it?"
    ),
    "dropped / the coupling of the two links / M12": (
        "Your M12 does not change with q2. Which term of the energy holds q̇1 q̇2 together with "
        "the angle between the links?"
    ),
    "doubled / the coupling of the two links / M12": (
        "The coupling in your M12 is twice what it should be. M12 and M21 share the mixed term of "
        "q̇ᵀ M q̇: what does that leave for each?"
    ),
    "velocity left out / qd2 / qd1 / in the energy": ABSOLUTE,
    "upper triangle alone": (
        "Your M21 is zero. The M of a kinetic energy is symmetric: what must M21 be?"
    ),
    "diagonal alone": (
        "Your M12 and M21 are zero, as if the joints did not feel each other. Accelerate joint 2 "
        "alone: does joint 1 need a torque to stay where it is?"
    ),
    "inverse": sentences.INVERSE_OF_M,
    "half of the whole": HALF,
    "numbers of the example": (
        "You always use the numbers of the example arm, whatever arm is given. Where do your "
        "masses and lengths come from?"
    ),
    "astray / the coupling of the two links / M22 / M12": (
        "Your M22 changes with q2. Hold joint 1 still and turn joint 2: does it matter how far "
        "the elbow is bent?"
    ),
    "absolute angle / q2 / q1 / in the energy": ABSOLUTE,
    "lower triangle alone": (
        "Your M12 is zero. The M of a kinetic energy is symmetric: what must M12 be?"
    ),
    "sign below the diagonal": (
        "Your M21 is −M12. The M of a kinetic energy is symmetric: what must M21 be?"
    ),
    "mixed terms not shared": (
        "Your M12 and M21 each hold the whole mixed term of q̇ᵀ M q̇. Multiply it out: how "
        "often does q̇1 q̇2 occur?"
    ),
    "mixed terms in one triangle": (
        "The energy of your M is right, but the whole mixed term sits in M12. How must M12 and "
        "M21 share it for M to be symmetric?"
    ),
    "joints exchanged": ("You swapped M11 and M22. Which joint carries both links?"),
}
