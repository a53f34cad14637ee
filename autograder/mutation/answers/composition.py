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
    in_inertia, in_g = _everywhere(inertia), _everywhere(g)
    pairs = [
        (i, j)
        for kind, places in in_inertia.items()
        for i in places
        for j in in_g.get(kind) or in_g.get(_as_angle(*kind), [])
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


def _everywhere(mutants: "list[Mutant]") -> dict[tuple[str, str, str], list[int]]:
    """By their kinds the mistakes in all terms alike, or else in the one term that allows it."""
    found: dict[tuple[str, str, str], list[int]] = {}
    for k, m in enumerate(mutants):
        if not m.is_step:
            found.setdefault((m.operator, m.put, m.instead_of), [])
            if not m.entry:
                found[m.operator, m.put, m.instead_of].append(k)
    for kind, places in found.items():
        alike = [k for k in places if not mutants[k].term]
        one_term = len({mutants[k].term for k in places}) == 1
        found[kind] = alike or (places if one_term else [])
    return found


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
