"""p2-energy-skew: the Coriolis matrix, its freedom, and what energy says about it.

C is judged by what it does: C q̇, which the motion sees; q̇ᵀC q̇, which the energy sees; and C + Cᵀ, which
shows whether Ṁ − 2C is skew-symmetric. For two joints the first and the last leave only the
Christoffel form.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from autograder.judging.carried import ways
from autograder.judging.carried.follows import Follows
from autograder.judging.check import VISIBLE_CASES, Check, Criterion
from autograder.judging.criterion import TOLERANCE, Said, relative_errors
from autograder.judging.models import Beside
from autograder.judging.quantities import array, each
from autograder.judging.section import Section
from autograder.mutation.generated import Generated
from autograder.problems.material import following, planar_2r, sampling
from autograder.problems.p2_energy_skew import christoffel_mistakes, mistakes, other_mistakes
from autograder.protocol import Call, Expressions, Symbol

# Ṁ − 2C is clearly not skew where C + Cᵀ and Ṁ differ by this share of the largest entry of C.
CLEARLY = 0.01


def _calls(name):
    def calls(rng, count):
        return [
            Call(name, (sampling.angles(rng), sampling.velocities(rng), sampling.planar_2r(rng)))
            for _ in range(count)
        ]

    return calls


def _pose(call):
    q, _, arm = call.args
    return planar_2r.joints(q, arm)


@each
def _entries(call, value):
    """Ṁ11; Ṁ12 and Ṁ21; Ṁ22."""
    M_dot = array(value, 2, 2)
    return M_dot[0, 0], np.array([M_dot[0, 1], M_dot[1, 0]]), M_dot[1, 1]


def _matrix(value, n, right):
    """A C as it came, (n, n). The vector C q̇ and the row sums of C are mistakes with a name: they count
    as the diagonal of a matrix. right(): C and q̇, where they are needed.
    """
    if n == 1 and np.size(value) == 1:
        return np.reshape(value, (1, 1))
    if np.size(value) == n:
        C, qd = right()
        for vector in (C @ qd, C @ np.ones(n)):
            if np.allclose(np.ravel(value), vector, rtol=TOLERANCE, atol=TOLERANCE):
                return np.diag(np.ravel(value))
    return array(value, n, n)


def _of_arm(right, call, value):
    return _matrix(value, 2, lambda: (right.of(call), call.args[1]))


def steps(right: Beside) -> each:
    """C q̇; q̇ᵀC q̇; C + Cᵀ. right: the Christoffel C of the arm."""

    @each
    def parts(call, value):
        C, qd = _of_arm(right, call, value), call.args[1]
        return C @ qd, qd @ C @ qd, C + C.T

    return parts


def other(christoffel: Beside, calls, values, own=None):
    """C q̇, and how far Ṁ − 2C is from skew-symmetric, up to where that is clear.

    One clear case is enough: what fails somewhere is no property. Where C q̇ is not right, no distance
    counts, and it is put below zero. christoffel: the Christoffel C of the arm. own: the C of each call
    whose product with q̇ is the right one, where that is not the Christoffel C.
    """
    given = [_of_arm(christoffel, call, value) for call, value in zip(calls, values, strict=True)]
    right = [christoffel.of(call) for call in calls]
    velocities = [call.args[1] for call in calls]
    torques = [C @ qd for C, qd in zip(given, velocities, strict=True)]
    enough = np.array([CLEARLY * np.max(np.abs(C)) for C in right])
    # C + Cᵀ of the Christoffel C is Ṁ.
    apart = [np.max(np.abs(C + C.T - R - R.T)) for C, R in zip(given, right, strict=True)]
    expected = [C @ qd for C, qd in zip(own or right, velocities, strict=True)]
    if np.any(relative_errors(expected, torques) > TOLERANCE):
        counts = -enough
    elif np.any(apart >= enough):
        counts = enough
    else:
        counts = np.array(apart)
    return list(zip(torques, counts, strict=True))


def _beside_own(quantities, calls, numbers):
    """As `other`, with the student's own C for what C_other q̇ shall be."""
    return partial(quantities, own=[np.reshape(C, (2, 2)) for (C,) in numbers])


def _inertia_text(rng, coordinates):
    """A symmetric matrix of expressions in the coordinates, each of which changes at its own rate.

    As plain as can be, so that a student's `simplify` ends in time: with three joints an entry
    changes with one of them.
    """
    n = len(coordinates)
    rows = [[""] * n for _ in range(n)]
    for i in range(n):
        for j in range(i, n):
            base = rng.uniform(3.0, 5.0) if i == j else rng.uniform(0.2, 0.8)
            among = coordinates if n < 3 else [coordinates[(i + j) % n]]
            rates = zip(rng.uniform(0.3, 1.5, n), among, strict=False)
            rows[i][j] = f"{base:.2f} + " + " + ".join(f"{rate:.2f}*{q}" for rate, q in rates)
            rows[j][i] = rows[i][j]
    rows[0][0] += f" + {rng.uniform(1.0, 2.0):.2f}*cos({coordinates[-1]})"
    return tuple(map(tuple, rows))


