"""The numbers of mistakes: of wrong terms, of wrong entries and of wrong steps."""

from collections.abc import Sequence

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation.answers import Answer
from autograder.mutation.formulas import columns
from autograder.mutation.mutant import Mutant
from autograder.mutation.steps import STEPS, Right
from autograder.mutation.tape import Tape
from autograder.mutation.whole import as_right, count

# What a mistake's numbers are made of: a step's name, or rewritten terms in some of the entries.
Made = str | tuple[list[int], np.ndarray | None]


class Numbers:
    """What the right terms and the rewritten ones contribute to an answer.

    Each mistake is the right answer plus what rewritten terms contribute, less what the right ones do.
    terms: how many right ones there are. of_term: the place of the right one, for each rewritten one.
    tape: from the state to the numbers of the whole mechanism, of the right terms and of the others.

    ValueError where the tape has not as many outputs.
    """

    def __init__(self, mechanism: Outline, answer: Answer, terms: int, of_term, tape: Tape):
        self.mechanism, self.answer, self.terms = mechanism, answer, terms
        self.of_term, self.tape = np.array(of_term, dtype=int), tape
        self._of_whole = count(mechanism.n)
        entries = int(np.prod(answer.shape(mechanism.n)))
        if len(tape.outputs) != self._of_whole + (terms + len(self.of_term)) * entries:
            raise ValueError("the tape is not that of these mistakes")

    def right(self, q, qd, arms) -> np.ndarray:
        """The right answer, (cases, …)."""
        with np.errstate(all="ignore"):  # wrong terms come with them
            return np.sum(self._computed(q, qd, arms)[1], axis=0)

    def of(self, chosen: Sequence[tuple[Mutant, Made]], q, qd, arms) -> np.ndarray:
        """What these mistakes return: (mistakes, cases, …). q, qd: (cases, n); arms: one a case."""
        numbers, own, rewritten = self._computed(q, qd, arms)
        right = np.sum(own, axis=0)
        # Complex where q is, as slopes are taken by complex steps.
        found = np.empty((len(chosen), *right.shape), np.result_type(right, numbers.M))
        changes = rewritten - own[self.of_term]
        alone: list[int] = []
        places: list[int] = []
        masked: list[tuple[int, np.ndarray]] = []
        for i, (_, of) in enumerate(chosen):
            if isinstance(of, str):
                found[i] = STEPS[self.answer.name][of](numbers)
            elif len(of[0]) > 1:
                change = np.sum(changes[of[0]], axis=0)
                found[i] = right + (change if of[1] is None else of[1] * change)
            else:
                alone.append(i)
                places += of[0]
                masked += [] if of[1] is None else [(i, of[1])]
        found[alone] = changes[places]
        if masked:
            at, masks = zip(*masked, strict=True)
            found[list(at)] *= np.array(masks)[:, np.newaxis]
        found[alone] += right
        return found

    def _computed(self, q, qd, arms) -> tuple[Right, np.ndarray, np.ndarray]:
        """All right numbers; what the right terms contribute, and the rewritten ones: (…, cases, *shape)
        each.
        """
        flat = self.tape(columns(self.mechanism, q, qd, arms))
        numbers, flat = flat[: self._of_whole], flat[self._of_whole :]
        shape = self.answer.shape(self.mechanism.n)
        terms = np.moveaxis(flat.reshape(-1, *shape, len(q)), -1, 1)
        return as_right(numbers, qd), terms[: self.terms], terms[self.terms :]
