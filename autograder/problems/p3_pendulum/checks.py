"""p3-pendulum: a manipulator with one degree of freedom, from its Lagrangian to its matrices.

The references are one line each, and stand here rather than come from `armdyn`, so that the two can
be held against each other in a test.
"""

from math import cos, sin, sqrt

import numpy as np

from autograder.judging.carried.follows import Follows
from autograder.judging.check import Check, Criterion
from autograder.judging.quantities import UnfitError, each
from autograder.judging.section import Section
from autograder.judging.terms import Term
from autograder.mutation.generated import Generated
from autograder.problems.material import following, sampling
from autograder.problems.p3_pendulum import mistakes
from autograder.protocol import Call, Symbol

LAGRANGIAN_ARGUMENTS = ("q", "qd", "m", "lc", "I", "g")


def _position_calls(name):
    def calls(rng, count):
        return [Call(name, (sampling.angle(rng), sampling.pendulum(rng))) for _ in range(count)]

    return calls


def _coriolis_calls(rng, count):
    return [
        Call("C", (sampling.angle(rng), sampling.velocity(rng), sampling.pendulum(rng)))
        for _ in range(count)
    ]


def _lagrangian_calls(rng, count):
    """Each pendulum at rest hanging, at rest elsewhere, and moving there: three points a call."""
    symbols = tuple(Symbol(name) for name in LAGRANGIAN_ARGUMENTS)
    calls = []
    for _ in range(count):
        pend = vars(sampling.pendulum(rng))
        q, qd = float(sampling.angle(rng)[0]), float(sampling.velocity(rng)[0])
        states = ((0.0, 0.0), (q, 0.0), (q, qd))
        points = tuple({"q": at, "qd": rate, **pend} for at, rate in states)
        calls.append(Call("lagrangian", symbols, points))
    return calls


@each
def _lagrangian_parts(call, value):
    """The change of L with q̇, and with q: a constant in P, which no equation of motion sees, is free."""
    if value.shape != (3,):
        raise UnfitError(f"an expression of shape {value.shape[1:]}; it must return one expression")
    hanging, at_rest, moving = value
    return (np.array(moving - at_rest), np.array(at_rest - hanging))


def _inertia_calls(rng, count):
    return [
        Call("inertia_about_pivot", tuple(rng.uniform((0.05, 0.5, 0.2), (0.5, 3.0, 0.9)).tolist()))
        for _ in range(count)
    ]


def _frequency_calls(rng, count):
    return [Call("small_angle_frequency", (sampling.pendulum(rng),)) for _ in range(count)]


GRAVITY = Generated("pendulum", "g_vec", mistakes.GRAVITY_SAID)

TRAP_INERTIA = Section(
    "01-canonical-form", "01-trap-inertia", 'Trap: the pendulum\'s inertia "about its centre"'
)

