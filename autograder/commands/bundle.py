"""Writes the archive that a class is given."""

import argparse
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.assignments import name_of, unknown
from autograder.commands.saying import complain
from autograder.terminal import say


def add_to(commands) -> None:
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
    bundling.add_argument(
        "--package",
        action="store_true",
        help="write the student's package alone, for a class server: no lessons, no problems",
    )
    bundling.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Write the archive of these assignments for a class; without any, of all."""
    from autograder.bundle.archive import BundleError, write_bundle
    from autograder.bundle.describing import DescribingError
    from autograder.bundle.shaking import ShakingError
    from autograder.mechanisms.file import MechanismFileError
    from autograder.nbgrader_glue import write_problem

    names = [name_of(assignment) for assignment in given.assignments]
    for name in names:
        if why := unknown(root, name):
            return complain(why)
    try:
        made = write_bundle(root, names, root / given.to, write_problem, given.package)
    except (BundleError, DescribingError, ShakingError, MechanismFileError, OSError) as error:
        return complain(str(error))
    if given.package:
        say(f"{made.path}: written, with the checks of {', '.join(made.assignments)}.")
        say("Install it where students work. It holds no answers to these problems.")
        return 0
    say(f"{made.path}: written, with {', '.join(made.assignments)}.")
    say("Students unpack it and read START-HERE.txt. It holds no answers to these problems.")
    return 0
