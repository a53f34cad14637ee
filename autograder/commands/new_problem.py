"""Writes a mechanism's problem."""

import argparse
import re
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.saying import complain
from autograder.terminal import say


def add_to(commands) -> None:
    new = commands.add_parser(
        "new-problem",
        help="write the problem of a mechanism, or of checks of your own, to solutions/",
    )
    new.add_argument(
        "mechanism",
        type=argument.mechanism,
        help="its name, such as cart-pole; for a name that is new, its file to fill in is written",
    )
    new.add_argument(
        "--checks",
        action="store_true",
        help="write checks/NAME.py to fill in, for checks or mistakes of your own, without a mechanism",
    )
    new.add_argument(
        "--asks",
        type=argument.answers,
        help="what students write, in this order, with commas between (default: "
        "potential_energy,M,g_vec,C, less what is 0 for every motion)",
    )
    new.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Write a problem to solutions/, or first the file to fill in, of a mechanism or of checks."""
    from autograder.authoring.course import FillInError, NoMechanismError, own
    from autograder.authoring.own_problem import checks_file
    from autograder.authoring.problem import ProblemError, usual_asks, write_problem
    from autograder.mechanisms.file import MechanismFileError

    if given.checks or checks_file(root, given.mechanism).is_file():
        return _of_checks(root, given)
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


def _of_checks(root: Path, given: argparse.Namespace) -> int:
    """Write checks/NAME.py to fill in, or the notebook of the checks that it has."""
    from autograder.authoring.course import own_file
    from autograder.authoring.own_problem import OwnChecksError, write_checks, write_own_problem
    from autograder.authoring.problem import ProblemError

    name = given.mechanism
    if not re.fullmatch("[a-z0-9]+(-[a-z0-9]+)*", name):
        return complain(
            f"a problem's name has small letters, digits and hyphens, as crane-1; not {name!r}"
        )
    if given.asks is not None:
        return complain(
            "--asks is for a mechanism; what is asked here stands in the file of checks"
        )
    try:
        if given.checks:
            unwritten = own_file(root, name).is_file()
            path = write_checks(root, name)
            if unwritten and not own_file(root, name).exists():
                say(f"solutions/{name}/{name}.py, which nobody had filled in, is gone")
            say(f"{path.relative_to(root)}: written, for you to fill in. Then run")
            say(f"  autograder try {name}")
            if not (root / "solutions" / name / f"{name}.ipynb").exists():
                say(f"  autograder new-problem {name}")
            return 0
        path = write_own_problem(root, name)
    except (OwnChecksError, ProblemError, OSError) as error:
        return complain(str(error))
    say(f"{path.relative_to(root)}: written.")
    say("Write its story, its tasks and the model answers, set the points, and try it:")
    say(f"  autograder try {name}")
    say(f"  nbgrader generate_assignment {name}")
    return 0
