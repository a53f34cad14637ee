"""Writes a page about the class."""

import argparse
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.assignments import name_of, unknown
from autograder.commands.saying import complain
from autograder.terminal import say, shown_note


def add_to(commands) -> None:
    reporting = commands.add_parser(
        "report", help="write a page about the class: scores, and who made which mistake"
    )
    reporting.add_argument(
        "assignment",
        nargs="?",
        type=argument.name,
        help="its name in solutions/, such as p1-inertia (default: all of the term)",
    )
    reporting.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Write the report on a class, or on the term, to course/report/, and a summary to the terminal."""
    from autograder.files import put_in_place
    from autograder.nbgrader_glue.class_list import read_class, read_term
    from autograder.nbgrader_glue.late import settle_course
    from autograder.report import page, summary, term_page, term_summary

    assignment: str | None = given.assignment
    name = "term" if assignment is None else name_of(assignment)
    try:
        for line in settle_course(root):
            say(shown_note(line))
        if assignment is None:
            classes, left_out = read_term(root)
            for why in left_out:
                say(f"left out: {why}")
            if not classes:
                return complain("nobody has handed in anything")
            said, written = term_summary(classes), term_page(classes)
        else:
            of = read_class(root, name)
            if not of.students:
                return complain(f"nobody has handed in {name}")
            said, written = summary(of), page(of)
        to = root / "course" / "report" / f"{name}.html"
        to.parent.mkdir(exist_ok=True)
        put_in_place(to, written)
    except (OSError, ValueError) as error:
        why = "" if assignment is None else unknown(root, name)
        return complain(why or str(error))
    say(said)
    say(f"The whole page: {to.relative_to(root)}")
    return 0
