"""Tries the checks of a mechanism: right answers in several styles, and every mistake."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.diagnosis import Mistake
from autograder.judging.verdict import State, Verdict
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.generated import Generated
from autograder.mutation.styles import STYLES
from autograder.protocol import Call, Reply, read, real

# Of the calls for which mistakes are tried.
SEED = 20260101
# So many lines of each kind stand in a summary.
MOST = 10


def nothing_to_ask(mechanism: Mechanism, answer: str) -> str:
    """Why a problem cannot ask for an answer: it is 0 for every motion, so that zeros earn all points.

    Empty if it can. Tried in numbers, on what the check judges: of P only the changes.
    """
    check = check_of(mechanism, answer)
    calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    right = [check.reference(*map(real, call.args)) for call in calls]
    judged = [part for parts in check.quantities(calls, right) for part in parts]
    if any(np.any(np.abs(part) > 1e-12) for part in judged):
        return ""
    of = "the change of P" if answer == "potential_energy" else ANSWERS[answer].head
    return f"{of} of {mechanism.name} is 0 for every motion: ask for something else"


@dataclass(frozen=True)
class Line:
    """What an instructor reads. good: whether it is as it should be. detail: one of very many."""

    text: str
    good: bool = True
    detail: bool = False


@dataclass(frozen=True)
class Tried:
    """A mistake that was handed in: its answer and name, its sentence, and what the check said."""

    answer: str
    name: str
    sentence: str
    said: tuple[str, ...]

    @property
    def is_named(self) -> bool:
        return self.said == (self.sentence,)

    @property
    def shown(self) -> str:
        return " ".join(self.said) or f"(nothing is said of {self.name})"


def tried(
    mechanism: Mechanism,
    asks: Sequence[str] = tuple(ANSWERS),
    names: bool = False,
    found: list[Tried] | None = None,
) -> Iterator[Line]:
    """Line by line what was tried, and what students will read of each mistake.

    names: with the name of each mistake, by which a teacher's own sentence finds it. found: gets what
    was said of each, for `summary`.
    """
    answers = tuple(f"{answer}: " for answer in ANSWERS)
    for row in dict(mechanism.sentences):
        if not row.startswith(answers):
            yield Line(f"the sentence for {row!r} is for none of {', '.join(ANSWERS)}", False)
    for answer in asks:
        check = check_of(mechanism, answer)
        if why := nothing_to_ask(mechanism, answer):
            yield Line(f"{check.id}: {why}")
            continue
        wrong_styles = [
            style
            for style, given in STYLES.items()
            if _asked(check, partial(_right, check, given)).state is not State.CORRECT
        ]
        refused = f", but not {', '.join(wrong_styles)}" if wrong_styles else ""
        yield Line(f"{check.id}: the right answer is correct{refused}", not wrong_styles)
        made = Generated(mechanism, answer)
        for row in made.unused():
            yield Line(f"  the sentence for {f'{answer}: {row}'!r} fits no mistake", False)
        here = []
        once = _Once(made, check.calls(np.random.default_rng(SEED), VISIBLE_CASES))
        knowing = replace(check, catalogue=once)
        for mistake, values in once.made:
            said = _asked(knowing, partial(_listed, values)).diagnosis
            here.append(Tried(answer, mistake.name, mistake.sentence, said))
            yield Line(f"  {here[-1].shown}", here[-1].is_named, detail=True)
            if names:
                yield Line(f"      {answer}: {mistake.name}", detail=True)
        yield Line(f"  {len(here)} mistakes, {sum(one.is_named for one in here)} of them named")
        if found is not None:
            found += here


def summary(found: Sequence[Tried]) -> Iterator[Line]:
    """All mistakes in a few lines: how many are named, which are not, and what is said most."""
    nameless = [one for one in found if not one.is_named]
    answers = dict.fromkeys(one.answer for one in found)
    yield Line(
        f"{len(found)} mistakes in {_count(len(answers), 'answer')}; {len(found) - len(nameless)} are "
        "told apart and named by their own sentences"
    )
    for one in nameless[:MOST]:
        yield Line(f"  not named: {one.answer}: {one.name}: {one.shown}", False)
    if len(nameless) > MOST:
        yield Line(f"  and {len(nameless) - MOST} more that are not named")
    often = Counter(one.sentence for one in found).most_common(MOST)
    if often:
        yield Line("What is said most:")
    for sentence, times in often:
        yield Line(f"{times:6d} × {sentence}")


def _listed(values: Sequence | np.ndarray, calls: list[Call]) -> list:
    """What a mistake returns for all calls."""
    return list(values)


class _Once:
    """A catalogue whose numbers for the calls of one seed are made once, for thousands of answers."""

    def __init__(self, of: Generated, calls: list[Call]):
        self._of, self.made = of, of(calls)

    def mistakes(self) -> list[Mistake]:
        return self._of.mistakes()

    def __call__(self, calls: list[Call], /) -> list[tuple[Mistake, Sequence | np.ndarray]]:
        return self.made


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"


def _right(check: Check, style: Callable, calls: list[Call]) -> list:
    """The right answers in this style, read as a student's are."""
    return [read(call, style(check.reference(*map(real, call.args)))) for call in calls]


def _asked(check: Check, answers: Callable[[list[Call]], list]) -> Verdict:
    def ask(calls: list[Call]) -> list[Reply]:
        return [Reply(value=value) for value in answers(calls)]

    return check.run(ask, np.random.default_rng(SEED), VISIBLE_CASES)
