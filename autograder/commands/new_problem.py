"""Writes a mechanism's problem."""

import argparse
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.saying import complain
from autograder.terminal import say


def add_to(commands) -> None:
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
    new.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Write a mechanism's problem to solutions/, or first the file of a new mechanism."""
    from autograder import lean  # noqa: F401  before nbformat is imported
    from autograder.authoring.course import FillInError, NoMechanismError, own
    from autograder.authoring.problem import ProblemError, usual_asks, write_problem
    from autograder.mechanisms.file import MechanismFileError

    try:
        mechanism = own(root, given.mechanism)
        asked = usual_asks(mechanism) if given.asks is None else given.asks
        path = write_problem(root, mechanism, asked)
    except FillInError as error:
        say(str(error))
        return 0
    except (NoMechanismError, MechanismFileError, ProblemError) as error:
        return complain(str(error))
    say(f"{path.relative_to(root)}: written; it asks for {', '.join(asked)}.")
    say("Read it, write the story at its top, and try it:")
    say(f"  autograder try {mechanism.name}")
    say(f"  nbgrader generate_assignment {mechanism.name}")
    return 0
