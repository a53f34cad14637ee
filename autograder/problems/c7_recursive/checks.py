"""c7-recursive: Newton and Euler in two sweeps, and what a library that has them can be asked.

The sweeps are those of a chain in space. The libraries are functions that a call hands in.
"""

from dataclasses import replace

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check, Criterion
from autograder.judging.criterion import Answered, Said
from autograder.judging.quantities import UnfitError, each, one_number, vector
from autograder.judging.section import Section
from autograder.judging.terms import Term
from autograder.problems.c7_recursive import libraries
from autograder.problems.c7_recursive.chains import random_chain
from autograder.problems.c7_recursive.counting import count
from autograder.problems.c7_recursive.counting_mistakes import COUNT
from autograder.problems.c7_recursive.library_mistakes import TERMS, terms
from autograder.problems.c7_recursive.mistakes import RNEA
from autograder.problems.c7_recursive.sign_mistakes import GRAVITY_SIGN, gravity_sign
from autograder.problems.c7_recursive.sweeps import RIGHT, Sweeps
from autograder.problems.material.systems import signed
from autograder.protocol import Call

NOTHING = np.empty(0)  # a quantity of a criterion that a call says nothing of
LESSON = "08-from-symbols-to-fast-code"


def _rnea_calls(rng, count):
    """In turn: at rest in gravity; from rest without it; at constant rates without it; all at once."""
    calls = []
    for place in range(max(count, 12)):
        kind, n = place % 4, 2 + place // 4 % 3
        chain = random_chain(rng, n, gravity=kind in (0, 3))
        q = rng.choice([-1.0, 1.0], n) * rng.uniform(0.4, 1.3, n)
        qd = signed(rng, 0.8, 2.0, n) if kind in (2, 3) else np.zeros(n)
        qdd = signed(rng, 1.0, 4.0, n) if kind in (1, 3) else np.zeros(n)
        calls.append(Call("rnea", (q, qd, qdd, chain)))
    return calls


@each
def _torques(call, value):
    q, qd, qdd, _ = call.args
    u = vector(value, len(q))
    kind = 3 if np.any(qd) and np.any(qdd) else 2 if np.any(qd) else 1 if np.any(qdd) else 0
    return tuple(u if kind == k else NOTHING for k in range(4))


# Without all that two velocities make, and without friction.
UNMOVED = Sweeps(twist=0.0, joint_centre=0.0, centre=0.0, gyro=0.0, friction=0.0)
RNEA_TERMS = (
    Term("gravity", replace(UNMOVED, own_turn=0.0)),
    Term("the part of the accelerations", replace(UNMOVED, gravity=0.0)),
    Term("C q̇", Sweeps(gravity=0.0, own_turn=0.0, friction=0.0)),
    Term("friction", lambda q, qd, qdd, chain: chain.viscous * qd),
)

MAKERS = (libraries.column, libraries.planar_2r, libraries.with_wheel)


def _terms_calls(rng, count):
    calls = []
    for place in range(count):
        make = MAKERS[place % len(MAKERS)]
        n = 3 if make is libraries.with_wheel else 2
        q = rng.choice([-1.0, 1.0], n) * rng.uniform(0.4, 1.2, n)
        calls.append(Call("terms", (make(rng), q, signed(rng, 0.8, 2.0, n)), parts=True))
    return calls


@each
def _four_terms(call, value):
    n = len(call.args[1])
    if not isinstance(value, list) or len(value) != 4:
        raise UnfitError("something else than four things; it must return M, C q̇, g and f")
    M, *vectors = value
    if np.shape(M) != (n, n):
        raise UnfitError(f"M with the shape {np.shape(M)}; for {n} joints it must be {(n, n)}")
    for name, v in zip(("C q̇", "g", "f"), vectors, strict=True):
        if np.shape(v) == (n, n):
            raise UnfitError(f"a matrix for {name}; it must be the vector, of shape ({n},)")
    return np.asarray(M), *(vector(v, n) for v in vectors)


# Gravity, and whose torque the library gives.
ASKED = ((1, False), (-1, False), (0, False), (-1, True), (0, True), (1, True))


