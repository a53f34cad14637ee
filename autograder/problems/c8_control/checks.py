"""c8-control: PD with gravity compensation, and the adaptive controller of Slotine and Li.

A controller is judged by its numbers in states that are drawn here, and in closed loop. There the judge
simulates the arm and asks the student's function for a torque at each step, so that no plant and no
payload ever is where a student's code runs. Slotine & Li 1987, On the Adaptive Control of Robot
Manipulators; Takegaki & Arimoto 1981, A New Feedback Method for Dynamic Control of Manipulators.
"""

from functools import partial
from types import SimpleNamespace

import numpy as np

from autograder.judging.carried.follows import Follows
from autograder.judging.check import Check, Criterion
from autograder.judging.criterion import Answered, Said
from autograder.judging.loops import Loop
from autograder.judging.models import Beside
from autograder.judging.quantities import UnfitError, each, one_number, vector
from autograder.judging.section import Section
from autograder.problems.c8_control import law, loops, mistakes, rate_mistakes, regressor_mistakes
from autograder.problems.material import following, planar_2r, sampling
from autograder.protocol import Call

NOTHING = np.empty(0)  # a quantity of a criterion that a call says nothing of
# A run to a goal has arrived if it ends no further from it than this, rad, and no faster, rad/s.
NEAR, SLOW = 0.05, 0.1
# A tracking run is good if it leaves no more than so many times what the law itself leaves, and if V
# rises by no more than this share of its start: the torque is held over each step, so it may a little.
MORE_ERROR, LEAST_RISE = 1.5, 0.05


def _hold_calls(rng, count):
    """In turn at the goal, at rest elsewhere, in motion; in between, each sixth call a closed loop."""
    calls: list[Call] = []
    for k in range(count):
        if k % 6 == 1:
            calls.append((loops.to_upright if k % 12 == 1 else loops.to_goal)(rng))
            continue
        kind = (0, 0, 1, 1, 2, 2)[k % 6]
        arm, q = loops.gained(rng, sampling.planar_2r(rng)), sampling.angles(rng)
        q_star = q if kind == 0 else q + rng.choice([-1.0, 1.0], 2) * rng.uniform(0.3, 1.2, 2)
        qd = sampling.velocities(rng) if kind == 2 else np.zeros(2)
        calls.append(Call("gravity_compensation", (q, qd, q_star, arm)))
    return calls


@each
def _held(call, value):
    judged = [NOTHING] * 4
    if isinstance(call, Loop):
        judged[3] = np.where(value <= [NEAR, SLOW, 0.0], 0.0, value)
        return tuple(judged)
    q, qd, q_star, _ = call.args
    judged[2 if np.any(qd) else 1 if np.any(q != q_star) else 0] = vector(value, 2)
    return tuple(judged)


# A criterion of the figures of closed loops.
_in_loop = partial(Criterion, is_property=True, is_bound=True, of_lacking=True, in_loop=True)


def _lost(k: int):
    """Whether the arm is lost in one of the closed loops of criterion k, whose last figure says so."""

    def holds(answered: Answered) -> bool:
        return any(case[k][-1] == 1 for case in answered.given if np.size(case[k]))

    return holds


def _regressor_calls(rng, count):
    # At least twelve, so that the parts of a column cannot explain just any error.
    return [Call("regressor_r", _telling_state(rng)) for _ in range(max(count, 12))]


def _telling_state(rng):
    """A state and an arm for which no entry of Y_r but those that are 0 is what large terms leave."""
    while True:
        arm, q = sampling.planar_2r(rng), sampling.angles(rng)
        qd, qd_r = sampling.velocities(rng), sampling.velocities(rng)
        qdd_r = rng.choice([-1.0, 1.0], 2) * rng.uniform(1.0, 6.0, 2)
        Y = np.abs(planar_2r.regressor(q, qd, qdd_r, arm, qd_r))
        if abs(sum(qdd_r)) > 0.8 and min(Y[0, 3], Y[0, 4], Y[1, 4]) > 0.5:
            return q, qd, qd_r, qdd_r, loops.known(arm)


