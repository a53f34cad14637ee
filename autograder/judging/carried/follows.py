"""From which earlier answers of a student's own an answer follows, and how."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from autograder.judging.quantities import Quantities
from autograder.protocol import Call


@dataclass(frozen=True)
class Way:
    """How an answer follows from earlier ones.

    asks(call, value): for a call of the later function, the calls of the earlier ones that are needed.
    made(call, value, numbers): what the later function should return, by the numbers that these gave;
    None where nothing follows from them. value: what the later function itself returned, where of_own
    says that both need it; otherwise None. still(call): what the later function returns where the
    earlier one does nothing at all; by default zeros. quantities(of_check, calls, numbers): what is
    judged, where that depends on the earlier answers too; by default the quantities of the check.
    """

    asks: Callable[[Call, Any], list[Call]]
    made: Callable[[Call, Any, list], Any]
    of_own: bool = False
    still: Callable[[Call], Any] | None = None
    quantities: Callable[[Quantities, list[Call], list], Quantities] | None = None


@dataclass(frozen=True)
class Follows:
    """That an answer follows from earlier ones, and what to say where it does so from wrong ones.

    earlier: the ids of their checks. sentence: what is right, and what to mend. way: None in a student's
    package, which leaves this to the grader.
    """

    earlier: tuple[str, ...]
    sentence: str
    way: Way | None = None
