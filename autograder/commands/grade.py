"""Grades all submissions of an assignment."""

import argparse
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING

from autograder import arguments as argument
from autograder import processors
from autograder.commands.assignments import name_of, unknown
from autograder.commands.saying import complain
from autograder.terminal import say

if TYPE_CHECKING:
    from autograder.pipeline.recorder import Recorder


def add_to(commands) -> None:
    grading = commands.add_parser(
        "grade", help="grade all submissions of an assignment, and record them in the gradebook"
    )
    grading.add_argument(
        "assignment", type=argument.name, help="its name in solutions/, such as p3-pendulum"
    )
    grading.add_argument(
        "--jobs",
        type=argument.processes,
        default=processors.usable(),
        help="number of processes (default: one per processor that this machine or container may use)",
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
    grading.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Grade an assignment's submissions; the exit status is 1 if one could not be graded."""
    from autograder.pipeline import run as pipeline

    assignment = name_of(given.assignment)
    if why := unknown(root, assignment):
        return complain(why)
    try:
        lines = pipeline.grade_all(
            root, assignment, open_recorder, given.jobs, given.scheduler, given.force
        )
    except (OSError, ValueError) as error:
        return complain(str(error))
    except KeyboardInterrupt:
        return complain("stopped; run the same command again to go on from here", 130)
    if not lines:
        return complain(f"nobody has handed in {assignment}")
    say(pipeline.table(lines))
    return 0 if all(line.graded for line in lines) else 1


def open_recorder(root: Path, assignment: str) -> "AbstractContextManager[Recorder]":
    """nbgrader's gradebook and folders, for one assignment."""
    from autograder.nbgrader_glue import recorder  # imports nbgrader, which takes seconds

    return recorder.Recorder(root, assignment)
