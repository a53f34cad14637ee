"""p1-inertia: the inertia matrix, from links and in closed form; when it is positive definite."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check, Criterion
from autograder.judging.criterion import Answered, Said
from autograder.judging.quantities import UnfitError, array, each, one_number
from autograder.judging.section import Section
from autograder.judging.terms import Term
from autograder.mutation.generated import Generated
from autograder.problems.material import planar_2r, sampling
from autograder.problems.material.definiteness import (
    MATRICES,
    ROUNDING,
    Kind,
    is_symmetric,
    least_eigenvalue,
)
from autograder.problems.p1_inertia import definiteness_mistakes, links_mistakes, mistakes
from autograder.protocol import Call

NOTHING = np.empty(0)  # a quantity of a criterion that a call says nothing of

# Links and joints: one link and many, and as many joints as a spatial inertia has rows.
SHAPES = ((1, 3), (2, 2), (3, 4), (2, 6), (1, 6), (4, 1))


def _links_calls(rng, count):
    shapes = [*SHAPES, *zip(rng.integers(2, 6, count), rng.integers(1, 7, count), strict=True)]
    return [
        Call(
            "inertia_from_links",
            (rng.uniform(-1, 1, (L, 6, n)), _spatial_inertias(rng, L)),
        )
        for L, n in shapes[:count]
    ]


def _spatial_inertias(rng, links):
    """Bodies' 6 × 6 inertias about points beside their centres of mass, rows and columns (ω, v)."""
    mass = rng.uniform(0.5, 3.0, (links, 1, 1))
    com = rng.choice([-1, 1], (links, 3)) * rng.uniform(0.3, 0.9, (links, 3))
    turn = np.linalg.qr(rng.normal(size=(links, 3, 3)))[0]
    size = rng.uniform(0.1, 0.5, (links, 1, 3))
    spread = turn * size @ turn.mT  # ∫ r rᵀ dm: any positive one is some body's
    # Row by row, a unit vector's cross product with r is that of r × with the sign turned.
    cross = -np.cross(np.eye(3), com[:, np.newaxis])
    trace = np.trace(spread, axis1=1, axis2=2)[:, np.newaxis, np.newaxis]
    about_point = trace * np.eye(3) - spread - mass * cross @ cross
    inertia = np.block([[about_point, mass * cross], [-mass * cross, mass * np.eye(3)]])
    return (inertia + inertia.mT) / 2


@each
def _one_link_and_more(call, value):
    jacobians, _ = call.args
    links, _, n = jacobians.shape
    M = np.reshape(value, (1, 1)) if n == 1 and np.size(value) == 1 else array(value, n, n)
    return (M, NOTHING) if links == 1 else (NOTHING, M)


def _block_term(name, rows, columns):
    """The part of Σ JᵀIJ that comes from one block of the spatial inertias and its transpose."""
    mask = np.zeros((6, 6))
    mask[rows, columns] = mask[columns, rows] = 1
    return Term(
        name,
        lambda jacobians, inertias: sum(
            J.T @ (mask * I) @ J for J, I in zip(jacobians, inertias, strict=True)
        ),
    )


def _M_calls(rng, count):
    # At least twelve, so that the six terms of M11 cannot explain just any error.
    return [
        Call("M", (sampling.angles(rng), sampling.planar_2r(rng))) for _ in range(max(count, 12))
    ]


@each
def _entries(call, value):
    M = array(value, 2, 2)
    return (M[0, 0], np.array([M[0, 1], M[1, 0]]), M[1, 1])


# Of which criteria a matrix speaks. Each criterion sees some to accept and some to refuse, so that no
# answer that is always the same meets one.
SPEAKS_OF = {
    Kind.DEFINITE: (0, 1, 2, 3),
    Kind.INDEFINITE: (0,),
    Kind.NEGATIVE_DIAGONAL: (0, 3),
    Kind.SEMIDEFINITE: (1,),
    Kind.SKEWED: (2,),
    Kind.ROUNDED: (3,),
}


