"""Tries a problem's own checks: right answers, every mistake, and the notebook in the real grader."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import nbformat
import numpy as np

from autograder.judging.check import HIDDEN_CASES, Check
from autograder.judging.diagnosis import Mistake
from autograder.judging.loops import Loop
from autograder.judging.models import evaluated
from autograder.judging.verdict import State, Verdict
from autograder.mutation.trial import Line
from autograder.notebook.beside import Beside
from autograder.notebook.grade import grade, is_judged
from autograder.notebook.recognise import grade_id
from autograder.problems import check_for, own_checks
from autograder.protocol import Call, Reply, answer_all

SEEDS = range(20)


def tried(root: Path, name: str, text: str) -> Iterator[Line]:
    """Line by line: each check of checks/NAME.py with its right answer and its mistakes, and what the
    grader says of the model answers in solutions/NAME. OwnChecksError where the file is broken.
    """
    shown = f"{own_checks.FOLDER}/{name}.py"
    files = {shown: text}
    own = own_checks.read(text, shown)
    path = root / "solutions" / name / f"{name}.ipynb"
    source = nbformat.read(path, as_version=4) if path.is_file() else None
    asked = [grade_id(cell) for cell in source.cells if is_judged(cell)] if source else []
    for id in [*own.checks, *(id for id in own.mistakes if id not in own.checks)]:
        check = check_for(id, None, files)
        if check is None:
            yield Line(f"{shown}: there is no check {id!r} to which mistakes could be added", False)
            continue
        added = own.mistakes.get(id, ())
        yield from _of(check, added or check.mistakes)
        if source is not None and id not in asked:
            yield Line(f"  no grade cell of {_shown(root, path)} has the grade_id {id}", False)
    if source is None:
        yield Line(
            f"{_shown(root, path)} is not there yet: `autograder new-problem {name}` writes it"
        )
        return
    of_source = own_checks.files_of(path.parent)
    yield from _handed_in(name, source, of_source | files)


def _of(check: Check, mistakes: tuple[Mistake, ...]) -> Iterator[Line]:
    """The right answer with many random numbers, then each mistake."""
    said = [_judged(check, check.reference, seed) for seed in SEEDS]
    lost = next((verdict for verdict in said if verdict.state is not State.CORRECT), None)
    if lost is not None:
        yield Line(f"{check.id}: its own reference is not right:\n{lost}", False)
        return
    named = 0
    wrong: list[Line] = []
    for mistake in mistakes:
        verdict = _judged(check, mistake.wrong, SEEDS[0])
        if verdict.diagnosis == (mistake.sentence,) and verdict.state is not State.CORRECT:
            named += 1
            continue
        got = " ".join(verdict.diagnosis) or verdict.problem or "nothing more"
        wrong.append(Line(f"  {mistake.name}: {verdict.state}, and the card says: {got}", False))
    yield Line(f"{check.id}: right answers pass; {named} of {len(mistakes)} mistakes are named")
    yield from wrong


def _judged(check: Check, model, seed: int) -> Verdict:
    """The verdict on the numbers of a model, as if a student had handed it in."""

    def ask(calls: list[Call]) -> list[Reply]:
        if any(isinstance(call, Loop) for call in calls):
            return answer_all(calls, {check.name: model})
        return [Reply(value=np.asarray(value)) for value in evaluated(model, calls)]

    return check.run(ask, np.random.default_rng(seed), HIDDEN_CASES)


def _handed_in(
    name: str, source: nbformat.NotebookNode, files: Mapping[str, str]
) -> Iterator[Line]:
    graded = grade(source, source, "rehearsal", Beside(mechanisms=files))
    lost = [str(v) for v in graded.verdicts.values() if v.state is not State.CORRECT]
    said = "full points" if not lost else "not full points"
    yield Line(
        "\n".join([f"{name}, its model answers handed in and graded: {said}", *lost]), not lost
    )


def _shown(root: Path, path: Path) -> str:
    return path.relative_to(root).as_posix()
