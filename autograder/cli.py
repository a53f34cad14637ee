"""The `autograder` command: student notebooks, JupyterLab, grading and reports."""

import argparse
import sys
from pathlib import Path

from autograder import commands
from autograder.commands import try_mechanism
from autograder.commands.saying import complain, of_gradebook
from autograder.entering import why_closed


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand; its exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments[:1] == ["lab"]:
        from autograder.lab import lab  # imports Jupyter, which takes a second

        return lab(arguments[1:])
    parser = argparse.ArgumentParser(prog="autograder", description=__doc__)
    subcommands = parser.add_subparsers(dest="command", required=True)
    subcommands.add_parser(
        "lab",
        help="open JupyterLab on the first lesson; with --instructor, on the whole course; "
        "all other arguments go to JupyterLab",
        add_help=False,
    )
    for command in commands.ALL:
        command.add_to(subcommands)
    given = parser.parse_args(arguments)
    root = Path.cwd()
    if given.run is not try_mechanism.run and not (root / "nbgrader_config.py").exists():
        return complain(
            f"{root} is not the course's folder: it has no nbgrader_config.py; "
            "change to the folder that holds solutions/ and try again"
        )
    if (root / "course").exists() and (why := why_closed(root / "course")):
        return complain(why)
    try:
        return given.run(root, given)
    except Exception as error:
        if said := of_gradebook(error):
            return complain(said)
        raise
