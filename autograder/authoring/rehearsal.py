"""Hands in a problem's model answers, right and wrong, to the grader that grades the class."""

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import sympy as sp
from nbformat import NotebookNode

from autograder.authoring.model_answer import model_answer
from autograder.authoring.problem import notebook
from autograder.judging.carried.judge import Carrying
from autograder.judging.check import HIDDEN_CASES, Check
from autograder.judging.verdict import State, Verdict
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.operators import OF_ENERGIES, rewritings
from autograder.mutation.trial import Line, nothing_to_ask
from autograder.notebook.beside import Beside
from autograder.notebook.grade import CARRIED_ON, grade
from autograder.proofs import card
from autograder.protocol.calls import answer_all

# How students write the same right answer: code below it, which makes another function of it.
STYLES = {
    "as it is written": "",
    "as nested lists": "{name} = lambda *given: np.asarray(_right(*given)).tolist()",
    "as tuples": "def {name}(*given):\n"
    "    value = np.asarray(_right(*given)).tolist()\n"
    "    whole = lambda v: tuple(map(whole, v)) if isinstance(v, list) else v\n"
    "    return whole(value)",
    "in single precision": "def {name}(*given):\n    return np.float32(_right(*given))",
    "as an array of objects": "def {name}(*given):\n"
    "    return np.asarray(_right(*given), dtype=object)",
    "rounded in the last digits": "def {name}(*given):\n"
    "    return np.asarray(_right(*given)) * (1 + 1e-13)",
    "in an array that is used again": "_kept = {{}}\n\ndef {name}(*given):\n"
    "    value = np.asarray(_right(*given))\n"
    "    _kept.setdefault(value.shape, np.zeros(value.shape))[...] = value\n"
    "    return _kept[value.shape]",
    "column by column in memory": "def {name}(*given):\n"
    "    return np.asfortranarray(_right(*given))",
    "that cannot be written to": "def {name}(*given):\n"
    "    value = np.array(_right(*given))\n    value.setflags(write=False)\n    return value",
    "as SymPy's numbers": "import sympy\n\ndef {name}(*given):\n"
    "    return np.vectorize(sympy.Float, otypes=[object])(_right(*given))",
}


# So many notebooks with mistakes are handed in where not all are asked for.
FEW = 3


def rehearsed(
    mechanism: Mechanism, files: Mapping[str, str], asks: Sequence[str] = tuple(ANSWERS)
) -> Iterator[Line]:
    """A line for each style: what it gets, and whether that is full credit.

    files: the mechanism's own file, name → text, as the grader finds it beside the source.
    """
    asked = [answer for answer in asks if not nothing_to_ask(mechanism, answer)]
    source = notebook(mechanism, asked)
    yield Line(f"{mechanism.name}, its model answers handed in and graded:")
    for style, code in STYLES.items():
        graded = grade(_handed_in(source, code), source, "rehearsal", Beside(mechanisms=files))
        lost = [str(v) for v in graded.verdicts.values() if v.state is not State.CORRECT]
        lost += [
            card.text(marked, with_names=False)
            for of in graded.marks.values()
            for marked in of
            if not marked.done
        ]
        yield Line(
            "\n".join([f"  {style}: {'full points' if not lost else ''}", *lost]).rstrip(),
            not lost,
        )


