"""A check: which function the student defines, what to call it with, and how its numbers are judged.

One check serves the student's cell, `nbgrader validate` and the grader; they differ only in where the
function runs (`ask`) and in how many cases are drawn.
"""

from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from autograder.verdict import Row, State, Verdict, Witness
from autograder.wall import Call, Fault, FaultKind, Reply, Symbol, shortened

VISIBLE_CASES = 6
HIDDEN_CASES = 24

# An answer is right to rounding. Single precision through a few operations leaves 4e-6 of the scale
# below; a wrong formula shows at 1e-4 or more.
TOLERANCE = 1e-5
# A case counts at no less than this share of the largest one, so that a value near zero, where
# single precision has no digits left, is not judged by itself.
LEAST_SCALE = 0.05

Ask = Callable[[list[Call]], list[Reply]]


class UnfitError(Exception):
    """Numbers came back, but not as many, or not in the shape, that the question asks for."""


@dataclass(frozen=True)
class Criterion:
    """One thing that is asked of an answer: in words, its unit, its share of the credit.

    otherwise: what to say where it is not met and no known mistake matches.
    """

    text: str
    unit: str
    share: float = 1.0
    otherwise: str = ""


@dataclass(frozen=True)
class Mistake:
    """A physics mistake that people make: a wrong model, and the sentence that names it.

    wrong: takes the arguments of the student's function and gives what the mistaken one returns.
    sentence: says where to look, never the formula.
    """

    name: str
    wrong: Callable
    sentence: str


class Check:
    """What is asked of one function. A problem makes one instance a graded cell.

    id: the grade_id of its cell. signature: how the function is called. reference: the right answer,
    with the same arguments. calls(rng, count): the calls to try. quantities(call, value): what is
    judged in a value, one array a criterion; by default the one number that came back.
    mistakes: tried in order on each criterion that is not met.
    """

    def __init__(
        self,
        id: str,
        signature: str,
        reference: Callable,
        calls: Callable[[np.random.Generator, int], list[Call]],
        criteria: tuple[Criterion, ...],
        mistakes: tuple[Mistake, ...] = (),
        quantities: Callable[[Call, np.ndarray], tuple[np.ndarray, ...]] | None = None,
    ):
        self.id = id
        self.signature = signature
        self.name = signature.partition("(")[0]
        self.reference = reference
        self.calls = calls
        self.criteria = criteria
        self.mistakes = mistakes
        self.quantities = quantities or one_number

    def run(self, ask: Ask, rng: np.random.Generator, count: int = VISIBLE_CASES) -> Verdict:
        """Try the student's function and judge it. Never raises: a fault of ours is its own state."""
        try:
            calls = self.calls(rng, count)
            expected = [self._quantities_of(self.reference, call) for call in calls]
            # The reference goes first: where it fails the check is to blame, not the student.
            if not all(self._met(self._errors(calls, expected, expected))):
                raise ArithmeticError("the reference does not pass its own check")
        except Exception as error:
            return self._failed(error)
        replies = ask(calls)
        fault = next((reply.fault for reply in replies if reply.fault), None)
        if fault:
            return self._faulty(fault)
        # Near the largest float, their numbers less ours overflow: that is wrong, not our failure.
        with np.errstate(over="ignore", invalid="ignore"):
            return self._judged(calls, expected, replies)

    def _judged(self, calls, expected, replies) -> Verdict:
        try:
            given = [
                self.quantities(call, _finite(reply.value))
                for call, reply in zip(calls, replies, strict=True)
            ]
        except UnfitError as error:
            return self._error(f"{self.signature} returned {error}.")
        except Exception as error:
            return self._failed(error)
        return self.judge(calls, expected, given)

    def judge(self, calls: list[Call], expected: list, given: list) -> Verdict:
        """The verdict on quantities given, case by case, against those expected."""
        errors = self._errors(calls, expected, given)
        met = self._met(errors)
        credit = sum(c.share for c, ok in zip(self.criteria, met, strict=True) if ok)
        rows = tuple(Row(c.text, c.share, ok) for c, ok in zip(self.criteria, met, strict=True))
        if all(met):
            return Verdict(self.id, State.CORRECT, 1.0, rows)
        return Verdict(
            self.id,
            State.PARTLY_CORRECT if credit > 0 else State.INCORRECT,
            credit,
            rows,
            self._witness(calls, expected, given, errors, met),
            diagnosis=self._diagnosis(calls, expected, given, met),
            next_step="Change your function, run its cell, then run this cell again.",
        )

    def _errors(self, calls, expected, given) -> list[np.ndarray]:
        """For each criterion the relative error of each case."""
        return [
            _relative_errors([e[k] for e in expected], [g[k] for g in given])
            for k in range(len(self.criteria))
        ]

    def _met(self, errors) -> list[bool]:
        return [bool(np.all(error <= TOLERANCE)) for error in errors]

    def _quantities_of(self, model: Callable, call: Call) -> tuple[np.ndarray, ...]:
        return self.quantities(call, np.asarray(_evaluated(model, call), dtype=float))

    def _diagnosis(self, calls, expected, given, met) -> tuple[str, ...]:
        """The sentence of the mistake behind each criterion that is not met, where one is known."""
        sentences = []
        for k, ok in enumerate(met):
            if ok:
                continue
            for mistake in self.mistakes:
                wrong = [self._quantities_of(mistake.wrong, call) for call in calls]
                theirs = [w[k] for w in wrong]
                differs = np.any(_relative_errors([e[k] for e in expected], theirs) > TOLERANCE)
                matches = np.all(_relative_errors(theirs, [g[k] for g in given]) <= TOLERANCE)
                if differs and matches:
                    sentences.append(mistake.sentence)
                    break
            else:
                sentences.append(self.criteria[k].otherwise)
        return tuple(dict.fromkeys(filter(None, sentences)))

    def _witness(self, calls, expected, given, errors, met) -> Witness:
        k = met.index(False)
        worst = int(np.argmax(errors[k]))
        e, g = expected[worst][k], given[worst][k]
        at = np.unravel_index(np.argmax(np.abs(g - e)), np.shape(e))
        off, size = abs(float(g[at] - e[at])), abs(float(e[at]))
        share = f" ({_percent(off / size)} of the right value)" if size > 0 else ""
        unit = f" {self.criteria[k].unit}".rstrip()
        entry = "" if np.size(e) == 1 else f" in entry {tuple(int(i) for i in at)}"
        # A quantity formed from several values is not what the function returned.
        what = "" if len(self.criteria) == 1 else f" for the {self.criteria[k].text}"
        return Witness(
            shown_call(calls[worst]),
            f"{float(g[at]):.4g}{unit}{entry}{what}",
            f"{off:.3g}{unit}{share}",
        )

    def _faulty(self, fault: Fault) -> Verdict:
        if fault.kind is FaultKind.NOT_IMPLEMENTED:
            return Verdict(
                self.id,
                State.NOT_ATTEMPTED,
                next_step=f"Write {self.signature} where it says NotImplementedError, "
                "run its cell, then run this cell again.",
            )
        where = f" ({fault.line})" if fault.line else ""
        renamed = f" There is a {fault.message}: is that it?" if fault.message else ""
        return self._error(
            {
                FaultKind.MISSING: f"The notebook defines no {self.name}.{renamed} The check calls "
                f"{self.signature}, by exactly this name; was its cell run?",
                FaultKind.CELL_FAILED: f"The notebook defines no {self.name}: the cell that should "
                f"define it stopped with {fault.message}",
                FaultKind.NOT_CALLABLE: f"{self.name} is a {fault.message}, not a function that can "
                f"be called as {self.signature}; was the name used again further down?",
                FaultKind.RAISED: f"{self.signature} raised {fault.message}{where}.",
                FaultKind.TIMED_OUT: f"{self.signature} did not return within {fault.message}; "
                "is there a loop that never ends?",
                FaultKind.DIED: f"Python itself stopped while {self.signature} was running; "
                "does it call exit, or use up all memory?",
                FaultKind.NOTHING: f"{self.signature} returned None; is the return statement missing?",
                FaultKind.NOT_NUMBERS: f"{self.signature} returned {fault.message}; it must return "
                "numbers.",
                FaultKind.GARBLED: f"What {self.signature} returned could not be read as numbers.",
            }[fault.kind]
        )

    def _error(self, problem: str) -> Verdict:
        step = "Mend this first; then the check can look at the physics."
        return Verdict(self.id, State.ERROR, problem=problem, next_step=step)

    def _failed(self, error: Exception) -> Verdict:
        return Verdict(
            self.id,
            State.CHECK_FAILED,
            problem=f"{type(error).__name__} in the check {self.id}: {shortened(str(error))}.",
            next_step="This is not your fault. Please tell your instructor.",
        )


