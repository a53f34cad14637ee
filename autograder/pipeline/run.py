"""Grades many submissions: judges them side by side, keeps the results, and records them one by one.

`grade` is a pure function, so any executor can run it: processes here, or a Dask cluster. Each result
is in the cache before it is recorded, so that a killed run can go on where it was.
"""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from pathlib import Path

from tqdm import tqdm

from autograder.busy import BusyError
from autograder.digest import digest
from autograder.pipeline.alike import alike
from autograder.pipeline.cache import Cache, code_version
from autograder.pipeline.executors import Cluster, Processes, outcomes
from autograder.pipeline.lock import locked
from autograder.pipeline.recorder import Recorder, Standing
from autograder.pipeline.soundness import refuse_unsound
from autograder.pipeline.worker import judge, load
from autograder.protocol import one_line
from autograder.sandbox.room import share
from autograder.sandbox.ways import use_shared
from autograder.terminal import shown_name, shown_note, shown_points

CACHE = Path("course") / "cache-of-results"
LOCK = Path("course") / "grading.lock"
AGAIN = "so the next run judges this notebook again; fewer --jobs leave each more time"
PRELOAD = ("autograder.pipeline.worker",)


@dataclass(frozen=True)
class Line:
    """One student's line of the summary: points, states in words, and notes for the instructor.

    graded: False if a cell has no verdict; the notes say why. redone: whether anything had to be judged
    or recorded.
    """

    student: str
    score: float | None = None
    most: float | None = None
    states: str = ""
    notes: tuple[str, ...] = ()
    graded: bool = True
    redone: bool = True


class OtherVersionError(Exception):
    """A worker of the cluster has other code than this machine."""


def grade_all(
    root: Path,
    assignment: str,
    open_recorder: Callable[[Path, str], AbstractContextManager[Recorder]],
    jobs: int = 2,
    scheduler: str | None = None,
    force: bool = False,
) -> list[Line]:
    """Grade each submission of an assignment and record it; a line for each student, in order.

    open_recorder(root, assignment): opens the recorder, while the processes that judge get ready.
    jobs: the number of these processes. scheduler: the address of a Dask cluster that judges instead.
    force: judge again what is in the cache. ValueError if the assignment cannot be graded at all,
    BlockingIOError while another run is grading.
    """
    with (
        locked(root / LOCK, f"another `autograder grade` is running in {root}"),
        Cluster(scheduler) if scheduler else Processes(jobs, PRELOAD, share, use_shared) as pool,
    ):
        if force or not (root / CACHE / _done(assignment, "anybody")).parent.exists():
            pool.warm(load)
        with open_recorder(root, assignment) as recorder:
            refuse_unsound(recorder, Cache(root / CACHE))
            return _Run(root, recorder, pool, force).lines()