def _sign_calls(rng, count):
    return [
        Call("gravity_sign", (libraries.column(rng, *asked),))
        for _ in range(max(1, count // VISIBLE_CASES))
        for asked in ASKED
    ]


def _signs(calls, values):
    numbers = one_number(calls, values)
    return [
        (NOTHING, number) if ASKED[place % len(ASKED)][1] else (number, NOTHING)
        for place, (number,) in enumerate(numbers)
    ]


def _is_no_sign(answered: Answered) -> bool:
    given = [float(part[()]) for case in answered.given for part in case if np.size(part)]
    return not {-1.0, 0.0, 1.0}.issuperset(given)


NO_SIGN = Said("Some of your numbers are neither 1 nor −1 nor 0.", _is_no_sign)


def _count_calls(rng, count):
    """Of short arms where the cases are visible, and of longer ones, which none of these tells, else."""
    lengths = rng.permutation(np.arange(2, 8))
    if count > VISIBLE_CASES:
        lengths = rng.choice(np.arange(11, 41), VISIBLE_CASES, replace=False)
    return [Call("count", (int(n),)) for n in lengths]


@each
def _two_counts(call, value):
    both = vector(value, 2)
    return both[:1], both[1:]


READ = "c7-discussion"  # by a person
CHECKS = (
    Check(
        id="c7-rnea",
        signature="rnea(q, qd, qdd, chain)",
        returns="u",
        reference=RIGHT,
        calls=_rnea_calls,
        quantities=_torques,
        criteria=(
            Criterion("torques at rest, in gravity", "N·m", 0.2),
            Criterion("torques of a start from rest, without gravity", "N·m", 0.25),
            Criterion("torques at constant joint rates, without gravity", "N·m", 0.25),
            Criterion("torques with all of these at once", "N·m", 0.3),
        ),
        mistakes=RNEA,
        terms=RNEA_TERMS,
        hints=(
            "Write the outward sweep first: ω, ω̇ and the acceleration of the joint. Test it with one "
            "link. Before you add two vectors, ask in whose axes each of them is given.",
            "A point at r on a turning link has two accelerations from the turning, one with ω̇ and one "
            "with ω twice. You need this for the centre of mass and again for the next joint. The axis "
            "of a joint turns with the link before, so ω̇ has a part that no q̈ makes.",
            "Inwards, joint k needs three moments: that of the link itself about its centre of mass, "
            "that of the link's force, and what the next link hands down, turned into the axes of link "
            "k. The motor gives the part along the axis, and friction on top.",
        ),
        section=Section(
            LESSON,
            "08-rnea-hand",
            "4 · No expressions at all: the recursive Newton–Euler algorithm",
        ),
        further=(
            "Two sweeps need neither a matrix M nor a matrix C, and work for any number of links. A "
            "controller runs them once for each sample."
        ),
    ),
    Check(
        id="c7-terms",
        signature="terms(library, q, qd)",
        reference=terms,
        calls=_terms_calls,
        quantities=_four_terms,
        criteria=(
            Criterion("M", "kg·m²", 0.3),
            Criterion("C q̇", "N·m", 0.3),
            Criterion("g", "N·m", 0.2),
            Criterion("f", "N·m", 0.2),
        ),
        mistakes=TERMS,
        hints=(
            "The library adds four terms. Which of them vanish when nothing moves? Start with the call "
            "that leaves only one.",
            "M q̈ is linear in q̈: with a single 1 among zeros in q̈ you see one column. Take away what "
            "the library returns without any acceleration.",
            "At q̈ = 0 and with gravity taken away, C q̇ and f are left. C q̇ has products of two "
            "velocities, f one velocity. So ask a second time with −q̇, and compare.",
        ),
        section=Section(LESSON, "08-numbers-intro", "The same in numbers"),
        further=(
            "For n joints, n + 3 calls are enough for all four terms. With velocities of your own "
            "choice, more calls give even the Christoffel matrix C."
        ),
    ),
    Check(
        id="c7-gravity_sign",
        signature="gravity_sign(library)",
        reference=gravity_sign,
        calls=_sign_calls,
        quantities=_signs,
        criteria=(
            Criterion(
                "sign where the library gives the motors' torque",
                "",
                0.5,
                otherwise=(
                    NO_SIGN,
                    Said(
                        "Your sign is wrong for a library that gives the motors' torque. Hold the arm "
                        "level: which torque must its motor give?"
                    ),
                ),
            ),
            Criterion(
                "sign where it gives the torque on the motors",
                "",
                0.5,
                otherwise=(
                    NO_SIGN,
                    Said(
                        "Your sign is wrong for a library that gives the torque on the motors. What "
                        "does its inertia look like?"
                    ),
                ),
            ),
        ),
        mistakes=GRAVITY_SIGN,
        hints=(
            "Hold the arm in a position in which you know which way its motor must push, and ask for "
            "its torque. Which joint should you look at?",
            "An arm needs a torque that points the way in which it accelerates, with any gravity. So "
            "inertia tells you whose torque the library gives.",
            "Two calls: the level arm at rest, and the level arm with an acceleration. Their difference "
            "is inertia alone. Compare the signs with np.sign, which is 0 for 0.",
        ),
        section=Section(LESSON, "08-trap-libraries", "Trap: libraries differ"),
        further=(
            "No manual was needed, and no manual could be wrong: two calls test a convention in "
            "any program."
        ),
    ),
    Check(
        id="c7-count",
        signature="count(n)",
        reference=count,
        calls=_count_calls,
        quantities=_two_counts,
        criteria=(
            Criterion("operations of the direct sum", "operations", 0.5),
            Criterion("operations of the two sweeps", "operations", 0.5),
        ),
        mistakes=COUNT,
        hints=(
            "Count by hand for one link and for two links, or let the computer count: the two functions "
            "only add, subtract and multiply what you give them.",
            "A class of your own can stand for a number. Python calls __add__ for x + y, and __radd__ "
            "where the number on the left is a float. Each of these methods adds 1 to a counter and "
            "returns something that goes on counting.",
            "Pass lists of n such numbers for c, s, w and a, and an arm whose g is one and whose l, lc, "
            "m and I are lists of them. Set the counter to 0 before each of the two calls.",
        ),
        section=Section(LESSON, "08-count-intro", "What it costs"),
        further=(
            "For long arms, doubling the number of links doubles the work of the two sweeps, and makes "
            "that of the direct sum nearly four times as large."
        ),
    ),
)
