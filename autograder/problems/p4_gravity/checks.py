"""p4-gravity: potential energy, its gradient, the same from Jacobians, and where it vanishes."""

from dataclasses import replace
from math import pi

import numpy as np

from autograder.judging.carried import ways
from autograder.judging.carried.follows import Follows
from autograder.judging.check import Check, Criterion
from autograder.judging.claims import Claim
from autograder.judging.criterion import Answered, Said
from autograder.judging.quantities import UnfitError, each, one_number, vector
from autograder.judging.section import Section
from autograder.judging.terms import Term
from autograder.mutation.generated import Generated
from autograder.problems.material import following, planar_2r, sampling
from autograder.problems.p4_gravity import mistakes
from autograder.protocol import Call

FOUR = np.array([(-pi / 2, 0), (-pi / 2, pi), (pi / 2, 0), (pi / 2, pi)])
# Torques of so many configurations are kept, the largest first.
MOST_TORQUES = 8
# Within this, rad or as a share of the torque, a configuration is a rounded equilibrium.
NEAR = 0.02


def _energy_calls(rng, count):
    """Each arm at q, with the elbow at 0 instead, and with joint 1 at 0 and link 2 as it was."""
    calls = []
    for _ in range(count):
        arm = sampling.planar_2r(rng)
        q = sampling.angles(rng)
        while abs(np.sin(q[0] + q[1]) - np.sin(q[0])) < 0.3:
            q = sampling.angles(rng)
        for at in (q, np.array([q[0], 0.0]), np.array([0.0, q[0] + q[1]])):
            calls.append(Call("potential_energy", (at, arm)))
    return calls


def _energy_changes(calls, values):
    """The change of P with each link's direction: a constant, even one of each arm's own, is free."""
    P = [energy for (energy,) in one_number(calls, values)]
    changes = []
    for at_q, straight, level in zip(P[::3], P[1::3], P[2::3], strict=True):
        changes += 3 * [(at_q - straight, at_q - level)]
    return changes


def _torque_calls(rng, count):
    return [Call("g_vec", (sampling.angles(rng), sampling.planar_2r(rng))) for _ in range(count)]


@each
def _torques(call, value):
    if np.size(value) == 1:
        raise UnfitError("one number, as P is; it must return one entry for each joint")
    return tuple(vector(value, 2))


def _jacobian_calls(rng, count):
    calls: list[Call] = []
    for _ in range(count):
        L, n = rng.integers(2, 5), rng.integers(2, 6)
        # Were all of them three, a Jacobian that is not transposed would fit.
        n = 2 if not calls else n
        towards = rng.choice([-1.0, 1.0], 3) * rng.uniform(0.4, 1.0, 3)
        g0 = rng.uniform(3.0, 15.0) * towards / np.linalg.norm(towards)
        masses = rng.uniform(0.5, 4.0, L)
        calls.append(Call("gravity_from_jacobians", (rng.normal(size=(L, 3, n)), masses, g0)))
    return calls


@each
def _generalised_torque(call, value):
    return (vector(value, call.args[0].shape[2]),)


def _from_jacobians(jacobians_v, masses, g0):
    return -sum(m * Jv.T @ g0 for m, Jv in zip(masses, jacobians_v, strict=True))


def _component(axis):
    return lambda jacobians_v, masses, g0: _from_jacobians(
        jacobians_v, masses, g0 * (np.arange(3) == axis)
    )