def _symbolic_calls(rng, count):
    """One, two and three joints, each at one point; for the grader twice. Symbols are slow."""
    calls = []
    for n in (1, 2, 3) * (1 if count <= VISIBLE_CASES else 2):
        q, qd = [[f"{name}{k + 1}" for k in range(n)] for name in ("q", "qd")]
        values = [float(draw(rng)[0]) for draw in n * [sampling.angle] + n * [sampling.velocity]]
        calls.append(
            Call(
                "christoffel",
                (Expressions(_inertia_text(rng, q)), tuple(map(Symbol, q)), tuple(map(Symbol, qd))),
                at=(dict(zip(q + qd, values, strict=True)),),
            )
        )
    return calls


_christoffel = christoffel_mistakes.at_points(lambda numbers: numbers.C)


def _symbolic(christoffel: Beside, call, value):
    """C q̇, and C."""
    (point,), n = call.at, len(call.args[1])
    qd = np.array([point[symbol.name] for symbol in call.args[2]])
    C = _matrix(value[0], n, lambda: (christoffel.of(call)[0], qd))
    return C @ qd, C


def not_skew(products: str) -> tuple[Said, ...]:
    """That Ṁ − 2C is not skew-symmetric, and of a right C q̇, that it is not enough."""
    first = (
        "With your C the matrix Ṁ − 2C is not skew-symmetric, as it is with the Christoffel form."
    )
    asked = f"how does that form share {products} between the entries of a row?"
    return (
        Said(f"{first} A right C q̇ is not enough: {asked}", lambda answered: answered.met[0]),
        Said(f"{first} First look at your C q̇, then: {asked}"),
    )


