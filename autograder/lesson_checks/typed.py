"""An answer that a student types into a variable above its check: `my_sag = ...` in "05-sag"."""

from collections.abc import Mapping

from autograder.judging.verdict import Row, State, Verdict

TYPE_IT = "Type your answer in place of the three dots, then run this cell again."
CHANGE_IT = "Change your answer, then run this cell again."


class NoAnswerError(Exception):
    """What stands in the variable is no answer that could be judged; the message says why."""


def name_of(id: str) -> str:
    """The student's variable or function of a lesson's check: "my_sag" for "05-sag"."""
    return "my_" + id.partition("-")[2].replace("-", "_")


def typed_in(namespace: Mapping, id: str) -> object:
    """What the student has typed; `...` where nothing; NoAnswerError where the variable is missing."""
    name = name_of(id)
    if name not in namespace:
        raise NoAnswerError(
            f"There is no {name}. Keep this name, and type your answer after its =."
        )
    return namespace[name]


def not_attempted(id: str) -> Verdict:
    return Verdict(id, State.NOT_ATTEMPTED, next_step=TYPE_IT)


def no_answer(id: str, problem: str) -> Verdict:
    return Verdict(id, State.ERROR, problem=problem, next_step=CHANGE_IT)


def right(id: str, text: str, further: str) -> Verdict:
    return Verdict(id, State.CORRECT, 1.0, (Row(text, 1.0, True),), further=further)


def wrong(id: str, text: str, sentence: str) -> Verdict:
    row = Row(text, 1.0, False, (sentence,))
    return Verdict(id, State.INCORRECT, 0.0, (row,), diagnosis=(sentence,), next_step=CHANGE_IT)