def _matrix_calls(rng, count):
    return [
        # A power of two changes no digit.
        Call("is_spd", (2.0 ** rng.integers(-3, 4) * matrix(rng),), truth=True)
        for _ in range(max(1, count // VISIBLE_CASES))
        for _, matrix in MATRICES
    ]


def _verdicts(calls, values):
    """For each criterion the answer of each call that speaks of it, as 1 or 0."""
    found = []
    for place, (answer,) in enumerate(one_number(calls, values)):
        if answer not in (0, 1):
            raise UnfitError(f"{answer:.4g}; it must return True or False")
        kind, _ = MATRICES[place % len(MATRICES)]
        found.append(tuple(answer if k in SPEAKS_OF[kind] else NOTHING for k in range(4)))
    return found


def _said_of(answer: bool, *kinds: Kind) -> Callable[[Answered], bool]:
    """Whether this is said of any matrix of these kinds."""

    def holds(answered: Answered) -> bool:
        said = [next(float(part[()]) for part in case if np.size(part)) for case in answered.given]
        return any(
            MATRICES[place % len(MATRICES)][0] in kinds and own == answer
            for place, own in enumerate(said)
        )

    return holds


REFUSED = Said(
    "You refuse a matrix that is symmetric and positive definite. What do you ask of it that need "
    "not be so?",
    _said_of(False, Kind.DEFINITE),
)
NEGATIVE = Said(
    "You accept a symmetric matrix that has a negative eigenvalue. For which velocity is its energy "
    "negative?",
    _said_of(True, Kind.INDEFINITE, Kind.NEGATIVE_DIAGONAL),
)
SEMIDEFINITE = Said(
    "You accept a matrix whose smallest eigenvalue is zero, exactly or but for rounding. Is the energy "
    "of every velocity positive?",
    _said_of(True, Kind.SEMIDEFINITE),
)
SKEWED = Said(
    "You accept a matrix that is not symmetric. Which entries must be equal, and where do you compare "
    "them?",
    _said_of(True, Kind.SKEWED),
)
LAST_DIGIT = Said(
    next(m.sentence for m in definiteness_mistakes.IS_SPD if m.name == "exact symmetry"),
    lambda answered: (
        _said_of(False, Kind.ROUNDED)(answered)
        and not _said_of(True, Kind.ROUNDED)(answered)
        and not REFUSED.holds(answered)
    ),
)
ROUNDED = Said(
    "You refuse a matrix that is positive definite, and symmetric but for the last digit. What do you "
    "ask of it that need not be so?",
    _said_of(False, Kind.ROUNDED),
)

PARAMETERS = ("l1", "l2", "lc1", "lc2", "m1", "m2", "I1", "I2")


@each
def _singular_and_allowed(call, value):
    return singular(*arm_and_q(value))


def singular(arm, q):
    """Whether M(q) of an arm is singular, and whether its parameters are allowed as well."""
    is_singular = _why_singular(arm, q)
    named = vars(arm)
    allowed = (
        arm.m1 != 0 and arm.m2 != 0,
        arm.l1 != 0 and arm.l2 != 0,
        all(number >= 0 for number in named.values()),
    )
    return (is_singular, np.array([*is_singular, *allowed], dtype=float))


def arm_and_q(value):
    """The arm as a namespace of its eight numbers, and q; UnfitError for what is neither."""
    if not isinstance(value, list) or len(value) != 2 or not isinstance(value[0], dict):
        raise UnfitError("something other than a pair; it must return (arm, q), with arm a dict")
    arm, q = value
    missing = [name for name in PARAMETERS if name not in arm]
    if missing:
        raise UnfitError(f"an arm without {', '.join(missing)}")
    if isinstance(q, dict | list) or np.shape(q) not in ((2,), (2, 1), (1, 2)):
        raise UnfitError("a q that is not two angles")
    for name in PARAMETERS:
        if isinstance(arm[name], dict | list) or np.size(arm[name]) != 1:
            raise UnfitError(f"an arm whose {name} is not one number")
    return SimpleNamespace(**{n: float(np.ravel(arm[n])[0]) for n in PARAMETERS}), np.ravel(q)


def _why_singular(arm, q):
    """Whether M(q) is singular, and three times 1; where it is not, a 0 for each reason, in turn, and
    four for an arm that has a negative parameter, whose M need not be positive definite.

    det M = a b − k², with a the inertia of link 1 and of m2 at the elbow, b that of link 2 about the
    elbow. Relative to a b it does not depend on units, and is 1 − k²/(a b).
    """
    first, b = arm.I1 + arm.m1 * arm.lc1**2, arm.I2 + arm.m2 * arm.lc2**2
    ab = (first + arm.m2 * arm.l1**2) * b
    k2 = (arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])) ** 2
    if abs(ab - k2) <= ROUNDING * max(abs(ab), k2):
        return np.ones(4)
    if min(vars(arm).values()) < 0:
        return np.zeros(4)
    if arm.I2 != 0:
        return np.array([0.0, 0.0, 1.0, 1.0])
    return np.array([0.0, 1.0, first == 0, abs(np.sin(q[1])) < 1e-6])