def _equilibria_calls(rng, count):
    """Fewer arms than elsewhere: a numeric root finder is slow, and the answer is four points."""
    return [Call("equilibria", (sampling.planar_2r(rng),)) for _ in range(max(2, count // 3))]


@each
def torques_and_distances(call, value):
    """At the configurations given, in any order: the torques that are left, each as a share of its
    joint's largest, sorted; and the turn in rad, of both links together, from each of the four to the
    nearest one given."""
    given = configurations(value)
    (arm,) = call.args
    largest = planar_2r.g_vec(np.zeros(2), arm)
    left = np.abs(planar_2r.g_vec(given.T, arm).T) / largest
    torques = np.zeros((MOST_TORQUES, 2))
    kept = -np.sort(-left, axis=0)[:MOST_TORQUES]
    torques[: len(kept)] = kept
    turns = _directions(FOUR)[:, None] - _directions(given)
    turns = np.abs(np.remainder(turns + pi, 2 * pi) - pi)
    # Where nothing is left, rounding must not be what errors are measured by.
    return (np.round(torques, 12), np.round(np.min(np.sum(turns, axis=-1), axis=1), 12))


def configurations(value):
    """The configurations given, (k, 2), rad; one may come as (2,), and each as a row or a column."""
    shape = tuple(length for length in np.shape(value)[1:] if length != 1)
    if np.size(value) and (np.shape(value) == (2,) or shape == (2,)):
        return np.reshape(value, (-1, 2))
    raise UnfitError(
        f"an array of shape {np.shape(value)}; it must return one row (q1, q2) for each configuration"
    )


def _directions(q):
    """Both links' directions in space, rad."""
    return np.stack([q[..., 0], q[..., 0] + q[..., 1]], axis=-1)


def _furthest(answered: Answered, k: int) -> float:
    """The largest torque, as a share, of criterion 0; the largest turn to an equilibrium, rad, of 1."""
    return max(float(np.max(case[k])) for case in answered.given)


ROUNDED = Said(
    "Your configurations are the four equilibria, but not exactly. Where do you round an angle?",
    lambda answered: max(_furthest(answered, 0), _furthest(answered, 1)) <= NEAR,
)


def _pose(call):
    q, arm = call.args
    return planar_2r.joints(q, arm)


POTENTIAL = Generated("planar-2r", "potential_energy", mistakes.POTENTIAL_SAID, mistakes.EXAMPLE)
GRAVITY = Generated("planar-2r", "g_vec", mistakes.GRAVITY_SAID, mistakes.EXAMPLE)

# What is said of all configurations is not said where there is another one, that is no equilibrium.
OF_ALL = (
    "stretched only", "stable only", "one value of the inverse cosine", "link 1 up only",
    "link 1 down only", "in degrees",
)  # fmt: skip

READ = "p4-check"  # by a person
CHECKS = (
    Check(
        id="p4-potential_energy",
        signature="potential_energy(q, arm)",
        reference=planar_2r.potential_energy,
        calls=_energy_calls,
        quantities=_energy_changes,
        criteria=(
            Criterion("change of P as the elbow turns from 0 to q2", "J", 0.5),
            Criterion(
                "change of P as link 1 turns from level and link 2 keeps its direction", "J", 0.5
            ),
        ),
        catalogue=POTENTIAL,
        terms=POTENTIAL.terms,
        hints=(
            "P of a link is its weight times the height of its centre of mass. Draw the arm at "
            "q1 = 30°, q2 = 40° and mark both heights above the shoulder.",
            "Link 2 begins at the elbow. Its centre of mass is as high as the elbow, and then "
            "some more. How high is the elbow, and what angle does link 2 make with the x axis?",
            "q2 is measured from link 1, so the angle of link 2 with the x axis is a sum. A length "
            "at an angle from the x axis rises by its sine. Now add weight times height, link by link.",
        ),
        section=Section("05-gravity", "05-potential", "1 · From the work of a weight to g(q)"),
        further=(
            "Your P is a sum, with one part for the direction of each link. The kinetic energy is "
            "not: there, one part depends on the directions of both."
        ),
        pose=_pose,
    ),
    Check(
        id="p4-g_vec",
        signature="g_vec(q, arm)",
        returns="g",
        reference=planar_2r.g_vec,
        calls=_torque_calls,
        quantities=_torques,
        criteria=(
            Criterion("gravity torque g1 of joint 1", "N·m", 0.5),
            Criterion("gravity torque g2 of joint 2", "N·m", 0.5),
        ),
        mistakes=mistakes.GRAVITY,
        catalogue=GRAVITY,
        terms=GRAVITY.terms,
        hints=(
            "g has one entry for each joint: the partial derivatives of your P, by q1 and by q2, "
            "each with the other angle held still.",
            "Underline q1 in your P. It stands in more than one term. In which of them does q2 stand?",
            "The chain rule gives the same factor for both joints where the angle is q1 + q2, so "
            "you find one term in g1 and again in g2. Check with the arm level: g1 is every "
            "weight times its distance from the shoulder.",
        ),
        section=Section("05-gravity", "05-2r-hand", "By hand: the 2R arm"),
        follows=(
            Follows(
                ("p4-potential_energy",),
                "This is the gradient of your own P, so this step is right. The mistake is in P: mend "
                "it, and g follows.",
                ways.GRADIENT,
            ),
        ),
        further=(
            "If motors give these torques at every q, the arm stays wherever you leave it. This "
            "is gravity compensation; with it, people guide heavy arms by hand."
        ),
        pose=_pose,
    ),
    Check(
        id="p4-gravity_from_jacobians",
        signature="gravity_from_jacobians(jacobians_v, masses, g0)",
        returns="g",
        reference=_from_jacobians,
        calls=_jacobian_calls,
        quantities=_generalised_torque,
        criteria=(Criterion("gravity torque from the Jacobians", "N·m"),),
        mistakes=mistakes.FROM_JACOBIANS,
        terms=(
            Term("the pull along x", _component(0)),
            Term("the pull along y", _component(1)),
            Term("the pull along z", _component(2)),
        ),
        hints=(
            "Take one point mass first. It moves by a small dp. How much work does gravity do, and "
            "what does P lose by that?",
            "A small turn dq moves the centre of mass by Jv dq. Put that into the work, and collect "
            "what stands before dq.",
            "What stands before dq is a row and g is its column, so you must transpose Jv. Then "
            "add up all links, each with its own mass, and look at the sign: P falls along g0.",
        ),
        section=Section("05-gravity", "05-potential", "1 · From the work of a weight to g(q)"),
        further=(
            "A joint that turns about the direction of gravity needs no torque to hold: it moves "
            "every centre of mass at right angles to the pull."
        ),
    ),
    Check(
        id="p4-equilibria",
        signature="equilibria(arm)",
        reference=lambda arm: FOUR,
        calls=_equilibria_calls,
        quantities=torques_and_distances,
        criteria=(
            Criterion(
                "gravity torque at each configuration you give, as a share of the largest",
                "",
                0.5,
                otherwise=(
                    ROUNDED,
                    Said(
                        "At least one of your configurations still needs a torque against gravity. "
                        "Put each of them into your g_vec."
                    ),
                ),
            ),
            Criterion(
                "turn from each of the four equilibria to the nearest of yours",
                "rad",
                0.5,
                of_lacking=True,
                otherwise=(
                    ROUNDED,
                    Said(
                        "At least one equilibrium is missing. Each of the two torques gives a "
                        "condition: how many angles within one turn meet it?",
                        lambda answered: _furthest(answered, 1) > NEAR,
                    ),
                    Said(
                        "At least one of your equilibria is not exact. Where do you round an angle?"
                    ),
                ),
            ),
        ),
        mistakes=tuple(
            replace(mistake, claim=Claim.WHOLE) if mistake.name in OF_ALL else mistake
            for mistake in mistakes.EQUILIBRIA
        ),
        hints=(
            "Begin with joint 2: when is its torque zero? Say it first in words, with the direction "
            "of link 2.",
            "With link 2 pointing so, its term is gone from g1 as well. What must link 1 do?",
            "Each link points straight up or straight down: two choices each. For each of the four "
            "pairs of directions write q1, and then q2, the angle from link 1 to link 2.",
        ),
        section=Section("05-gravity", "05-equilibria", "3 · Where the arm rests by itself"),
        follows=(
            Follows(
                ("p4-g_vec",),
                "These are four configurations in which your own g vanishes, so this step is right. The "
                "mistake is in g: mend it, and the equilibria follow.",
                following.EQUILIBRIA,
            ),
        ),
        further=(
            "A third link on the hand would make eight of them, and an arm with n links has 2ⁿ: "
            "their number doubles with each link."
        ),
    ),
)
