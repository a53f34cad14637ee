"""How an answer is made of others: a mistake in one of them shows in it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
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


@dataclass(frozen=True)
class Composition:
    """columns: from the arguments of calls to arrays whose first axis is the calls. right: the answer
    to them, (cases, …). groups(catalogue): the mistakes, the simplest reading first; catalogue(name)
    has those of another answer of the mechanism. terms: the parts of the right answer, by name.
    """

    columns: Callable[[list[tuple]], tuple]
    right: Numbers
    groups: "Callable[[Callable[[str], Catalogue]], Iterator[Group]]"
    terms: dict[str, Numbers] = field(default_factory=dict)
