"""Grades one notebook: `grade` runs its cells and judges its functions, and keeps nothing."""

import hashlib
import logging
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from nbformat import NotebookNode

from autograder.digest import digest
from autograder.judging.carried.judge import Carrying
from autograder.judging.check import HIDDEN_CASES
from autograder.judging.verdict import State, Verdict
from autograder.notebook import examples, outputs
from autograder.notebook.beside import Beside
from autograder.notebook.editions import Edition
from autograder.notebook.own_arm import drawn_for
from autograder.notebook.plain_tests import Outcome, by_value, checks_called, plain_test, with_test
from autograder.notebook.recognise import grade_id, known_cells
from autograder.notebook.released import essence, is_as_released
from autograder.notebook.repair import repair
from autograder.notebook.sitting import Sitting
from autograder.problems import check_for, own_checks
from autograder.proofs import derivation_of, mark
from autograder.proofs.marks import Marked
from autograder.protocol import Call, Reply
from autograder.sandbox.room import Room
from autograder.terminal import shown_name, shown_note

log = logging.getLogger(__name__)

NOTHING = Beside()
# Of the points of an answer that follows from a wrong one, where a course chooses nothing else.
CARRIED_ON = 0.5
UNCERTAIN = "a clock and not the limit on processor time stopped"
MOST_NAMED = 3


@dataclass(frozen=True)
class Graded:
    """A judged notebook: its cells with the outputs of this run, a verdict for each grade cell by
    grade_id, and notes for the instructor on what was put right. marks: the marked derivations of
    each answer that a person reads, by its grade_id. uncertain: whether a clock ended something, and not
    the limit on processor time; on a machine with more time, the verdicts may be others.
    """

    notebook: NotebookNode
    verdicts: dict[str, Verdict]
    notes: tuple[str, ...]
    marks: dict[str, list[Marked]] = field(default_factory=dict)
    uncertain: bool = False


def grade(
    submission: NotebookNode,
    source: NotebookNode,
    seed: str,
    beside: Beside = NOTHING,
    said: tuple[str, ...] = (),
    student: str | None = None,
    earlier: Sequence[Edition] = (),
    carried_on: float = CARRIED_ON,
) -> Graded:
    """Run the submission's cells in a sandbox and judge its graded functions outside.

    beside: files that its cells find. said: notes that come first. student: whose submission it is,
    where the problem gives each student an own arm; None for the arm of the book. earlier: editions
    of the problem that the student may have, the newest first. carried_on: the share of the points that
    an error gives which is only carried on, in [0, 1].
    seed: decides the random cases, together with the code of the repaired notebook and the files
    beside it. So the same submission gets the same verdicts again, and a changed one meets other
    cases. Each check has its own random numbers, so that a new problem changes no other's cases. What
    stands in a grade cell beside its check runs in the sandbox too, and an error there costs the cell's
    points; a grade cell without a check is graded by that alone. If a sandbox is lost and the notebook
    is not to blame, it is graded once more. OSError if that happens again, or if no sandbox starts.
    """
    try:
        return _graded(submission, source, seed, beside, said, student, earlier, carried_on)
    except OSError as error:
        log.warning("%s; grading the notebook once more", shown_note(str(error)))
        return _graded(submission, source, seed, beside, said, student, earlier, carried_on)


