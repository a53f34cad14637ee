"""The derivations that hold of any mechanism, as the problem of one asks for them: cart-pole-E.

The numbers of `energy.py` are those of any mechanism, so that the lines are marked as in p2 and p5.
"""

import re
from dataclasses import replace
from functools import lru_cache

from autograder.proofs.derivation import Derivation
from autograder.proofs.derivations import DERIVATIONS, P2_ENERGY, P2_SKEW, P5_ENERGY
from autograder.proofs.energy import FREE, WITH_FRICTION
from autograder.proofs.subject import Subject

# A mechanism may slide, and have springs.
_MEANINGS = {
    "g": "the vector g(q) of the equation of motion: gravity and springs",
    "u": "what the motors give: torques and forces",
    "f": "the friction",
}
_SENTENCES = {
    "gravity reversed": "In this step g has the wrong sign. On which side of the equation of motion "
    "does it stand?",
    "no gravity": "This step loses g, or counts it once too often. Look for it in each term.",
    "no torque": "This step takes the motors to give nothing. Who has switched them off?",
    "friction lost": "This step has no friction in the equation of motion. What resists the motion?",
}


def _in_its_words(subject: Subject) -> Subject:
    meanings = {name: _MEANINGS.get(name, says) for name, says in subject.meanings.items()}
    return replace(subject, meanings=meanings)


_FREE, _WITH_FRICTION = _in_its_words(FREE), _in_its_words(WITH_FRICTION)


def _of_any(derivation: Derivation, subject: Subject) -> Derivation:
    return replace(
        derivation,
        subject=subject,
        mistakes=tuple(
            replace(mistake, sentence=_SENTENCES.get(mistake.name, mistake.sentence))
            for mistake in derivation.mistakes
        ),
    )


_ROWS = P2_ENERGY.rows
_ROWS_WITH_FRICTION = tuple(
    replace(row, milestone=row.milestone.replace("qd' u", "qd' (u - f)")) for row in _ROWS
)
# By what follows the mechanism's name in an id. The rows are those of the table that
# `autograder new-problem` writes.
OF_ANY = {
    "E": _of_any(P2_ENERGY, _FREE),
    "E-friction": replace(_of_any(P5_ENERGY, _WITH_FRICTION), rows=_ROWS_WITH_FRICTION),
    "skew": replace(
        _of_any(P2_SKEW, _FREE), rows=tuple(replace(row, number=3) for row in P2_SKEW.rows)
    ),
}
# The course's own problems, as p1 and c6, name theirs one by one. The lines of cart-pole-E stand in the
# cell answer-cart-pole-E.
_ID = re.compile(rf"(?!answer-|[pc]\d+-)([a-z0-9]+(?:-[a-z0-9]+)*)-({'|'.join(OF_ANY)})")


@lru_cache(maxsize=256)
def derivation_of(id: str) -> Derivation | None:
    """The derivation of this id, of a problem or of a mechanism; None where there is none.

    `cart-pole-E` stands beside the proof `cart-pole-proof`.
    """
    if id in DERIVATIONS:
        return DERIVATIONS[id]
    found = _ID.fullmatch(id)
    if found is None:
        return None
    return replace(OF_ANY[found[2]], id=id, cell=f"{found[1]}-proof")


def ids_of(mechanism: str) -> list[str]:
    """The ids of a mechanism's derivations; none where no mechanism has this name."""
    return [id for kind in OF_ANY if derivation_of(id := f"{mechanism}-{kind}")]
