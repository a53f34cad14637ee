"""Removes a student who has left the course."""

import argparse
from pathlib import Path

from autograder.commands.saying import agreed, complain
from autograder.terminal import say, shown_name, shown_note


def add_to(commands) -> None:
    forgetting = commands.add_parser(
        "forget", help="remove all that the course keeps about a student who has left it"
    )
    forgetting.add_argument("student", metavar="ID", help="the name of the student's folder")
    forgetting.add_argument("--yes", action="store_true", help="do not ask first")
    forgetting.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Remove a student from the course, after asking; the exit status is 1 if nothing was removed."""
    from autograder import roster
    from autograder.nbgrader_glue.forget import known, person, traces
    from autograder.nbgrader_glue.mentions import Called, mentions
    from autograder.pipeline import run as pipeline
    from autograder.pipeline.lock import locked

    student = given.student
    if roster.UNFIT_ID.search(student) or not student.strip():
        return complain(f"{student[:60]!r} is no student's id")
    shown = shown_name(student)
    try:
        with locked(root / pipeline.LOCK, f"`autograder grade` is running in {root}"):
            ids = known(root)
            near = sorted(one for one in ids - {student} if one.casefold() == student.casefold())
            if near and student not in ids:
                # Pages may hold the word all the same, as a name.
                meant = " or ".join(map(shown_name, near))
                return complain(f"there is no student {shown}. Did you mean {meant}?", 1)
            found = traces(root, student, pipeline.kept_about(root, student))
            if not found:
                return complain(f"the course keeps nothing about {shown}", 1)
            say(f"Kept about {shown}:")
            for trace in found:
                say(f"  {shown_note(trace.what)}")
            for path in mentions(root, Called(person(root, student))):
                say(f"  {path.relative_to(root)} names the student, too, and will be left as it is")
            if not given.yes and not agreed("Remove all of it? It cannot be undone. [y/N] "):
                return complain("nothing was removed", 1)
            for trace in found:
                trace.remove()
    except (OSError, ValueError) as error:
        return complain(str(error))
    say("Removed. Copies that you made elsewhere, and what the student fetched, are still there.")
    return 0