def _graded(submission, source, seed, beside, said, student, earlier, carried_on) -> Graded:
    notebook, notes = repair(submission, source, said, beside.documents, earlier)
    verdicts: dict[str, Verdict] = {}
    marks: dict[str, list[Marked]] = {}
    seed = of_content(seed, notebook, beside)
    allowance = outputs.Allowance()
    drawn = drawn_for(source, student)
    notes += own_checks.broken(beside.mechanisms)
    with Sitting(partial(Room.loaded, files=beside.laid)) as sitting:
        if drawn is not None:
            sitting.run(drawn.prelude)
            notes += filter(None, [drawn.apart(submission)])
        if laid := examples.prelude(notebook, drawn.own if drawn else None, beside.mechanisms):
            sitting.run(laid)

        ask = _Asking(sitting, beside)

        def tested(text: str) -> Outcome:
            return Outcome.read(sitting.run(text, is_students=False), beside) if text else Outcome()

        def check_known(id):
            return check_for(id, drawn.own if drawn else None, beside.mechanisms)

        known, given, answers = known_cells(source), _essences(source), []
        for cell in notebook.cells:
            if cell.cell_type != "code":
                continue
            if cell.metadata.get("nbgrader", {}).get("solution"):
                answers.append(cell)
            cell.outputs, cell.execution_count = [], None
            if not is_judged(cell):
                cell.outputs = allowance.shown(sitting.run(cell.source, own=_is_own(cell, given)))
                cell.outputs += _explanations(cell.outputs, beside)
                if drawn is not None and grade_id(cell) == drawn.set_up.cell:
                    cell.outputs.append(drawn.shown)
                if derivation := derivation_of(grade_id(cell) or ""):
                    # Nothing else: what a cell prints may look like the card.
                    cell.outputs = [out for out in cell.outputs if out.output_type == "error"]
                    handed_in = sitting.lines_of(derivation.id)
                    marked = mark(derivation, handed_in, stream(seed, derivation.id))
                    cell.outputs.append(outputs.of_marks(marked))
                    marks.setdefault(derivation.cell, []).append(marked)
                continue
            name = grade_id(cell) or ""
            try:
                check = check_known(name)
                problem = ""
            except ValueError as error:  # a broken file of the course's own mechanism
                check, problem = None, str(error)
            if check is not None:
                states = {id: judged.state for id, judged in verdicts.items()}
                carrying = Carrying(check_known, carried_on, states, sitting.seconds)
                verdict = check.run(ask, stream(seed, name), HIDDEN_CASES, carrying)
                verdict = sitting.naming_an_earlier(check, verdict)
                done = tested(plain_test(cell.source, name))
                verdict = with_test(verdict, done)
            elif problem or checks_called(cell, source):
                problem = problem or f"No check belongs to the grade cell {name}."
                verdict, done = Verdict(name, State.CHECK_FAILED, problem=problem), Outcome()
            else:
                done = tested(cell.source)
                blank = [is_as_released(own, known.get(grade_id(own) or "")) for own in answers]
                points = float(cell.metadata["nbgrader"]["points"])
                verdict, note = by_value(name, points, done, bool(blank) and all(blank))
                notes += filter(None, [note])
            cell.outputs, answers = allowance.shown(list(done.shown)), []
            if verdict.state is State.CHECK_FAILED:
                log.error("%s: %s", shown_name(name), shown_note(verdict.problem))
                notes.append(f"{name} could not be judged: {verdict.problem}")
            verdicts[name] = verdict.returned()
    if sitting.uncertain:
        what = ", ".join(sitting.uncertain[:MOST_NAMED])
        notes.append(f"{UNCERTAIN} {what}{' …' if len(sitting.uncertain) > MOST_NAMED else ''}")
    return Graded(notebook, verdicts, tuple(notes), marks, bool(sitting.uncertain))


class _Asking:
    """Asks a sitting; `seconds` is the processor time of the notebook so far."""

    def __init__(self, sitting: Sitting, beside: Beside):
        self._sitting, self._beside = sitting, beside

    def __call__(self, calls: list[Call]) -> list[Reply]:
        return [self._beside.explained(reply) for reply in self._sitting.ask(calls)]

    def seconds(self) -> float:
        return self._sitting.seconds()


def _essences(source: NotebookNode) -> set[str]:
    return {essence(cell.source) for cell in source.cells} | set(known_cells(source))


def _is_own(cell: NotebookNode, given: set[str]) -> bool:
    """Whether a cell is neither one of the source's graded cells nor the same as another of its."""
    return grade_id(cell) not in given and essence(cell.source) not in given


def _explanations(shown, beside) -> list[NotebookNode]:
    """Lines below an error that names a file, which say why it is not there."""
    errors = (f"{out.ename}: {out.evalue}" for out in shown if out.output_type == "error")
    return [outputs.stream("stderr", f"{why}\n") for why in map(beside.explanation, errors) if why]


def is_judged(cell: NotebookNode) -> bool:
    """Whether a check grades the cell: it is then not run, and no person reads it."""
    claims = cell.metadata.get("nbgrader") or {}
    return cell.cell_type == "code" and bool(claims.get("grade")) and not claims.get("solution")


def of_content(seed: str, notebook: NotebookNode, beside: Beside = NOTHING) -> str:
    """The seed for this code and the files beside it: other code or files get other cases, other text
    does not.
    """
    code = (cell.source for cell in notebook.cells if cell.cell_type == "code")
    return digest(seed, beside.digest(), *code)


def stream(seed: str, name: str) -> np.random.Generator:
    """The random numbers of one check, from the seed."""
    digest = hashlib.sha256(f"{seed}\0{name}".encode()).digest()
    return np.random.default_rng(np.frombuffer(digest, dtype=np.uint32))