@each
def _columns(call, value):
    if value.shape != (2, 6):
        raise UnfitError(
            f"an array of shape {value.shape}; it must return one row for each joint and one "
            "column for each of the six parameters, (2, 6)"
        )
    at_joint_1, at_joint_2 = value[:, 4]
    return (
        value[:, [0, 3]],
        value[:, 1],
        value[:, [2, 5]],
        np.array(at_joint_1),
        np.array(at_joint_2),
    )


def _gains(rng, arm) -> SimpleNamespace:
    """Λ, K_D and Γ that are full matrices, so that a product entry by entry shows."""
    spread = rng.uniform(0.5, 1.5, 6)
    return SimpleNamespace(
        Lam=rng.uniform(2.0, 4.0) * loops.mixed(rng, 2, 0.4),
        KD=rng.uniform(1.0, 3.0) * loops.mixed(rng, 2, 0.4) * np.max(planar_2r.M(np.zeros(2), arm)),
        Gamma=0.3 * spread[:, np.newaxis] * loops.mixed(rng, 6, 0.12) * spread,
    )


def _law_calls(rng, count):
    """Each twelfth call a closed loop; the others states that are off from the wanted motion."""
    calls: list[Call] = []
    for k in range(count):
        if k % 12 == 1:
            calls.append(loops.tracking(rng))
            continue
        arm, q, qd = sampling.planar_2r(rng), sampling.angles(rng), sampling.velocities(rng)
        ref = SimpleNamespace(
            q=q - rng.choice([-1.0, 1.0], 2) * rng.uniform(0.2, 0.6, 2),
            qd=sampling.velocities(rng),
            qdd=rng.choice([-1.0, 1.0], 2) * rng.uniform(1.0, 6.0, 2),
        )
        pi_hat = planar_2r.parameters(arm) * rng.uniform(0.7, 1.4, 6)
        calls.append(Call("slotine_li", (q, qd, ref, pi_hat, _gains(rng, arm), loops.known(arm))))
    return calls


@each
def _of_law(call, value):
    if isinstance(call, Loop):
        error, rise, lost = value
        right, *_ = call.right
        return (
            *4 * (NOTHING,),
            np.array([right if error <= MORE_ERROR * right else error, lost]),
            np.array(0.0 if rise <= LEAST_RISE else rise),
        )
    both = vector(value, 8)
    u, masses, moments, inertias = both[:2], both[2::3], both[3::3], both[4::3]
    return u, masses, moments, inertias, NOTHING, NOTHING


def _rate_calls(rng, count):
    """In turn with the Christoffel C and with another valid one; at least six of each."""
    calls: list[Call] = []
    while len(calls) < max(count, 12):
        arm, q, qd = sampling.planar_2r(rng), sampling.angles(rng), sampling.velocities(rng)
        s = rng.choice([-1.0, 1.0], 2) * rng.uniform(0.3, 1.5, 2)
        a, b = rng.choice([-1.0, 1.0], 2) * rng.uniform(0.7, 1.5, 2) * (len(calls) % 2)
        C_used = rate_mistakes.valid_C(q, qd, arm, a, b)
        gains = SimpleNamespace(KD=0.3 * _gains(rng, arm).KD)
        args = (q, qd, s, C_used, gains, arm)
        damping, rest = s @ gains.KD @ s, abs(rate_mistakes.rate_of_V(*args, damping=0.0))
        # Neither of the two is small beside the other, where it is not zero.
        if len(calls) % 2 == 0 or 0.2 * damping < rest < 5 * damping:
            calls.append(Call("V_dot", args))
    return calls


def _rates(christoffel: Beside, call, value):
    (number,) = one_number.parts(call, value)
    is_christoffel = np.allclose(call.args[3], christoffel.of(call))
    return (number, NOTHING) if is_christoffel else (NOTHING, number)