class _Run:
    """One pass over an assignment's submissions."""

    def __init__(self, root: Path, recorder: Recorder, pool, force: bool):
        self._cache = Cache(root / CACHE)
        self._recorder, self._pool, self._force = recorder, pool, force
        self._submissions = recorder.submissions()
        self._standings = recorder.standings()
        # What decides every result; the rest is the submission's own.
        self._common = digest(
            *(recorder.source, *recorder.earlier, recorder.settings, str(recorder.carried_on)),
            code_version(),
        )
        self._keys: dict[str, str] = {}
        self._lines: dict[str, Line] = {}
        self._uncertain: set[str] = set()

    def lines(self) -> list[Line]:
        with _bar(len(self._submissions)) as bar:
            for student, outcome in outcomes(judge, self._tasks(), self._pool):
                self._settle(student, outcome)
                bar.update(len(self._lines) - bar.n)
            self._judge_again()
            bar.update(len(self._lines) - bar.n)
        for student, others in alike(self._lines).items():
            note = f"looks like {', '.join(map(ascii, others))}: do these folders belong to one student?"
            line = self._lines[student]
            self._lines[student] = replace(line, notes=(*line.notes, note))
        return [self._lines[student] for student in self._submissions]

    def _judge_again(self) -> None:
        """Judge again, one at a time, what a clock had stopped while others were judged beside it."""
        for student in sorted(self._uncertain):
            task = self._task(student)
            if task is not None:
                for _, outcome in outcomes(judge, [(student, task)], self._pool):
                    self._settle(student, outcome)

    def _tasks(self) -> Iterator[tuple[str, tuple]]:
        """The submissions that have to be judged; the others are settled on the way."""
        for student in self._submissions:
            try:
                why = self._recorder.refusal(student)
                if why:
                    self._refuse(student, why)
                    continue
                task = self._task(student)
            except FileNotFoundError as error:
                self._refuse(student, str(error))
            except BusyError:
                raise
            except Exception as error:
                self._fail(student, error)
            else:
                if task:
                    yield student, task

    def _task(self, student: str) -> tuple | None:
        """The arguments of `judge`; None if there is nothing to judge."""
        recorder = self._recorder
        path, notes = recorder.counted(student)
        self._submissions[student] = path
        content, seed = path.read_bytes(), recorder.seed_of(student)
        beside = recorder.laid_in(student)
        key = digest(content, seed, beside.digest(), *notes, self._common)
        self._keys[student] = key
        if not self._force:
            if self._unchanged(student, key):
                return None
            known = self._cache.load(_result(key))
            if known:
                self._settle(student, known, new=False)
                return None
        given = content, recorder.source, seed, beside, tuple(notes), student
        return *given, recorder.earlier, recorder.carried_on

    def _unchanged(self, student: str, key: str) -> bool:
        """Whether this very submission was recorded, and its rows and files are still there."""
        recorder, standing = self._recorder, self._standings.get(student)
        done = self._cache.load(_done(recorder.assignment, student))
        path = recorder.autograded(student)
        if not (done and standing and done.get("key") == key and path.is_file()):
            return False
        now = self._state(student, standing)
        if now != {name: done.get(name) for name in now}:
            return False
        self._note(student, done["states"], done["notes"], standing, redone=False)
        return True

    def _state(self, student: str, standing: Standing) -> dict[str, str]:
        """What grading this submission left, so that a later run recognises it."""
        return {
            "key": self._keys[student],
            "files": digest(self._recorder.files_of(student)),
            "rows": digest(standing.rows),
            "notebook": digest(self._recorder.autograded(student).read_bytes()),
        }

    def _settle(self, student: str, outcome: dict | Exception, new: bool = True) -> None:
        """Keep the result, and record it."""
        recorder = self._recorder
        try:
            if isinstance(outcome, Exception):
                raise outcome
            if outcome["code"] != code_version():
                raise OtherVersionError("a worker of the cluster has another version of the course")
            if "refused" in outcome:
                path = self._submissions[student]
                self._refuse(student, _unreadable(path, outcome["refused"]))
                return
            names = ("graded", "certain", "states", "notes")
            graded, certain, states, notes = (outcome[name] for name in names)
            if not certain and graded:
                notes = [*notes, AGAIN]
                self._uncertain.add(student)
            if certain and new:
                self._cache.store(_result(self._keys[student]), outcome)
            standing = recorder.record(student, outcome["notebook"])
            if certain:
                entry = self._state(student, standing) | {"states": states, "notes": notes}
                self._cache.store(_done(recorder.assignment, student), entry)
        except BusyError:
            raise
        except Exception as error:
            self._fail(student, error)
        else:
            self._note(student, states, notes, standing, graded=graded)

    def _fail(self, student: str, error: Exception) -> None:
        """Note an error that is not the submission's fault; what was recorded before stays."""
        self._recorder.forget()
        why = f"{type(error).__name__}: {one_line(str(error))}"
        if self._recorder.autograded(student).exists():
            why = f"{why}; the earlier result stays"
        self._lines[student] = Line(student, notes=(why,), graded=False)

    def _refuse(self, student: str, why: str) -> None:
        """Note a submission that cannot be graded as it is, and remove an earlier graded notebook."""
        try:
            self._recorder.refuse(student)
        except BusyError:
            raise
        except Exception as error:
            self._recorder.forget()
            why = f"{why}; {type(error).__name__}: {one_line(str(error))}"
        self._lines[student] = Line(student, notes=(why,), graded=False)

    def _note(self, student, states, notes, standing, **more) -> None:
        counts = [f"{count} {state}" for state, count in Counter(states).items()]
        if standing.to_read:
            counts.append(f"{standing.to_read} to be read")
        if standing.late:
            counts.append(standing.late)
        self._lines[student] = Line(
            student,
            standing.score,
            self._recorder.max_score,
            ", ".join(counts),
            tuple(notes),
            **more,
        )


def kept_about(root: Path, student: str) -> list[Path]:
    """The files of the cache about a student, and all results that are nobody else's."""
    folder = root / CACHE
    mine = sorted(folder.glob(f"recorded/*/{digest(student)}.json"))
    others = {
        str(json.loads(done.read_text(encoding="utf-8")).get("key"))
        for done in folder.glob("recorded/*/*.json")
        if done not in mine
    }
    results = sorted(folder.glob("results/*/*.json")) if mine else []
    return [*mine, *(path for path in results if path.stem not in others)]


def table(lines: list[Line]) -> str:
    """The lines as a table: student, score, states, notes."""
    rows = [("student", "score", "states", "notes")]
    for line in lines:
        score = ""
        if line.score is not None and line.most is not None:
            score = f"{shown_points(line.score)} of {shown_points(line.most)}"
        states = line.states or "could not be graded"
        first, *others = [shown_note(note) for note in line.notes] or [""]
        rows.append((shown_name(line.student), score, states, first))
        rows += [("", "", "", note) for note in others]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    shown = "\n".join(
        "  ".join([*(cell.ljust(width) for cell, width in zip(row, widths, strict=False)), row[3]])
        .rstrip()
        for row in rows
    )  # fmt: skip
    redone = sum(line.redone and line.graded for line in lines)
    unchanged = sum(not line.redone for line in lines)
    failed = sum(not line.graded for line in lines)
    tail = f"{redone} graded, {unchanged} unchanged"
    return f"{shown}\n\n{tail}" + (f", {failed} could not be graded" if failed else "")


def _bar(total: int):
    """A progress bar, if stderr is a terminal."""
    return tqdm(total=total, unit="notebook", disable=None, leave=False)


def _unreadable(path: Path, why: str) -> str:
    return f"{path.name} {one_line(why)}"


def _result(key: str) -> str:
    return f"results/{key[:2]}/{key}"


def _done(assignment: str, student: str) -> str:
    return f"recorded/{assignment}/{digest(student)}"
