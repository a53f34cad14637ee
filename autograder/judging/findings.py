"""What is true of wrong numbers by themselves, where no known mistake explains them.

Each finding compares all cases of one criterion: with the right numbers, with a multiple of them, or
with its known terms. It is said only where it holds to rounding in every case.
"""

import math
from collections.abc import Sequence

import numpy as np

from autograder.judging.criterion import TOLERANCE, Criterion, errors_of, relative_errors
from autograder.judging.quantities import Numbers
from autograder.judging.terms import SURPLUS, Term, in_words, percent_off, terms_off

# A formula is exact to rounding; within this it is approximated.
NEAR = 2e-3
LARGE = 1e12
# A factor is one of these, and no other, to this.
SAME = 1e-4

FACTORS = (
    (-1.0, "has the wrong sign. What turns the sign of the whole?"),
    (0.5, "is half of the right one. Is there a ½ too many, or something that counts twice?"),
    (2.0, "is twice the right one. Is a ½ missing, or does something count twice?"),
    (180 / math.pi, "is 57.3 times the right one, that is 180/π. Where do you convert angles?"),
    (math.pi / 180, "is the right one divided by 57.3, that is 180/π. Where do you convert angles?"),
    (2 * math.pi, "is 6.283 times the right one, that is 2π. Where do you convert turns?"),
    (1 / (2 * math.pi), "is the right one divided by 6.283, that is 2π. Where do you convert turns?"),
    (9.81, "is 9.81 times the right one. Is g a factor where it should not be?"),
    (1 / 9.81, "is the right one divided by 9.81. Is g missing as a factor?"),
)  # fmt: skip


def of_numbers(
    criterion: Criterion, right: list, theirs: list, terms: list[tuple[Term, list]]
) -> str:
    """The first finding that holds of a criterion's numbers, as a sentence; "" where none does."""
    if not criterion.unit or criterion.is_property:
        return ""  # a count or a property is no quantity that could be a multiple of another
    tolerance = criterion.allows(met=False)
    text = criterion.text
    if said := _factor(right, theirs, tolerance):
        return f"In your {text}, every value {said}"
    if _are_whole(right, theirs):
        return (
            f"In your {text}, every value is a whole number. Do you round, or put the values into an "
            "array of whole numbers, as np.array([0, 0]) is? One made by np.zeros keeps decimals."
        )
    if off := terms_off(right, theirs, terms, tolerance):
        return f"In your {text}, {_joined([in_words(term, times) for term, times in off])}."
    if _are_equal(right) and any(map(np.any, right)) and not _are_equal(theirs):
        whose = f"Your {text}" if criterion.entries else f"The entries of your {text}"
        return f"{whose} differ from each other. Should they?"
    error = float(np.max(relative_errors(right, theirs)))
    if 0 < error <= NEAR and any(map(np.any, right)):
        return (
            f"In your {text}, the values are right to {_percent(error)}, but not exactly. Where do you "
            "approximate: with a difference for a derivative, a small angle, a rounded constant?"
        )
    return ""


def of_cases(
    criteria: Sequence[Criterion], expected: Numbers, given: Numbers, met: list[bool]
) -> list[str]:
    """Of each criterion that is not met, in how many cases it is wrong: all that is known of an answer
    that nothing explains.
    """
    found = []
    for k, errors in enumerate(errors_of(criteria, expected, given)):
        wrong = int(np.sum(errors > criteria[k].tolerance))
        tried = sum(np.size(case[k]) > 0 for case in expected)
        cases = "the only case" if tried == 1 else f"{wrong} of {tried} cases"
        start = " Begin with the worst case." if k == met.index(False) else ""
        said = f"None of the mistakes that this check knows explains it. It is wrong in {cases}.{start}"
        found.append("" if met[k] else said)
    return found


def of_repeats(criterion: Criterion, first: list, second: list) -> str:
    """What to say where the same calls, made twice, gave other numbers; "" where they did not."""
    shapes = [list(map(np.shape, numbers)) for numbers in (first, second)]
    if shapes[0] == shapes[1] and criterion.met(relative_errors(first, second)):
        return ""
    return (
        "Called twice with the same arguments, your function does not return the same numbers. Does it "
        "draw random numbers, or use what an earlier call left behind?"
    )


def _factor(right: list, theirs: list, tolerance: float) -> str:
    """What to say of "every value" where all are one multiple of the right ones."""
    expected, given = (np.concatenate([np.ravel(v) for v in values]) for values in (right, theirs))
    # A value that never changes is a multiple of any other.
    if len(expected) < 1 + SURPLUS or np.ptp(np.abs(expected)) <= 1e-3 * np.max(np.abs(expected)):
        return ""
    factor = float(expected @ given / (expected @ expected))
    multiple = [factor * np.asarray(value) for value in right]
    if not np.any(given):
        return "is 0."
    if factor == 0 or np.any(relative_errors(multiple, theirs) > tolerance):
        return ""
    for known, words in FACTORS:
        if abs(factor / known - 1) < SAME:
            return words
    if abs(factor - 1) <= NEAR:
        return f"is {percent_off(factor)}. Is a constant rounded?"
    if 0.5 < factor < 2:
        return f"is {percent_off(factor)}. Which factor belongs to all terms?"
    return f"is {_signed(factor)} times the right one. Which factor belongs to all terms?"


def _are_whole(right: list, theirs: list) -> bool:
    """Whether the values are whole numbers, at least two of them not 0, and the right ones are not."""
    expected, given = (np.concatenate([np.ravel(v) for v in values]) for values in (right, theirs))
    if np.any(given != np.round(given)) or len(np.unique(given[given != 0])) < 2:
        return False
    # A number so large has no decimals in any array.
    return bool(np.any(expected != np.round(expected)) and np.max(np.abs(given)) < LARGE)


def _are_equal(cases: list) -> bool:
    """Whether in each case several entries are one number, as M12 and M21 are."""
    spread = [np.full(np.shape(value), np.ravel(value)[:1]) for value in cases]
    same = np.all(relative_errors(spread, cases) <= TOLERANCE)
    return bool(same and np.size(cases[0]) > 1)


def _joined(parts: list[str]) -> str:
    *first, last = parts
    return f"{', '.join(first)}, and {last}" if first else last


def _signed(factor: float) -> str:
    return f"{factor:.4g}".replace("-", "−")


def _percent(error: float) -> str:
    """The error in one digit, and never less than it is."""
    unit = 10.0 ** math.floor(math.log10(100 * error))
    return f"{math.ceil(100 * error / unit - 1e-9) * unit:.1g} %"