READ = "p2-proof"  # by a person
CHECKS = (
    Check(
        id="p2-M_dot",
        signature="M_dot(q, qd, arm)",
        reference=planar_2r.M_dot,
        calls=_calls("M_dot"),
        quantities=_entries,
        criteria=(
            Criterion("entry Ṁ11", "kg·m²/s", 0.45),
            Criterion("entries Ṁ12 and Ṁ21", "kg·m²/s", 0.45, entries=("Ṁ12", "Ṁ21")),
            Criterion("entry Ṁ22", "kg·m²/s", 0.1),
        ),
        catalogue=Generated("planar-2r", "M_dot", mistakes.M_DOT_SAID),
        terms=mistakes.M_DOT_TERMS,
        hints=(
            "M changes with time only because the arm moves: M(q(t)). Which of its entries hold an "
            "angle, and which angle?",
            "The chain rule: d/dt of an entry is the sum over all joints of ∂entry/∂q_k times q̇_k. "
            "Write down which of these derivatives are zero.",
            "Call the number that stands with cos q2 in M12 the coupling. It enters M11, M12 and M21, "
            "not equally often. Differentiate it with respect to q2 and multiply by q̇2. To test: "
            "(M(q + ε q̇) − M(q − ε q̇)) / (2ε) for a small ε.",
        ),
        section=Section("04-coriolis-and-skew-symmetry", "04-energy", "2 · What the energy proves"),
        further=(
            "Ṁ is 0 while the arm turns like one rigid body, and also where its links are in "
            "line, at any velocity: only an elbow that bends changes the inertia."
        ),
        pose=_pose,
    ),
    Check(
        id="p2-C",
        signature="C(q, qd, arm)",
        reference=planar_2r.C,
        calls=_calls("C"),
        quantities=steps(Beside(planar_2r.C)),
        criteria=(
            Criterion("vector C q̇", "N·m", 0.5),
            Criterion(
                "power q̇ᵀC q̇ = ½ q̇ᵀṀ q̇, so that the energy is kept",
                "W",
                0.2,
                otherwise=(
                    "With your C the energy would change although nobody does work: q̇ᵀ(Ṁ − 2C)q̇ "
                    "is not zero."
                ),
                is_property=True,
            ),
            Criterion(
                "sum C + Cᵀ = Ṁ, so that Ṁ − 2C is skew-symmetric",
                "kg·m²/s",
                0.3,
                otherwise=not_skew("the product q̇1 q̇2"),
                is_property=True,
            ),
        ),
        catalogue=Generated("planar-2r", "C", mistakes.CORIOLIS_SAID),
        terms=mistakes.CORIOLIS_TERMS,
        hints=(
            "M changes with q2 only, so most of the derivatives ∂M_ij/∂q_k are zero. List those that "
            "are not: there are three, and two of them are equal.",
            "Give the name h to half of ∂M11/∂q2. Form h_ijk for all eight i, j, k: each is h, −h or 0.",
            "Entry (i, j) of C is h_ij1 q̇1 + h_ij2 q̇2. Test it: C + Cᵀ must be your Ṁ, entry by entry.",
        ),
        section=Section(
            "02-from-lagrangian-to-matrices", "02-hand", "3 · The 2R arm by hand: all eight h_ijk"
        ),
        follows=(
            Follows(
                ("p2-M_dot",),
                "This is what the Christoffel form gives with the derivatives of M in your own Ṁ, so "
                "this step is right. The mistake is in Ṁ: mend it, and C follows.",
                ways.CHRISTOFFEL_OF_RATES,
            ),
        ),
        further=(
            "C is linear in q̇, so C q̇ is quadratic: at twice the speed these torques are four "
            "times as large. So a controller for a slow arm can often leave them out."
        ),
        pose=_pose,
    ),
    Check(
        id="p2-C_other",
        signature="C_other(q, qd, arm)",
        reference=lambda q, qd, arm: (
            planar_2r.C(q, qd, arm) + np.array([[-qd[1], qd[0]], [0.0, 0.0]])
        ),
        calls=_calls("C_other"),
        quantities=partial(other, Beside(planar_2r.C)),
        criteria=(
            Criterion(
                "vector C_other q̇",
                "N·m",
                0.5,
                otherwise="Your C_other q̇ differs from C q̇. Whatever you add to C must vanish when it "
                "is multiplied by q̇.",
            ),
            Criterion(
                "distance of Ṁ − 2 C_other from skew-symmetric (counts with the right C_other q̇)",
                "kg·m²/s",
                0.5,
                # Where C_other q̇ is wrong, the distance is 0 by definition, and no second mistake.
                otherwise=(
                    Said(
                        "Your answer counts as not skew-symmetric only where C_other q̇ is right and "
                        "C_other + C_otherᵀ clearly differs from Ṁ.",
                        lambda answered: answered.met[0],
                    ),
                ),
                is_property=True,
                is_bound=True,
            ),
        ),
        mistakes=other_mistakes.OTHER,
        terms=mistakes.CORIOLIS_TERMS,
        hints=(
            "C q̇ holds the product q̇1 q̇2 in its first row. In which entries of the row can it stand?",
            "Add to C a matrix that sends q̇ to zero. One row of it is enough: which row (a, b) has "
            "a q̇1 + b q̇2 = 0 at every velocity?",
            "Move the term of C11 into C12 so that the first row times q̇ stays the same. Then look at "
            "C_other + C_otherᵀ beside Ṁ: is the first entry still the same?",
        ),
        section=Section("04-coriolis-and-skew-symmetry", "04-not-unique", "1 · C is not unique"),
        follows=(
            Follows(
                ("p2-C",),
                "Your C_other has the same product with q̇ as your own C, so this step is right. The "
                "mistake is in C: mend it, and C_other follows.",
                replace(following.SAME_PRODUCT, quantities=_beside_own),
            ),
        ),
        further=(
            "No measured motion can tell your C_other from C, as only the product with q̇ enters "
            "it. A controller that multiplies C by another velocity can."
        ),
        pose=_pose,
    ),
    Check(
        id="p2-christoffel",
        signature="christoffel(M, q, qd)",
        returns="C",
        reference=_christoffel,
        calls=_symbolic_calls,
        quantities=each(partial(_symbolic, Beside(_christoffel))),
        criteria=(
            Criterion("vector C q̇", "N·m", 0.4),
            Criterion(
                "entries of the Christoffel form",
                "kg·m²/s",
                0.6,
                otherwise=(
                    "Your matrix does not come from the Christoffel symbols. Write down h_121 and "
                    "h_211 for M = [[a(q2), b(q2)], [b(q2), c]] by hand, and compare."
                ),
                is_property=True,
            ),
        ),
        mistakes=christoffel_mistakes.CHRISTOFFEL,
        terms=christoffel_mistakes.CHRISTOFFEL_TERMS,
        hints=(
            "Three loops: i over rows, j over columns, and the sum over k. sp.diff(M[i, j], q[k]) "
            "is one derivative of the three.",
            "Try it by hand on one joint: M = [[a(q1)]] has C = ½ a′(q1) q̇1. Does yours?",
            "In h_ijk the first derivative keeps i, j together, the second i, k, the third j, k. The "
            "two that hold the row index i inside M have a plus. Multiply each h_ijk by q̇_k, and test "
            "on the arm's M: C + Cᵀ must be Ṁ.",
        ),
        section=Section("02-from-lagrangian-to-matrices", "02-any-n", "5 · Any number of joints"),
        further=(
            "Your function needs nothing but M and q. So it holds for sliding joints too, and for "
            "angles that are measured from elsewhere: the form of the equation stays the same."
        ),
    ),
)