def one_number(call: Call, value: np.ndarray) -> tuple[np.ndarray]:
    """A value that is one number, whether it came as a number, (1,) or (1, 1)."""
    if value.size != 1:
        raise UnfitError(f"{value.size} numbers of shape {value.shape}; one number is asked for")
    return (value.reshape(()),)


def shown_call(call: Call) -> str:
    """A call as a student would type it, numbers shortened."""
    names = {name: f"{at:.4g}" for name, at in call.at[-1].items()} if call.at else {}
    return f"{call.name}({', '.join(_shown(value, names) for value in call.args)})"


def _percent(share: float) -> str:
    return f"{share:.0%}" if share >= 0.01 else f"{100 * share:.1g}%"


def _shown(value, names) -> str:
    match value:
        case Symbol(name):
            return f"{name}={names.get(name, name)}"
        case SimpleNamespace():
            inside = ", ".join(f"{name}={_shown(v, names)}" for name, v in vars(value).items())
            return f"({inside})"
        case np.ndarray():
            return np.array2string(value, precision=4, separator=", ")
        case _:
            return f"{value:.4g}"


def _evaluated(model: Callable, call: Call) -> np.ndarray:
    """A model's numbers for a call: one value, or one a point where the call is symbolic."""
    if not call.at:
        return model(*call.args)
    points = [[point[symbol.name] for symbol in call.args] for point in call.at]
    return np.array([model(*point) for point in points])


def _finite(value: np.ndarray) -> np.ndarray:
    bad = value[~np.isfinite(value)] if value.ndim else value[None][~np.isfinite(value[None])]
    if bad.size:
        raise UnfitError(f"{bad.flat[0]}, which is not a finite number")
    return value


def _relative_errors(expected: list, given: list) -> np.ndarray:
    """The largest error of each case over the scale of its expected value."""
    size = np.array([np.max(np.abs(e)) for e in expected])
    scale = np.maximum(size, LEAST_SCALE * np.max(size))
    error = np.array([np.max(np.abs(g - e)) for e, g in zip(expected, given, strict=True)])
    return error / np.where(scale > 0, scale, 1.0)
