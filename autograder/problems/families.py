"""The checks of a problem on a student's own arm: a member of the family of `material.conventions`.

What depends on how the arm is described is put in its place: the right answer, the cases, the mistakes
and the hints. Ids, criteria and shares stay. Mistakes that are written for the arm of the book are
said of it alone; those of another member follow from its energies. First of all, the right answers of
the other members are tried: whoever copies one reads which arm it belongs to.
"""

from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from autograder.judging.check import Check
from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.models import Beside
from autograder.judging.quantities import each
from autograder.mutation.generated import Generated
from autograder.problems.material import planar_2r
from autograder.problems.material.conventions import BOOK, Convention, nearest_first
from autograder.problems.material.family_equilibria import (
    askew,
    mistaken,
    of_equilibria,
    told_apart,
)
from autograder.problems.material.family_gravity import mistaken as mistaken_pull
from autograder.problems.material.family_gravity import other_pulls
from autograder.problems.material.family_hints import HINTS
from autograder.problems.p1_inertia.checks import arm_and_q, singular
from autograder.problems.p2_energy_skew.checks import not_skew, other, steps
from autograder.protocol import Call

PROBLEMS = ("p1", "p2", "p4", "p5")
# The answers that a mechanism gives, by the check that asks for them.
ASKED = {
    "p1-M": "M",
    "p2-M_dot": "M_dot",
    "p2-C": "C",
    "p4-potential_energy": "potential_energy",
    "p4-g_vec": "g_vec",
    "p5-f": "f",
    "p5-energy_drift": "energy_drift",
}
# All whose right answer depends on the arm.
OF_THE_ARM = (*ASKED, "p1-singular_arm", "p2-C_other", "p4-equilibria")
# Those in which gravity's pull is typed by the student.
WITH_GRAVITY = ("p4-potential_energy", "p4-g_vec", "p5-energy_drift")
SHOULDER = "change of P as link 1 turns from the x axis and link 2 keeps its direction"


@lru_cache(maxsize=256)
def on(own: Convention, check: Check) -> Check:
    """The check on this arm; the same check where the arm does not matter to it."""
    if check.id not in OF_THE_ARM:
        return check
    if own == BOOK:
        more = askew(own) if check.id == "p4-equilibria" else ()
        return replace(check, mistakes=(*_copied(own, check), *check.mistakes, *more))
    made = Generated(own.name, ASKED[check.id]) if check.id in ASKED else None
    changed = replace(
        check,
        reference=_right(own, check),
        calls=partial(_calls, own, check),
        mistakes=_copied(own, check),
        catalogue=made,
        terms=made.terms if made else (),
        hints=HINTS.get(check.id, check.hints),
        # The card draws where angles start as in the book.
        pose=partial(_pose, own) if check.pose and own == Convention(slope=own.slope) else None,
    )
    match check.id:
        case "p1-singular_arm":
            mistakes = tuple(
                replace(m, wrong=partial(_described, own, m.wrong)) for m in check.mistakes
            )
            return replace(changed, quantities=_singular(own), mistakes=mistakes)
        case "p2-C":
            first, power, skew = check.criteria
            said = replace(skew, otherwise=not_skew("the products of velocities"))
            return replace(changed, quantities=steps(Beside(own.C)), criteria=(first, power, said))
        case "p2-C_other":
            return replace(changed, quantities=partial(other, Beside(own.C)))
        case "p4-potential_energy":
            elbow, shoulder = check.criteria
            elbow = replace(elbow, text="change of P as link 2 turns from the line of link 1")
            shoulder = replace(shoulder, text=SHOULDER)
            return replace(changed, criteria=(elbow, shoulder))
        case "p4-equilibria":
            return replace(
                changed,
                quantities=of_equilibria(own),
                mistakes=(*changed.mistakes, *mistaken(own), *askew(own)),
            )
    return changed


def differs(own: Convention | None, check: Check) -> bool:
    """Whether this arm's right answer is another than that of the arm of the book."""
    return own is not None and own != BOOK and on(own, check) is not check


