"""The `autograder` command: student notebooks, JupyterLab, grading and reports."""

import argparse
import difflib
import os
import sys
from contextlib import AbstractContextManager
from datetime import datetime
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from autograder import arguments as argument
from autograder.terminal import say

if TYPE_CHECKING:
    from autograder.pipeline.recorder import Recorder


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand; its exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    parser = argparse.ArgumentParser(prog="autograder", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("problems", help="write the student notebooks to problems/")
    commands.add_parser(
        "lab",
        help="open JupyterLab on the first lesson; with --instructor, on the whole course; "
        "all other arguments go to JupyterLab",
        add_help=False,
    )
    grading = commands.add_parser(
        "grade", help="grade all submissions of an assignment, and record them in the gradebook"
    )
    grading.add_argument(
        "assignment", type=argument.name, help="its name in solutions/, such as p3-pendulum"
    )
    grading.add_argument(
        "--jobs",
        type=argument.processes,
        default=os.cpu_count(),
        help="number of processes (default: one per core)",
    )
    grading.add_argument(
        "--scheduler",
        type=argument.scheduler,
        metavar="tcp://…",
        help="judge on the Dask cluster at this address",
    )
    grading.add_argument(
        "--force", action="store_true", help="judge every submission again, changed or not"
    )
    reporting = commands.add_parser(
        "report", help="write a page about the class: scores, and who made which mistake"
    )
    reporting.add_argument(
        "assignment",
        nargs="?",
        type=argument.name,
        help="its name in solutions/, such as p1-inertia (default: all of the term)",
    )
    opening = commands.add_parser(
        "open-solution",
        help="let students see an assignment's worked answers with solution(), now or from a time on",
    )
    opening.add_argument(
        "assignment",
        nargs="?",
        type=argument.name,
        help="its name in solutions/ (default: all whose time has come)",
    )
    opening.add_argument(
        "--on",
        type=argument.time,
        metavar="TIME",
        help="from then on, as 2026-12-15 or 2026-12-15T12:00 (default: now)",
    )
    opening.add_argument(
        "--full-marks",
        action="store_true",
        help="on the feedback pages, for each check of which a student has all points",
    )
    trying = commands.add_parser(
        "try",
        help="try the checks of a mechanism: right answers, every mistake, and what students read",
    )
    trying.add_argument(
        "mechanism",
        type=argument.mechanism,
        help="its name, such as cart-pole, or a file with MECHANISM",
    )
    trying.add_argument(
        "--asks", type=argument.answers, help="try these answers alone, as M,C (default: all)"
    )
    trying.add_argument("--all", action="store_true", help="print every mistake's sentence, too")
    trying.add_argument(
        "--names",
        action="store_true",
        help="as --all, with each mistake's name, for sentences of your own",
    )
    trying.add_argument(
        "--to",
        type=argument.new_file,
        metavar="FILE",
        help="write every mistake's sentence to this file",
    )
    trying.add_argument(
        "--every",
        action="store_true",
        help="hand in every mistake in the energies to the real grader, not a few; this takes long",
    )
    new = commands.add_parser(
        "new-problem", help="write the problem of a mechanism to solutions/, ready to be released"
    )
    new.add_argument(
        "mechanism",
        type=argument.mechanism,
        help="its name, such as cart-pole; for a name that is new, its file to fill in is written",
    )
    new.add_argument(
        "--asks",
        type=argument.answers,
        help="what students write, in this order, with commas between (default: "
        "potential_energy,M,g_vec,C, less what is 0 for every motion)",
    )
    bundling = commands.add_parser(
        "bundle", help="write what a class is given: one archive, without answers"
    )
    bundling.add_argument(
        "assignments",
        nargs="*",
        type=argument.name,
        help="their names in solutions/, such as p1-inertia (default: all)",
    )
    bundling.add_argument(
        "--to",
        type=Path,
        default=Path("build"),
        metavar="FOLDER",
        help="where to write it (default: build/)",
    )
    if arguments[:1] == ["lab"]:
        from autograder.lab import lab  # imports Jupyter, which takes a second

        return lab(arguments[1:])
    given = parser.parse_args(arguments)
    if given.command == "try":
        return try_mechanism(Path.cwd(), given)
    root = Path.cwd()
    if not (root / "nbgrader_config.py").exists():
        return _complain(
            f"{root} is not the course's folder: it has no nbgrader_config.py; "
            "change to the folder that holds solutions/ and try again"
        )
    if given.command == "grade":
        return grade(root, given.assignment, given.jobs, given.scheduler, given.force)
    if given.command == "report":
        return report(root, given.assignment)
    if given.command == "open-solution":
        return open_solution(root, given.assignment, given.on, given.full_marks)
    if given.command == "bundle":
        return bundle(root, given.assignments, given.to)
    if given.command == "new-problem":
        return new_problem(root, given.mechanism, given.asks)
    return problems(root)


def grade(root: Path, assignment: str, jobs: int, scheduler: str | None, force: bool) -> int:
    """Grade an assignment's submissions; the exit status is 1 if one could not be graded."""
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.pipeline import run as pipeline

    assignment = _name_of(assignment)
    if why := _unknown(root, assignment):
        return _complain(why)
    try:
        lines = pipeline.grade_all(root, assignment, open_recorder, jobs, scheduler, force)
    except (OSError, ValueError) as error:
        return _complain(str(error))
    except KeyboardInterrupt:
        return _complain("stopped; run the same command again to go on from here", 130)
    if not lines:
        return _complain(f"nobody has handed in {assignment}")
    say(pipeline.table(lines))
    return 0 if all(line.graded for line in lines) else 1


def _name_of(assignment: str) -> str:
    """The assignment's name, also where a shell has completed it to the path of its folder."""
    return Path(assignment).name


def _unknown(root: Path, assignment: str) -> str:
    """Why there is no such assignment, with the names that may be meant; empty if there is one."""
    known = sorted(path.stem for path in (root / "solutions").glob("*/*.ipynb")
                   if path.stem == path.parent.name)  # fmt: skip
    if assignment in known:
        return ""
    near = [name for name in known if assignment and assignment.casefold() in name.casefold()]
    meant = near or difflib.get_close_matches(assignment, known)
    named = f"Did you mean {' or '.join(meant)}?" if meant else f"There are {', '.join(known)}."
    return (
        f"there is no solutions/{assignment}/{assignment}.ipynb. {named if known else ''}".rstrip()
    )


def open_recorder(root: Path, assignment: str) -> "AbstractContextManager[Recorder]":
    """nbgrader's gradebook and folders, for one assignment."""
    from autograder.nbgrader_glue import recorder  # imports nbgrader, which takes seconds

    return recorder.Recorder(root, assignment)


def try_mechanism(root: Path, given: argparse.Namespace) -> int:
    """Try a mechanism's checks; the exit status is 1 if a mistake is not named by its sentence."""
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.authoring.course import NoMechanismError, files_of, found
    from autograder.authoring.leads_on import led_on
    from autograder.authoring.rehearsal import mistaken, rehearsed
    from autograder.files import put_in_place
    from autograder.mechanisms.file import MechanismFileError
    from autograder.mutation.answers import ANSWERS
    from autograder.mutation.trial import Line, Tried, summary, tried

    try:
        mechanism = found(root, given.mechanism)
        files = files_of(root, given.mechanism, mechanism)
    except (NoMechanismError, MechanismFileError) as error:
        return _complain(str(error))
    asked = list(ANSWERS) if given.asks is None else given.asks
    if unknown := [answer for answer in asked if answer not in ANSWERS]:
        return _complain(f"there is no answer {unknown[0]!r}; known are {', '.join(ANSWERS)}")
    made: list[Tried] = []
    shown: list[Line] = []
    parts = (
        led_on(root, mechanism),
        tried(mechanism, asked, given.names, made),
        (line for line in summary(made)),
        rehearsed(mechanism, files, asked),
        mistaken(mechanism, files, asked, given.every),
    )
    for line in chain(*parts):
        shown.append(line)
        if not line.detail:
            say(line.text if line.good else f"! {line.text}")
    every = [line.text if line.good else f"! {line.text}" for line in shown]
    if given.all or given.names:
        say("\n".join(["", "All of it:", *every]))
    if given.to:
        try:
            put_in_place(given.to, "\n".join(every) + "\n")
        except OSError as error:
            return _complain(f"{given.to} cannot be written: {error}")
        say(f"All of it: {given.to}")
    if failed := sum(not line.good for line in shown if not line.detail):
        return _complain(f"{failed} lines, marked with !, are not as they should be", 1)
    return 0


def new_problem(root: Path, name: str, asks: list[str] | None) -> int:
    """Write a mechanism's problem to solutions/, or first the file of a new mechanism."""
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.authoring.course import FillInError, NoMechanismError, own
    from autograder.authoring.problem import ProblemError, usual_asks, write_problem
    from autograder.mechanisms.file import MechanismFileError

    try:
        mechanism = own(root, name)
        asked = usual_asks(mechanism) if asks is None else asks
        path = write_problem(root, mechanism, asked)
    except FillInError as error:
        say(str(error))
        return 0
    except (NoMechanismError, MechanismFileError, ProblemError) as error:
        return _complain(str(error))
    say(f"{path.relative_to(root)}: written; it asks for {', '.join(asked)}.")
    say("Read it, write the story at its top, and try it:")
    say(f"  autograder try {mechanism.name}")
    say(f"  nbgrader generate_assignment {mechanism.name}")
    return 0


def bundle(root: Path, assignments: list[str], to: Path) -> int:
    """Write the archive of these assignments for a class; without any, of all."""
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.bundle.archive import BundleError, write_bundle
    from autograder.bundle.describing import DescribingError
    from autograder.bundle.shaking import ShakingError
    from autograder.mechanisms.file import MechanismFileError
    from autograder.nbgrader_glue import write_problem

    names = [_name_of(assignment) for assignment in assignments]
    for name in names:
        if why := _unknown(root, name):
            return _complain(why)
    try:
        made = write_bundle(root, names, root / to, write_problem)
    except (BundleError, DescribingError, ShakingError, MechanismFileError, OSError) as error:
        return _complain(str(error))
    say(f"{made.path}: written, with {', '.join(made.assignments)}.")
    say("Students unpack it and read START-HERE.txt. It holds no answers to these problems.")
    return 0


def report(root: Path, assignment: str | None) -> int:
    """Write the report on a class to course/report/, and a summary to the terminal.

    assignment: None for all of the term.
    """
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.files import put_in_place
    from autograder.nbgrader_glue.class_list import read_class, read_term
    from autograder.report import page, summary, term_page, term_summary

    name = "term" if assignment is None else _name_of(assignment)
    try:
        if assignment is None:
            classes, left_out = read_term(root)
            for why in left_out:
                say(f"left out: {why}")
            if not classes:
                return _complain("nobody has handed in anything")
            said, written = term_summary(classes), term_page(classes)
        else:
            of = read_class(root, name)
            if not of.students:
                return _complain(f"nobody has handed in {name}")
            said, written = summary(of.most, of.students), page(name, of.most, of.students)
        to = root / "course" / "report" / f"{name}.html"
        to.parent.mkdir(exist_ok=True)
        put_in_place(to, written)
    except (OSError, ValueError) as error:
        why = "" if assignment is None else _unknown(root, name)
        return _complain(why or str(error))
    say(said)
    say(f"The whole page: {to.relative_to(root)}")
    return 0


def open_solution(root: Path, assignment: str | None, on: datetime | None, full_marks: bool) -> int:
    """Open an assignment's worked answers to students; without a name, all whose time has come."""
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.nbgrader_glue.worked import open_answers, settings
    from autograder.worked_answers import FULL_MARKS

    if on is not None and full_marks:
        return _complain("give --on or --full-marks, not both")
    if assignment is None and (on is not None or full_marks):
        return _complain("name the assignment whose answers open then")
    if assignment is not None and (why := _unknown(root, _name_of(assignment))):
        return _complain(why)
    when = FULL_MARKS if full_marks else (on or datetime.now()).isoformat()
    asked = settings(root) if assignment is None else {_name_of(assignment): when}
    try:
        for line in open_answers(root, asked):
            say(line)
    except (OSError, ValueError) as error:
        return _complain(str(error))
    return 0


def problems(root: Path) -> int:
    """Write the student notebooks that are not there yet; root: the course's folder."""
    for source in sorted((root / "solutions").glob("*/*.ipynb")):
        folder = root / "problems" / source.parent.name
        shown = (folder / source.name).relative_to(root)
        if (folder / source.name).exists():
            say(f"{shown}: kept, as it may hold your work; move it away to get a new one")
            continue
        from autograder.nbgrader_glue import write_problem  # imports nbgrader, which takes seconds

        write_problem(root, source.parent.name, folder)
        say(f"{shown}: written")
    return _tell_jupyter()


def _tell_jupyter() -> int:
    """Let plain `jupyter lab` find the course too; 0 even if it cannot."""
    from autograder import lab_server  # imports Jupyter

    try:
        lab_server.enable()
    except OSError as error:
        _complain(
            f"plain `jupyter lab` will not find the course ({error}); use `autograder lab` instead"
        )
    return 0


def _complain(what: str, status: int = 2) -> int:
    say(f"autograder: {what}", sys.stderr)
    return status