def mistaken(
    mechanism: Mechanism,
    files: Mapping[str, str],
    asks: Sequence[str] = tuple(ANSWERS),
    every: bool = False,
) -> Iterator[Line]:
    """A line for each mistake in an energy, from which all answers were then derived and handed in:
    whether the grader says of them what a check says of their numbers here. every: not a few alone.
    """
    asked = [answer for answer in asks if not nothing_to_ask(mechanism, answer)]
    source = notebook(mechanism, asked)
    known = list(wrong_mechanisms(mechanism))
    chosen = known if every else known[:: max(1, len(known) // FEW)][:FEW]
    yield Line(
        f"{mechanism.name}, {len(chosen)} of {len(known)} mistakes in its energies handed in and graded:"
    )
    for name, wrong in chosen:
        bodies = {answer: _derived(wrong, answer, mechanism) for answer in asked}
        graded = grade(_with(source, bodies), source, "rehearsal", Beside(mechanisms=files))
        said: list[str] = []
        differ: list[str] = []
        namespace = _namespace(bodies)
        states: dict[str, State] = {}
        for id, got in graded.verdicts.items():
            expected = _judged_here(mechanism, id.rpartition("-")[2], namespace, states)
            states[id] = expected.state
            said += got.diagnosis
            if (got.state, got.diagnosis) != (expected.state, expected.diagnosis):
                differ.append(f"{got}\n  where it should be:\n{expected}")
        named = sum(bool(v.diagnosis) for v in graded.verdicts.values())
        lost = sum(v.state is not State.CORRECT for v in graded.verdicts.values())
        yield Line(
            f"  {name}: {lost} of {len(asked)} answers wrong, {named} explained", detail=every
        )
        for sentence in dict.fromkeys(said):
            yield Line(f"    {sentence}", detail=True)
        for one in differ:
            yield Line(one, False)


def wrong_mechanisms(mechanism: Mechanism) -> Iterator[tuple[str, Mechanism]]:
    """The mechanism with one term of an energy wrong, each with the name of what is wrong."""
    for field in ("kinetic", "potential"):
        terms = getattr(mechanism, field)
        for k, term in enumerate(terms):
            for done in rewritings(sp.Tuple(term.energy), mechanism):
                if done.operator in OF_ENERGIES:
                    continue  # no M follows from it
                wrong = copy.copy(mechanism)  # which nothing refuses, as it would a new one
                changed = (*terms[:k], replace(term, energy=done.expressions[0]), *terms[k + 1 :])
                object.__setattr__(wrong, field, changed)
                place = " / ".join(filter(None, (done.put, done.instead_of, done.detail)))
                yield " / ".join(filter(None, (done.operator, term.name, place))), wrong


def _derived(wrong: Mechanism, answer: str, mechanism: Mechanism) -> list[str]:
    """What follows from the wrong energies; the right answer where nothing does, as no Y does from
    energies that are no sum of products of masses and inertias.
    """
    try:
        return model_answer(wrong, answer)
    except (ValueError, sp.PolynomialError):
        return model_answer(mechanism, answer)


def _namespace(bodies: Mapping[str, Sequence[str]]) -> dict:
    """Functions with these bodies, which are ours."""
    namespace: dict = {"np": np}
    for answer, body in bodies.items():
        exec(_function(answer, body), namespace)
    return namespace


def _judged_here(
    mechanism: Mechanism, answer: str, namespace: dict, states: Mapping[str, State]
) -> Verdict:
    """The verdict on one of these functions, without a sandbox. states: of those before it."""

    def known(id: str) -> Check:
        return check_of(mechanism, id.rpartition("-")[2])

    ask = partial(answer_all, namespace=namespace)
    carrying = Carrying(known, CARRIED_ON, states)
    return known(f"-{answer}").run(ask, np.random.default_rng(1), HIDDEN_CASES, carrying)


def _function(answer: str, body: Sequence[str]) -> str:
    return "\n".join([f"def {ANSWERS[answer].signature}:", *(f"    {line}" for line in body)])


def _with(source: NotebookNode, bodies: Mapping[str, Sequence[str]]) -> NotebookNode:
    """A submission with these functions."""
    answered = copy.deepcopy(source)
    for cell in answered.cells:
        grade_id = cell.metadata.get("nbgrader", {}).get("grade_id", "")
        if cell.cell_type == "code" and grade_id.startswith("answer-"):
            answer = grade_id.removeprefix("answer-")
            if answer in bodies:  # no lines of the proof
                cell.source = _function(answer, bodies[answer])
    return answered


def _handed_in(source: NotebookNode, code: str) -> NotebookNode:
    """The model answers as a student's, each function wrapped in the style's code."""
    answered = copy.deepcopy(source)
    for cell in answered.cells:
        grade_id = cell.metadata.get("nbgrader", {}).get("grade_id", "")
        if code and cell.cell_type == "code" and grade_id.startswith("answer-"):
            name = grade_id.removeprefix("answer-")
            if name not in ANSWERS:  # the lines of the proof are texts in every style
                continue
            asked = code.format(name=name).replace("_right", f"_right_{name}")
            cell.source += f"\n\n_right_{name} = {name}\n{asked.replace('_kept', f'_kept_{name}')}"
    return answered