READ = "p3-derivation"  # by a person
CHECKS = (
    Check(
        id="p3-lagrangian",
        signature="lagrangian(q, qd, m, lc, I, g)",
        reference=lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 - m * g * lc * (1 - cos(q)),
        calls=_lagrangian_calls,
        quantities=_lagrangian_parts,
        criteria=(
            Criterion("kinetic part of L", "J", 0.5),
            Criterion("potential part of L", "J", 0.5),
        ),
        catalogue=Generated("pendulum", "lagrangian", mistakes.LAGRANGIAN_SAID),
        terms=(
            Term(
                "the kinetic energy of the body",
                lambda q, qd, m, lc, I, g: 0.5 * I * qd**2,
            ),
            Term(
                "the potential energy of the raised mass",
                lambda q, qd, m, lc, I, g: -m * g * lc * (1 - cos(q)),
            ),
        ),
        hints=(
            "L is made of two energies. For the first: how fast does the body turn? For the "
            "second: how high has its centre of mass risen?",
            "The body turns about a fixed point. If the inertia is taken about that point, one term "
            "holds the whole kinetic energy. For the height, draw the pendulum at q and mark how far "
            "below the pivot the centre of mass is.",
            "One is half an inertia times the square of a velocity. The other is a weight times a "
            "height that is 0 at q = 0, ℓc at q = π/2 and twice ℓc at q = π: which function of q "
            "does that? L is the first minus the second.",
        ),
        section=Section("01-canonical-form", "01-pendulum-hand", "2 · The pendulum, by hand"),
        further=(
            "A constant that is added to P changes L, but not the motion: only derivatives of L "
            "enter the equation. So you may choose where P is 0."
        ),
    ),
    Check(
        id="p3-M",
        signature="M(q, pend)",
        reference=lambda q, pend: pend.I,
        calls=_position_calls("M"),
        criteria=(Criterion("inertia about the pivot", "kg·m²"),),
        catalogue=Generated("pendulum", "M", mistakes.INERTIA_SAID),
        terms=(
            Term("the inertia about the pivot", lambda q, pend: pend.I),
            Term("the inertia of a point mass", lambda q, pend: pend.m * pend.lc**2),
        ),
        hints=(
            "The cell below your Lagrangian prints the equation of motion. What stands before qdd?",
            "Compare with the figure's table: about which point is the given inertia taken, and about "
            "which does the body turn?",
            "It is the same point, so you add nothing to the given inertia, and q does not enter. "
            "Write it as a matrix with one row and one column.",
        ),
        section=Section("01-canonical-form", "01-terms", "4 · What each term is, and what it does"),
        follows=(
            Follows(
                ("p3-lagrangian",),
                "Your M is what stands before q̈ with your own L, so this step is right. The mistake is "
                "in L: mend it, and M follows.",
                following.INERTIA_OF_L,
            ),
        ),
        further=(
            "The farther a body's mass lies from the axis, the more slowly the same torque sets "
            "it turning. A tightrope walker's long pole uses just that."
        ),
    ),
    Check(
        id="p3-C",
        signature="C(q, qd, pend)",
        reference=lambda q, qd, pend: 0.0,
        calls=_coriolis_calls,
        criteria=(
            Criterion(
                "Coriolis matrix of one joint",
                "kg·m²/s",
                otherwise="Your C is not zero. Every entry of C is made of derivatives of M with "
                "respect to q: how does this M change with q?",
            ),
        ),
        mistakes=mistakes.CORIOLIS,
        catalogue=Generated("pendulum", "C", mistakes.CORIOLIS_SAID),
        hints=(
            "Look at the printed equation of motion: does any term hold qd?",
            "C comes from the change of M with q. How does this M change when the pendulum turns?",
            "A constant M has no derivative. Return the matrix of one row and one column that says so.",
        ),
        section=Section("01-canonical-form", "01-terms", "4 · What each term is, and what it does"),
        follows=(
            Follows(
                ("p3-M",),
                "Your C is the one that your own M asks for, so this step is right. The mistake is in "
                "M: mend it, and C follows.",
                following.CORIOLIS_OF_M,
            ),
        ),
        further=(
            "A single joint can have velocity terms: in a crank that drives a slider, M changes "
            "with q, and there C is ½ M′(q) q̇."
        ),
    ),
    Check(
        id="p3-g_vec",
        signature="g_vec(q, pend)",
        reference=lambda q, pend: pend.m * pend.g * pend.lc * sin(q[0]),
        calls=_position_calls("g_vec"),
        criteria=(Criterion("gravity torque", "N·m"),),
        catalogue=GRAVITY,
        terms=GRAVITY.terms,
        hints=(
            "What is left of the printed equation of motion when nothing moves?",
            "It is the derivative of P by q. Where does it vanish, and where is it largest: hanging, "
            "or level?",
            "A torque is a force on a lever arm. The force is the weight, and the arm is the "
            "horizontal distance of the centre of mass from the pivot. To hold the body at a "
            "small positive q, the motor must push in the positive direction: that is the sign of "
            "g on the left side.",
        ),
        section=Section("01-canonical-form", "01-terms", "4 · What each term is, and what it does"),
        follows=(
            Follows(
                ("p3-lagrangian",),
                "Your g is the derivative of the P in your own L, so this step is right. The mistake is "
                "in L: mend it, and g follows.",
                following.GRAVITY_OF_L,
            ),
        ),
        further=(
            "At q = π the torque is 0 again: the pendulum can stand on its head, but the smallest "
            "push brings it down."
        ),
    ),
    Check(
        id="p3-inertia_about_pivot",
        signature="inertia_about_pivot(I_com, m, lc)",
        reference=lambda I_com, m, lc: I_com + m * lc**2,
        calls=_inertia_calls,
        criteria=(Criterion("inertia moved to the pivot", "kg·m²"),),
        mistakes=mistakes.INERTIA_ABOUT_PIVOT,
        terms=(
            Term("the inertia about the centre of mass", lambda I_com, m, lc: I_com),
            Term("the inertia of a point mass", lambda I_com, m, lc: m * lc**2),
        ),
        hints=(
            "The parallel-axis theorem moves an inertia between two parallel axes, one of which "
            "goes through the centre of mass.",
            "You add the inertia that a point mass at the centre of mass would have.",
            "Of all parallel axes the one through the centre of mass has the smallest inertia, so "
            "you must add the inertia of that point mass. Check the unit: kg·m².",
        ),
        section=TRAP_INERTIA,
        further=(
            "Of all parallel axes, the one through the centre of mass has the least inertia: "
            "wherever you put the pivot, the inertia about it is at least as large."
        ),
    ),
    Check(
        id="p3-small_angle_frequency",
        signature="small_angle_frequency(pend)",
        reference=lambda pend: sqrt(pend.m * pend.g * pend.lc / pend.I),
        calls=_frequency_calls,
        criteria=(Criterion("angular frequency of small swings", "rad/s"),),
        mistakes=mistakes.SMALL_ANGLE_FREQUENCY,
        hints=(
            "Write down the equation of motion with u = 0, and replace sin q by q.",
            "Divide by what stands before q̈. An oscillator has q̈ and the angle itself, with one "
            "constant factor: what is that factor called?",
            "The factor before q is the square of the angular frequency. It holds the weight, its "
            "lever arm and the inertia about the pivot. A root gives rad/s; you do not need 2π.",
        ),
        section=TRAP_INERTIA,
        follows=(
            Follows(
                ("p3-M", "p3-g_vec"),
                "Your frequency is that of a pendulum with your own M and g, so this step is right. The "
                "mistake is in one of these: mend it, and the frequency follows.",
                following.FREQUENCY,
            ),
        ),
        further=(
            "This holds for small swings. If the same pendulum swings by 90° to each side, one "
            "swing takes 18 % longer."
        ),
    ),
)