def _christoffel(q, qd, s, C_used, gains, arm):
    return planar_2r.C(q, qd, arm)


READ = "c8-discussion"  # by a person
CHECKS = (
    Check(
        id="c8-gravity_compensation",
        signature="gravity_compensation(q, qd, q_star, arm)",
        returns="u",
        reference=mistakes.to_goal,
        calls=_hold_calls,
        quantities=_held,
        criteria=(
            Criterion("torque at q*, at rest", "N·m", 0.2),
            Criterion("torque at rest away from q*", "N·m", 0.3),
            Criterion("torque in motion", "N·m", 0.25),
            _in_loop(
                "end of the closed loop that begins here: distance from q*, speed",
                "",
                0.25,
                otherwise=(
                    Said(
                        "In closed loop your controller loses the arm: a joint races, or a torque is "
                        "no finite number.",
                        _lost(3),
                    ),
                    Said(
                        "In closed loop the arm has not come to rest at q* after 4 s, as it does with "
                        "the torque of part A."
                    ),
                ),
                units=("rad", "rad/s", ""),
                entries=(
                    "distance from q* at the end of the closed loop that begins here",
                    "speed at the end of the closed loop that begins here",
                    "1 for an arm that is lost in the closed loop that begins here",
                ),
            ),
        ),
        mistakes=mistakes.HOLD,
        terms=mistakes.HOLD_TERMS,
        hints=(
            "Put the arm at the goal, at rest. Spring and damper are silent there. Which torque must be "
            "left, so that the arm stays?",
            "The spring pulls from q towards the goal, the damper against the velocity. Both act on "
            "each joint by itself, with that joint's own gain.",
            "The torque is a sum of three terms, and the set-up cell has a function for one of them. "
            "Take it where the arm is now, and let the other two vanish at the goal, at rest.",
        ),
        section=Section("05-gravity", "05-compensation", "4 · Gravity compensation"),
        further=(
            "The proof needs no number of the arm but those in g, and any positive gains. So the same "
            "controller brings a light arm and a heavy one to their goals."
        ),
        pose=lambda call: planar_2r.joints(call.args[0], call.args[3]),
    ),
    Check(
        id="c8-regressor_r",
        signature="regressor_r(q, qd, qd_r, qdd_r, arm)",
        returns="Y_r",
        reference=regressor_mistakes.regressor_r,
        calls=_regressor_calls,
        quantities=_columns,
        criteria=(
            Criterion("columns of the masses m1 and m2", "m²/s²", 0.1),
            Criterion("column of m1 ℓc1", "m/s²", 0.1),
            Criterion("columns of the inertias J1 and J2", "rad/s²", 0.1),
            Criterion("column of m2 ℓc2, joint 1", "m/s²", 0.4),
            Criterion("column of m2 ℓc2, joint 2", "m/s²", 0.3),
        ),
        mistakes=regressor_mistakes.REGRESSOR,
        terms=regressor_mistakes.REGRESSOR_TERMS,
        hints=(
            "Start from your regressor of c6. M and g do not know q̇r; q̈r simply takes the place of q̈. "
            "Which column alone has products of velocities?",
            "Write C q̇ of the arm as a matrix times a vector, and do not multiply out yet. The matrix "
            "keeps q̇. Which C must it be, so that the proof of part D works?",
            "Multiply the Christoffel C by q̇r, row by row: row 1 has two products of q̇ and q̇r more "
            "than you may think, row 2 has one. What stands beside m2 ℓc2 is the column.",
        ),
        section=Section(
            "06-linearity-in-parameters",
            "06-regressor-hand",
            "2 · From the energies to the regressor",
        ),
        further=(
            "The Christoffel C is symmetric in its two velocities: exchange q̇ and q̇r in your Y_r, "
            "and it stays the same."
        ),
        pose=lambda call: planar_2r.joints(call.args[0], call.args[4]),
    ),
    Check(
        id="c8-slotine_li",
        signature="slotine_li(q, qd, ref, pi_hat, gains, arm)",
        returns="u_and_rate",
        reference=law.adaptive,
        calls=_law_calls,
        quantities=_of_law,
        criteria=(
            Criterion("torque u", "N·m", 0.35),
            Criterion("rates of the estimates of m1 and m2", "kg/s", 0.1),
            Criterion("rates of the estimates of m1 ℓc1 and m2 ℓc2", "kg·m/s", 0.1),
            Criterion("rates of the estimates of J1 and J2", "kg·m²/s", 0.1),
            _in_loop(
                "closed loop that begins here: largest error of the last second",
                "",
                0.2,
                units=("rad", ""),
                entries=(
                    "largest error of the last second of the closed loop that begins here",
                    "1 for an arm that is lost in the closed loop that begins here",
                ),
                otherwise=(
                    Said(
                        "In closed loop, with a payload that nobody told your controller of, the arm is "
                        "lost: a joint races, or a number that came back is not finite.",
                        _lost(4),
                    ),
                    Said(
                        "In closed loop, with a payload that nobody told your controller of, the arm "
                        "stays further from the wanted motion than the law of part C leaves it."
                    ),
                ),
            ),
            _in_loop(
                "closed loop that begins here: largest rise of V, as a share of its start",
                "",
                0.15,
                otherwise=(
                    "In closed loop V rises, and by more than a held torque explains. In the proof it "
                    "never does."
                ),
            ),
        ),
        mistakes=law.LAW,
        terms=law.LAW_TERMS,
        hints=(
            "Write the five lines of the text one below the other: the two errors, the reference "
            "velocity and acceleration, s, Y_r, and then the two results.",
            "Λ, K_D and Γ are matrices: @ multiplies them with a vector. The rate has as many entries "
            "as π, s only two: Y_r must be turned so that it leads from the joints to the parameters.",
            "Test the signs with an arm that is ahead of the wanted motion: q̇r must then be slower than "
            "the wanted velocity, s positive, and the torque of K_D must pull back.",
        ),
        section=Section(
            "04-coriolis-and-skew-symmetry",
            "04-tracking",
            "7 · Where skew-symmetry is needed: z ≠ q̇",
        ),
        follows=(
            Follows(
                ("c8-regressor_r",),
                "This is the law with your own Y_r, so this step is right. The mistake is in Y_r: mend "
                "it, and the law follows.",
                following.LAW_OF_Y,
            ),
        ),
        further=(
            "The estimates need not become right. They become good enough for this motion, and another "
            "motion may show what is still wrong in them."
        ),
        pose=lambda call: planar_2r.joints(call.args[0], call.args[5]),
    ),
    Check(
        id="c8-V_dot",
        signature="V_dot(q, qd, s, C_used, gains, arm)",
        reference=rate_mistakes.rate_of_V,
        calls=_rate_calls,
        quantities=each(partial(_rates, Beside(_christoffel))),
        criteria=(
            Criterion("V̇ with the Christoffel C", "W", 0.4),
            Criterion("V̇ with a valid C that is not skew", "W", 0.6),
        ),
        mistakes=rate_mistakes.RATE,
        terms=rate_mistakes.V_TERMS,
        hints=(
            "V has two parts. Take the derivative of each: the first is a product of three factors, of "
            "which all depend on time.",
            "Put in what M ṡ equals in the closed loop, and the rate of the estimates. Which two terms "
            "cancel, and which three are left?",
            "What is left has s on both sides: once around K_D, once around Ṁ, once around C. You need "
            "Ṁ in numbers: what do C and its transpose add up to?",
        ),
        section=Section(
            "04-coriolis-and-skew-symmetry",
            "04-tracking",
            "7 · Where skew-symmetry is needed: z ≠ q̇",
        ),
        further=(
            "If s points along q̇, the valid C may be any: then the power balance of the arm itself says "
            "that the extra term is zero."
        ),
        pose=lambda call: planar_2r.joints(call.args[0], call.args[5]),
    ),
)
