"""c6-regressor: the regressor, the rank that a motion gives it, and the estimate of its parameters.

π has six entries, for each link (m, m ℓc, J), J about the link's own joint. ℓ1 and g are known.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from autograder.judging.carried.follows import Follows
from autograder.judging.check import VISIBLE_CASES, Check, Criterion
from autograder.judging.claims import Claim
from autograder.judging.criterion import Answered, Said
from autograder.judging.quantities import UnfitError, each, one_number, vector
from autograder.judging.section import Section
from autograder.judging.terms import Term
from autograder.mutation.generated import Generated
from autograder.problems.c6_regressor import fit_mistakes, mistakes, rank_mistakes, regressors
from autograder.problems.material import following, planar_2r, sampling
from autograder.protocol import Call

NOTHING = np.empty(0)  # a quantity of a criterion that a call says nothing of
KNOWN = ("l1", "l2", "g")


def _accelerations(rng):
    """q̈, (2,), rad/s²: neither entry, nor their sum, near zero."""
    while True:
        qdd = rng.choice([-1.0, 1.0], 2) * rng.uniform(1.0, 6.0, 2)
        if abs(sum(qdd)) > 0.8:
            return qdd


def _regressor_calls(rng, count):
    # At least twelve, so that the parts of a column cannot explain just any error.
    return [Call("regressor", _telling_state(rng)) for _ in range(max(count, 12))]


def _telling_state(rng):
    """A state and an arm for which no entry of Y but those that are 0 is what large terms leave."""
    while True:
        arm, q = sampling.planar_2r(rng), sampling.angles(rng)
        qd, qdd = sampling.velocities(rng), _accelerations(rng)
        Y = np.abs(planar_2r.regressor(q, qd, qdd, arm))
        if min(Y[0, 3], Y[0, 4], Y[1, 4]) > 0.5:
            return q, qd, qdd, arm


@each
def _columns(call, value):
    if value.shape == (6, 2):
        raise UnfitError("an array of shape (6, 2); it must return one row for each joint, (2, 6)")
    if value.shape != (2, 6):
        raise UnfitError(
            f"an array of shape {value.shape}; it must return one row for each joint and one "
            "column for each of the six parameters, (2, 6)"
        )
    masses, inertias = (
        value[:, [regressors.M1, regressors.M2]],
        value[:, [regressors.J1, regressors.J2]],
    )
    at_joint_1, at_joint_2 = value[:, regressors.MC2]
    return masses, value[:, regressors.MC1], inertias, np.array(at_joint_1), np.array(at_joint_2)


# The entries of π as the mechanism writes them out, and by their names in the notebook.
NAMED = {"I1 + m1·ℓc1²": "J1", "I2 + m2·ℓc2²": "J2", "m1·ℓc1": "m1 ℓc1", "m2·ℓc2": "m2 ℓc2"}


class SixColumns(Generated):
    """The mistakes of the regressor that follows from the arm, which has no column of m1: it is 0."""

    def _said(self, mistake):
        sentence = super()._said(mistake).sentence
        for entry, name in NAMED.items():
            sentence = sentence.replace(entry, name)
        return replace(mistake, sentence=sentence)

    def __call__(self, calls):
        return [
            (m, np.insert(values, regressors.M1, 0.0, -1)) for m, values in super().__call__(calls)
        ]


def _part(gravity=0.0, velocity=0.0, acceleration=0.0):
    """The part of Y that is left when the others are multiplied by 0."""
    return lambda q, qd, qdd, arm: planar_2r.regressor(
        q, velocity * qd, acceleration * qdd, planar_2r.changed(arm, g=gravity * arm.g)
    )


def known(arm) -> SimpleNamespace:
    """What is known of an arm before its torques are measured."""
    return SimpleNamespace(**{name: getattr(arm, name) for name in KNOWN})


def _motion(rng, samples):
    """q, q̇, q̈ of a motion that takes both joints everywhere, (samples, 2) each."""
    shape = (samples, 2)
    qd = rng.choice([-1.0, 1.0], shape) * rng.uniform(0.5, 3.0, shape)
    qdd = rng.choice([-1.0, 1.0], shape) * rng.uniform(1.0, 6.0, shape)
    return rng.uniform(-np.pi, np.pi, shape), qd, qdd


def _measured_arm(rng):
    """An arm whose base parameters are of one size: link 2 is not much lighter than link 1."""
    while True:
        arm = sampling.planar_2r(rng)
        beta = planar_2r.base_parameters(arm)
        if min(beta) > 0.2 * max(beta):
            return arm


def _identify_calls(rng, count):
    """In turn without noise and with it."""
    calls = []
    for place in range(count):
        arm = _measured_arm(rng)
        while True:
            q, qd, qdd = motion = _motion(rng, int(rng.integers(9, 16)))
            Y = planar_2r.regressor(q, qd, qdd, arm)
            W = regressors.stacked(Y)[:, planar_2r.BASE_COLUMNS]
            # Well shown as a whole, and by joint 1 alone, so that nothing is judged on luck.
            if max(np.linalg.cond(W), np.linalg.cond(W[::2])) < 40:
                break
        u = Y @ planar_2r.parameters(arm)
        if place % 2:
            u = u + rng.normal(0.0, rng.uniform(0.3, 0.8), u.shape)
        calls.append(Call("identify", (*motion, u, known(arm))))
    return calls


def _estimates(calls, values):
    """First moments and inertias, without noise and with it."""
    found = []
    for place, value in enumerate(values):
        if np.size(value) == 6:
            raise UnfitError(
                "6 numbers; it must return the four base parameters, since no motion shows all six of π"
            )
        beta = vector(value, 4)
        parts = (beta[[0, 2]], beta[[1, 3]])
        found.append((NOTHING, NOTHING, *parts) if place % 2 else (*parts, NOTHING, NOTHING))
    return found


def _resting(*moving):
    """The motion with joints held where they are at first: 1 for a joint that moves, 0 for one held."""
    turn = np.array(moving, dtype=float)
    return lambda q, qd, qdd, arm: (q * turn + q[0] * (1 - turn), qd * turn, qdd * turn, arm)


def _samples(*chosen):
    return lambda q, qd, qdd, arm: (*(x[[*chosen]] for x in (q, qd, qdd)), arm)


# What is made of a rich motion, and of which criterion it speaks. Each criterion has motions of
# different ranks, so that no number that is always the same meets one.
MOTIONS = (
    (0, lambda q, qd, qdd, arm: (q, qd, qdd, arm)),
    (0, lambda q, qd, qdd, arm: (q, qd, qdd, planar_2r.changed(arm, g=0.0))),
    (1, lambda q, qd, qdd, arm: (q, 0 * qd, 0 * qdd, arm)),
    (1, _resting(0, 1)),
    (1, _resting(1, 0)),
    (2, _samples(0)),
    (2, _samples(0, 1)),
    (2, _samples(0, 0, 0, 0, 0, 0)),
)
SAMPLES = 6  # so few that a witness prints them
# Singular values are above this share of the largest, or zero but for rounding.
LEAST_SHOWN = 1e-3
ROUNDING = 1e-12


def _rank_calls(rng, count):
    return [
        Call("rank_of_excitation", _of_plain_rank(rng, made_of))
        for _ in range(max(1, count // VISIBLE_CASES))
        for _, made_of in MOTIONS
    ]


def _of_plain_rank(rng, made_of):
    while True:
        motion = made_of(*_motion(rng, SAMPLES), known(sampling.planar_2r(rng)))
        values = np.linalg.svd(regressors.stacked(planar_2r.regressor(*motion)))[1]
        shares = values / values[0]
        if not np.any((shares > ROUNDING) & (shares < LEAST_SHOWN)):
            return motion


def _ranks(calls, values):
    found = []
    for place, (count,) in enumerate(one_number(calls, values)):
        speaks_of, _ = MOTIONS[place % len(MOTIONS)]
        found.append(tuple(count if k == speaks_of else NOTHING for k in range(3)))
    return found


def _counts(answered: Answered) -> list[float]:
    return [float(part[()]) for case in answered.given for part in case if np.size(part)]


ALWAYS = Said(
    "Your number is the same for every motion. How much less than a rich motion does an arm at rest "
    "show?",
    lambda answered: len(set(_counts(answered))) == 1,
)
NOT_LEAST_SQUARES = (
    "With noise, your estimate is not the one of least squares: you can still make the sum of the "
    "squares of all 2K residuals smaller."
)

READ = "c6-discussion"  # by a person
CHECKS = (
    Check(
        id="c6-regressor",
        signature="regressor(q, qd, qdd, arm)",
        returns="Y",
        reference=planar_2r.regressor,
        calls=_regressor_calls,
        quantities=_columns,
        criteria=(
            Criterion("columns of the masses m1 and m2", "m²/s²", 0.2),
            Criterion("column of m1 ℓc1", "m/s²", 0.15),
            Criterion("columns of the inertias J1 and J2", "rad/s²", 0.2),
            Criterion("column of m2 ℓc2, joint 1", "m/s²", 0.25),
            Criterion("column of m2 ℓc2, joint 2", "m/s²", 0.2),
        ),
        mistakes=mistakes.REGRESSOR,
        catalogue=SixColumns("planar-2r", "regressor", mistakes.REGRESSOR_SAID, mistakes.EXAMPLE),
        terms=(
            Term("its gravity part", _part(gravity=1.0)),
            Term("its velocity part", _part(velocity=1.0)),
            Term("its acceleration part", _part(acceleration=1.0)),
        ),
        hints=(
            "Take M q̈ + C q̇ + g, multiply every product out, and first replace m ℓc² + I by J. "
            "Which products of parameters are left for each link?",
            "Underline in both lines all that has m2 ℓc2. ℓ1 and g are known: what stands beside "
            "m2 ℓc2 is its column. m2 alone is left with ℓ1² and with ℓ1 g.",
            "To test a column, set its parameter to 1 and the others to 0, and look at both "
            "torques. For m2: all of link 2 sits at the elbow. For J2: link 2 has inertia and no "
            "weight. For m1: all of link 1 sits at the shoulder, so nothing needs a torque.",
        ),
        section=Section(
            "06-linearity-in-parameters",
            "06-regressor-hand",
            "2 · From the energies to the regressor",
        ),
        further=(
            "No mass and no inertia stands in Y. So two arms with the same lengths have the same "
            "Y in the same motion, and only π tells them apart."
        ),
        pose=lambda call: planar_2r.joints(call.args[0], call.args[3]),
    ),
    Check(
        id="c6-rank_of_excitation",
        signature="rank_of_excitation(q, qd, qdd, arm)",
        reference=rank_mistakes.rank,
        calls=_rank_calls,
        quantities=_ranks,
        criteria=(
            Criterion(
                "rank of a rich motion, with gravity and in orbit",
                "",
                0.35,
                otherwise=(
                    ALWAYS,
                    Said(
                        "Your rank of a rich motion is wrong. Print the singular values of W, divided "
                        "by the largest: there is a wide gap. Which of them do you count?"
                    ),
                ),
            ),
            Criterion(
                "rank of a motion with one joint or both at rest",
                "",
                0.35,
                otherwise=(
                    ALWAYS,
                    Said(
                        "Your rank is wrong when a joint rests. Print W for such a motion: which "
                        "columns vanish, and which are multiples of each other?"
                    ),
                ),
            ),
            Criterion(
                "rank of one sample, of two, and of one that is repeated",
                "",
                0.3,
                otherwise=(
                    ALWAYS,
                    Said(
                        "Your rank is wrong when there are few samples, or when one of them is "
                        "repeated. How many different rows does W have then?"
                    ),
                ),
            ),
        ),
        # Counts are so few that those of one criterion may be a mistake's by chance.
        mistakes=tuple(replace(mistake, claim=Claim.WHOLE) for mistake in rank_mistakes.RANK),
        hints=(
            "Each sample gives a Y with two rows. Put the rows of all samples under each other: the "
            "matrix W has 2K rows and 6 columns. How many of its columns are independent?",
            "The rank is the number of singular values that are not zero. On a computer zero is "
            "something like 1e-16 of the largest. Which limit separates the two groups?",
            "np.vstack joins a list of matrices into one, and np.linalg.matrix_rank counts singular "
            "values with a sensible limit. It is also worth printing np.linalg.svd(W)[1] once.",
        ),
        section=Section(
            "06-linearity-in-parameters", "06-ranks", "4 · How many parameters can a motion show?"
        ),
        follows=(
            Follows(
                ("c6-regressor",),
                "This is the rank of your own regressor, so this step is right. The mistake is in Y: "
                "mend it, and the rank follows.",
                following.RANK_OF_Y,
            ),
        ),
        further=(
            "With measured, noisy angles no singular value of W is exactly zero. Then the gap "
            "between the large and the small ones tells you the rank."
        ),
    ),
    Check(
        id="c6-identify",
        signature="identify(q, qd, qdd, u, arm)",
        returns="beta",
        reference=fit_mistakes.fit,
        calls=_identify_calls,
        quantities=_estimates,
        criteria=(
            Criterion("first moments β1 and β3 from exact torques", "kg·m", 0.3),
            Criterion("inertias β2 and β4 from exact torques", "kg·m²", 0.3),
            Criterion(
                "first moments β1 and β3 from noisy torques",
                "kg·m",
                0.2,
                otherwise=NOT_LEAST_SQUARES,
            ),
            Criterion(
                "inertias β2 and β4 from noisy torques",
                "kg·m²",
                0.2,
                otherwise=NOT_LEAST_SQUARES,
            ),
        ),
        mistakes=fit_mistakes.IDENTIFY,
        hints=(
            "Stack the samples as in part B, and the torques in the same order: W π = u. The six "
            "columns depend on each other. Which four do you keep, and what do these four unknowns "
            "then stand for?",
            "Drop the columns of m1 and m2. The column of m2 is a sum of two others with known "
            "factors: so m2 does not disappear, it moves into the unknowns of those two.",
            "Keep columns 1, 2, 4 and 5 of W (counted from 0), make one vector of u with u.ravel(), "
            "and give both to np.linalg.lstsq. Its first result is β, in the order asked for.",
        ),
        section=Section(
            "06-linearity-in-parameters",
            "06-least-squares",
            "5 · Identification: from torques to parameters",
        ),
        follows=(
            Follows(
                ("c6-regressor",),
                "This is the least-squares estimate with your own regressor, so this step is right. The "
                "mistake is in Y: mend it, and the estimate follows.",
                following.FIT_OF_Y,
            ),
        ),
        further=(
            "These four numbers predict the torques of every motion of the arm. What they leave "
            "unknown never shows in a torque."
        ),
    ),
)
