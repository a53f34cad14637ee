"""Tries the checks of a mechanism: right answers in several styles, and every mistake."""

import importlib.util
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.verdict import State, Verdict
from autograder.mechanisms import MECHANISMS, Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of, mistakes_of
from autograder.mutation.styles import STYLES
from autograder.protocol import Call, Reply, read, real


class NoMechanismError(ValueError):
    """There is no mechanism of this name, or none in this file; the text says what there is."""


def found(name: str) -> Mechanism:
    """The mechanism of this name, or the MECHANISM of this Python file."""
    if name in MECHANISMS:
        return MECHANISMS[name]
    path = Path(name)
    if path.suffix != ".py":
        raise NoMechanismError(
            f"there is no mechanism {name!r}; known are {', '.join(MECHANISMS)}; a mechanism of your "
            "own is named by its file, such as my_arm.py"
        )
    if not path.is_file():
        raise NoMechanismError(f"{name}: there is no such file")
    spec = importlib.util.spec_from_file_location("own_mechanism", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # whatever the lecturer's file raises
        raise NoMechanismError(f"{name}: {type(error).__name__}: {error}") from error
    own = getattr(module, "MECHANISM", None)
    if not isinstance(own, Mechanism):
        raise NoMechanismError(
            f"{name}: needs MECHANISM = Mechanism(…), of autograder.mechanisms; it has "
            f"{'none' if own is None else repr(own)}"
        )
    return own


def tried(mechanism: Mechanism) -> Iterator[tuple[str, bool]]:
    """Line by line what students will read, each with whether it is as it should be."""
    for answer in ANSWERS:
        check = check_of(mechanism, answer)
        wrong_styles = [
            style
            for style, given in STYLES.items()
            if _asked(check, partial(_right, check, given)).state is not State.CORRECT
        ]
        refused = f", but not {', '.join(wrong_styles)}" if wrong_styles else ""
        yield f"{check.id}: the right answer is correct{refused}", not wrong_styles
        known = mistakes_of(mechanism, answer)
        for k, mistake in enumerate(known):
            verdict = _asked(check, partial(_given, check, k))
            named = verdict.diagnosis == (mistake.sentence,)
            yield (
                f"  {' '.join(verdict.diagnosis) or f'(nothing is said of {mistake.name})'}",
                named,
            )
        yield f"  {len(known)} mistakes", True


def _right(check: Check, style: Callable, calls: list[Call]) -> list:
    """The right answers in this style, read as a student's are."""
    return [read(call, style(check.reference(*map(real, call.args)))) for call in calls]


def _given(check: Check, k: int, calls: list[Call]) -> list:
    """What the k-th mistake returns for all calls, in one step."""
    assert check.catalogue is not None
    _, values = check.catalogue(calls)[k]
    return list(values)


def _asked(check: Check, answers: Callable[[list[Call]], list]) -> Verdict:
    def ask(calls: list[Call]) -> list[Reply]:
        return [Reply(value=value) for value in answers(calls)]

    return check.run(ask, np.random.default_rng(20260101), VISIBLE_CASES)
