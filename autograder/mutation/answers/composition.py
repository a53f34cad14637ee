"""How an answer is made of others: a mistake in one of them shows in it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from autograder.mutation.catalogue import Catalogue
    from autograder.mutation.mutant import Mutant

# Numbers from columns, which are what `columns` makes of calls: (…, cases, …).
Numbers = Callable[..., np.ndarray]


@dataclass(frozen=True)
class Group:
    """Mistakes of one source, and the answer to which they lead: (mutants, cases, …)."""

    mutants: "list[Mutant]"
    numbers: Numbers


def throughout(
    inertia: "list[Mutant]", g: "list[Mutant]"
) -> "tuple[list[Mutant], list[int], list[int]]":
    """Mistakes that are made in M and in g alike, such as an angle in degrees; their places in both."""
    kinds = dict.fromkeys((m.operator, m.put, m.instead_of) for m in inertia if not m.is_step)
    pairs = [
        (i, j)
        for kind in kinds
        for i in _everywhere(inertia, kind)
        for j in _everywhere(g, kind) or _everywhere(g, _as_angle(*kind))
    ]
    mutants = [
        replace(
            inertia[i],
            term="",
            in_energy=False,
            detail="in M and P" if g[j].in_energy else "in M and g",
        )
        for i, j in pairs
    ]
    return mutants, [i for i, _ in pairs], [j for _, j in pairs]


def _as_angle(operator: str, put: str, instead_of: str) -> tuple[str, str, str]:
    """What another convention is in g, if one term alone has the angle: no velocity shows it there."""
    both = f"{instead_of} + {put}"
    angles = {"absolute angle": (put, both), "relative angle": (both, put)}
    return ("wrong angle", *angles[operator]) if operator in angles else (operator, put, instead_of)


def _everywhere(mutants: "list[Mutant]", kind: tuple[str, str, str]) -> list[int]:
    """The mistakes of this kind in all terms alike, or else in the one term that allows it."""
    found = [
        k
        for k, m in enumerate(mutants)
        if (m.operator, m.put, m.instead_of) == kind and not m.entry and not m.is_step
    ]
    alike = [k for k in found if not mutants[k].term]
    return alike or (found if len({mutants[k].term for k in found}) == 1 else [])


@dataclass(frozen=True)
class Composition:
    """columns: from the arguments of calls to arrays whose first axis is the calls. right: the answer
    to them, (cases, …). groups(catalogue): the mistakes, the simplest reading first; catalogue(name)
    has those of another answer of the mechanism, catalogue(name, other) those of another mechanism.
    terms: the parts of the right answer, by name.
    """

    columns: Callable[[list[tuple]], tuple]
    right: Numbers
    groups: "Callable[[Callable[..., Catalogue]], Iterator[Group]]"
    terms: dict[str, Numbers] = field(default_factory=dict)