def _right(own: Convention, check: Check):
    """The right answer of a check on this arm."""
    match check.id:
        case "p1-singular_arm":
            return partial(_described, own, check.reference)
        case "p2-C_other":
            return partial(_other_C, own)
        case "p4-equilibria":
            return lambda arm: own.equilibria()
        case "p5-f":
            return partial(_rate, own)
        case "p5-energy_drift":
            return partial(_drift, own, own)
    return getattr(own, ASKED[check.id])


def _other_C(own: Convention, q, qd, arm):
    return own.C(q, qd, arm) + np.array([[-qd[1], qd[0]], [0.0, 0.0]])


def _rate(own: Convention, x, u, arm):
    q, qd = x[:2], x[2:]
    resisting = own.C(q, qd, arm) @ qd + own.g_vec(q, arm) + planar_2r.f_vec(qd, arm)
    return np.concatenate([qd, np.linalg.solve(own.M(q, arm), u - resisting)])


def _drift(moving: Convention, weighing: Convention, x, arm):
    """E(t) − E(0), (len(x),), J, with K of the one member and P of the other."""
    return _drift_of(moving, weighing.potential_energy, x, arm)


def _drift_of(moving: Convention, P, x, arm):
    energies = [0.5 * row[2:] @ moving.M(row[:2], arm) @ row[2:] + P(row[:2], arm) for row in x]
    return np.array(energies) - energies[0]


def _copied(own: Convention, check: Check) -> tuple[Mistake, ...]:
    """What is right for the other members: a copied answer."""
    if check.id in ("p1-singular_arm", "p5-f"):  # M, C and g are given in p5, whoever writes f
        return ()
    others = nearest_first(own)
    if check.id == "p4-equilibria":
        others = [member for member in others if told_apart(own, member.equilibria())]
    elif check.id in WITH_GRAVITY:
        others += other_pulls(own)
    if check.id == "p5-energy_drift":  # M is given there, and P is not
        return tuple(
            Mistake(f"P of {member.name}", partial(_drift, own, member), _said(own, member, "P is"))
            for member in others
        ) + tuple(
            Mistake(name, partial(_drift_of, own, P), sentence)
            for name, P, sentence in mistaken_pull(own, "potential_energy")
        )
    # Of right answers to p2-C_other there are many.
    claim = Claim.CHANGED if check.id == "p2-C_other" else Claim.WHOLE
    return tuple(
        Mistake(
            f"right for {member.name}",
            _right(member, check),
            _said(own, member, "answer is"),
            claim,
        )
        for member in others
    ) + tuple(
        Mistake(*mistake)
        for mistake in (mistaken_pull(own, ASKED[check.id]) if check.id in WITH_GRAVITY else ())
    )


def _said(own: Convention, member: Convention, what: str) -> str:
    *angles, gravity = [
        "" if theirs == ours else theirs
        for theirs, ours in zip(member.facts, own.facts, strict=True)
    ]
    whose = " and ".join(filter(None, angles))
    parts = [f"whose {whose}" if whose else "", f"where {gravity}" if gravity else ""]
    return (
        f"Your {what} right for an arm {', '.join(filter(None, parts))}. Yours is another: look at "
        "the table and the picture below the set-up cell."
    )


def _calls(own: Convention, check: Check, rng: np.random.Generator, count: int) -> list[Call]:
    """The same positions of the links as in the check, as this arm's angles."""
    return [_moved(own, call) for call in check.calls(rng, count)]


def _moved(own: Convention, call: Call) -> Call:
    if not call.args or not isinstance(call.args[0], np.ndarray):
        return call
    first = call.args[0].copy()  # q, x = [q; q̇], or rows of x
    first[..., :2] = own.angles_at(BOOK.directions(first[..., :2]))
    return replace(call, args=(first, *call.args[1:]))


def _pose(own: Convention, call: Call) -> list:
    return own.joints(call.args[0][:2], call.args[-1])


def _described(own: Convention, answer):
    """(arm, q) of the arm of the book in this arm's angles."""
    arm, q = answer()
    return arm, tuple(own.angles_at(BOOK.directions(q)))


def _singular(own: Convention) -> each:
    """In the angles of the book, in which the check looks at the answer."""

    @each
    def parts(call, value):
        arm, q = arm_and_q(value)
        of_book = BOOK.angles_at(own.directions(np.ravel(q)))
        return singular(arm, of_book)

    return parts
