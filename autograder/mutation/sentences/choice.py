"""Picks the sentence on a mistake, and fills in the term, the entry and the names."""

import fnmatch
import re
from dataclasses import replace

from autograder.mechanisms.outline import Outline
from autograder.mutation.answers import ANSWERS, Answer
from autograder.mutation.mutant import Mutant
from autograder.mutation.sentences.notation import entry_of_pi, is_entry_of_pi, written
from autograder.mutation.sentences.of_columns import OF_A_TERM, OF_COLUMNS
from autograder.mutation.sentences.of_steps import OF_STEPS
from autograder.mutation.sentences.of_terms import (
    AT_A_PLACE,
    OF_FRICTION,
    OF_VELOCITIES,
    THROUGHOUT,
)
from autograder.mutation.sentences.rows import ROWS, Row

GENERAL = AT_A_PLACE | OF_FRICTION | OF_VELOCITIES | OF_STEPS

PLURALS = {"m": "lengths", "kg": "masses", "kg·m²": "inertias"}
KINDS = {
    "m": "length",
    "kg": "mass",
    "kg·m²": "inertia",
    "N/m": "stiffness",
    "N·m/rad": "stiffness",
}

# What an answer follows from, where the mistake was made there.
DERIVED = {"g_vec": "the derivative of a wrong P"}
ENERGIES = {"g_vec": "P"}

# Of an answer, what is wrong with it where one of its parts is.
FOLLOWS = {
    "C": {"M": "Your C looks like the Christoffel matrix of a wrong M."},
    "M_dot": {"M": "Your Ṁ looks like the rate of a wrong M."},
    "f": {
        "M": "Your accelerations look like those of a wrong M.",
        "C": "Your accelerations look like those of a wrong C.",
        "g_vec": "Your accelerations look like those of a wrong g.",
        "M and C": "Your accelerations look like those of another arm: M is wrong, and C with it.",
    },
    "regressor": {
        "M": "Your Y looks like that of a wrong M.",
        "C": "Your Y looks like that of a wrong C.",
        "g_vec": "Your Y looks like that of a wrong g.",
        "M and C": "Your Y looks like that of another arm: M is wrong, and C with it.",
    },
}


def sentence(mutant: Mutant, mechanism: Outline, answer: Answer) -> str:
    """What to say of a mistake: a teacher's row, the most specific first, or the operator's sentence."""
    rows = [row for row in ROWS if _fits(row, mutant, mechanism, answer)]
    if mutant.source and not any(row.answer == answer.name for row in rows):
        return f"{FOLLOWS[answer.name][mutant.source]} {_of_source(mutant, mechanism)}"
    rows.sort(
        key=lambda row: -sum(len(p.replace("*", "")) for p in (row.term, row.entry, row.mechanism))
    )
    template = rows[0].sentence if rows else _of_operator(mutant)
    words = _words(mutant, mechanism, answer)
    if not words["put_doc"]:  # a combination of parameters has a name alone
        template = template.replace(" ({put_doc})", "")
    if mutant.in_energy and answer.name in DERIVED:
        said = _of_another(template.format(**words | {"where": ENERGIES[answer.name]}))
        return f"Your {answer.head} looks like {DERIVED[answer.name]}. {said}"
    return template.format(**words)


def _of_operator(mutant: Mutant) -> str:
    known = GENERAL if mutant.term else GENERAL | THROUGHOUT
    if is_entry_of_pi(mutant.put) or is_entry_of_pi(mutant.instead_of):
        known = known | (OF_A_TERM if mutant.term else OF_COLUMNS)
    return known[mutant.operator]


def _words(mutant: Mutant, mechanism: Outline, answer: Answer) -> dict[str, str]:
    turning = all(c.unit == "rad" for c in mechanism.coordinates)
    put = {p.name: p for p in mechanism.parameters}.get(mutant.put)
    # On a slope a direction is an angle and a constant, of which only the angle is a student's.
    angle = mutant.instead_of.partition(" + pi/")[0].partition(" - pi/")[0]
    return {
        "where": mutant.entry or answer.head,
        "term": written(mutant.term, mechanism),
        "put": written(entry_of_pi(mutant.put, mechanism), mechanism),
        "instead_of": written(entry_of_pi(angle, mechanism), mechanism),
        "all_of_them": PLURALS.get(mutant.instead_of, "parameters"),
        "put_doc": put.doc if put else "",
        "kind": KINDS.get(put.unit, "parameter") if put else "parameter",
        "right": f"as {answer.unit}" if turning else "right",
        "arm": answer.arguments[-1],
    }


def _of_source(mutant: Mutant, mechanism: Outline) -> str:
    """What is said of the answer in which the mistake was made, of which only this one shows."""
    source = ANSWERS[mutant.source.partition(" ")[0]]
    return _of_another(sentence(replace(mutant, source=""), mechanism, source))


def _of_another(said: str) -> str:
    """What is said of a part of an answer: of this P, which the student may never have written."""
    said = re.sub(r"\byour\b", "this", re.sub(r"\bYour\b", "This", said))
    said = re.sub(r"\b([Tt])his Christoffel symbols\b", r"\1hese Christoffel symbols", said)
    return said.replace("You return ", "You use ", 1)


def _fits(row: Row, mutant: Mutant, mechanism: Outline, answer: Answer) -> bool:
    return row.operator == mutant.operator and all(
        fnmatch.fnmatchcase(value, pattern)
        for value, pattern in (
            (answer.name, row.answer),
            (mechanism.name, row.mechanism),
            (mutant.term, row.term),
            (mutant.entry, row.entry),
        )
    )