NOT_SINGULAR = (
    Said(
        "Your M is not singular, and at least one of your parameters is negative, which none may be. "
        "Which of them may be zero?",
        lambda answered: not np.any(answered.given[0][0]),
    ),
)
NOT_ALLOWED = Said(
    "Your M is singular, but with parameters that are not allowed. None may be negative; which of them "
    "must not be zero either?",
    lambda answered: answered.met[0],
)

INERTIA = Generated("planar-2r", "M", mistakes.INERTIA_SAID, mistakes.EXAMPLE)

READ = "p1-proof"  # by a person
CHECKS = (
    Check(
        id="p1-inertia_from_links",
        signature="inertia_from_links(jacobians, inertias)",
        returns="M",
        reference=lambda jacobians, inertias: np.einsum(
            "lai,lab,lbj->ij", jacobians, inertias, jacobians
        ),
        calls=_links_calls,
        quantities=_one_link_and_more,
        criteria=(
            Criterion("matrix of one link", "kg·m²", 0.5),
            Criterion("matrix of several links", "kg·m²", 0.5),
        ),
        mistakes=links_mistakes.INERTIA_FROM_LINKS,
        terms=(
            _block_term("the rotation of the links", slice(0, 3), slice(0, 3)),
            _block_term("the translation of the links", slice(3, 6), slice(3, 6)),
            _block_term("the coupling of rotation and translation in I", slice(0, 3), slice(3, 6)),
        ),
        hints=(
            "Write down the kinetic energy of one link, with its velocity vₖ = Jₖ q̇ put in. What "
            "stands between the two q̇?",
            "Check the shapes: Jₖ is (6, n) and Iₖ is (6, 6). In which order do they multiply to "
            "(n, n)?",
            "Start with an n × n matrix of zeros, n from jacobians.shape[2]. Loop over the links "
            "with zip(jacobians, inertias), add each link's matrix, and return after the loop.",
        ),
        section=Section("03-inertia-matrix", "03-arm", "2 · From the bodies to the arm"),
        further=(
            "Your function knows nothing of the plane or of two links: with the Jacobians of a "
            "robot with six joints in space, the same lines give its inertia matrix."
        ),
    ),
    Check(
        id="p1-M",
        signature="M(q, arm)",
        reference=planar_2r.M,
        calls=_M_calls,
        quantities=_entries,
        criteria=(
            Criterion("M11", "kg·m²", 0.5),
            Criterion("M12 and M21", "kg·m²", 0.25, entries=("M12", "M21")),
            Criterion("M22", "kg·m²", 0.25),
        ),
        mistakes=mistakes.INERTIA,
        catalogue=INERTIA,
        terms=INERTIA.terms,
        hints=(
            "Start from the energy, not from the matrix. Each link has two parts: its centre of "
            "mass moves, and it turns. What is the angular velocity of link 2?",
            "Write down the position of the centre of mass of link 2, differentiate it, and "
            "square the velocity. Only one cosine is left: that of the angle between the links.",
            "Sort K by q̇1², q̇1 q̇2 and q̇2². In q̇ᵀ M q̇ the first has M11, the last M22, and the "
            "mixed one M12 + M21. Remember the ½, and that M12 = M21.",
        ),
        section=Section("03-inertia-matrix", "03-2r-hand", "By hand: the 2R arm"),
        further=(
            "Your M depends on the angle between the two links alone. Turn the whole arm like one "
            "rigid body, and no entry changes; only gravity would notice."
        ),
        pose=lambda call: planar_2r.joints(*call.args),
    ),
    Check(
        id="p1-is_spd",
        signature="is_spd(A)",
        reference=lambda A: is_symmetric(A) and least_eigenvalue(A) > ROUNDING,
        calls=_matrix_calls,
        quantities=_verdicts,
        criteria=(
            Criterion(
                "positive definite told from indefinite",
                share=0.3,
                otherwise=(NEGATIVE, REFUSED),
                is_truth=True,
            ),
            Criterion(
                "semidefinite refused",
                share=0.2,
                otherwise=(SEMIDEFINITE, REFUSED),
                is_truth=True,
            ),
            Criterion(
                "non-symmetric refused", share=0.3, otherwise=(SKEWED, REFUSED), is_truth=True
            ),
            Criterion(
                "symmetric up to rounding accepted",
                share=0.2,
                otherwise=(LAST_DIGIT, REFUSED, ROUNDED, NEGATIVE),
                is_truth=True,
            ),
        ),
        mistakes=definiteness_mistakes.IS_SPD,
        hints=(
            "There are two questions in the name: is the matrix symmetric, and is it positive "
            "definite? Ask them one after the other.",
            "For symmetry look at the largest entry of |A − Aᵀ|. For the rest, which function of "
            "np.linalg gives the eigenvalues of a symmetric matrix?",
            "Compare both with 1e-9 times the largest number of their kind: the asymmetry with the "
            "largest entry, and the smallest eigenvalue with the largest one.",
        ),
        section=Section("03-inertia-matrix", "03-computer", "4 · Testing it on a computer"),
        further=(
            "np.linalg.cholesky alone would not have been enough: it reads one triangle of the "
            "matrix, so that it also accepts matrices that are not symmetric."
        ),
    ),
    Check(
        id="p1-singular_arm",
        signature="singular_arm()",
        reference=lambda: (
            planar_2r.changed(mistakes.EXAMPLE, I2=0.0, lc2=0.0),
            (0.3, 1.0),
        ),
        calls=lambda rng, count: [Call("singular_arm", (), parts=True)],
        quantities=_singular_and_allowed,
        criteria=(
            Criterion("is M(q) singular?", share=0.5, otherwise=NOT_SINGULAR, is_truth=True),
            Criterion(
                "is it singular with allowed parameters?",
                share=0.5,
                otherwise=(*NOT_SINGULAR, NOT_ALLOWED),
                is_truth=True,
            ),
        ),
        mistakes=definiteness_mistakes.SINGULAR_ARM,
        hints=(
            "M is singular where some velocity other than zero costs no energy. Each link's energy "
            "has two parts, and none of them is negative: what must each of them be?",
            "Turning link 2 must cost no energy: which of its parameters decides that? Then ask "
            "which motions leave its centre of mass at rest.",
            "A point mass has no inertia about its centre of mass. Put the point mass of link 2 where "
            "joint 2 cannot move it, and look at your M22.",
        ),
        section=Section(
            "03-inertia-matrix", "03-singular-dynamics", "What a singular M does to a simulation"
        ),
        further=(
            "A real link has some extent, so no real arm is singular like yours. A model made of "
            "point masses can be, and a simulator then divides by zero."
        ),
    ),
)
