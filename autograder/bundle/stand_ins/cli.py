"""The `autograder` command of a student's package: it opens JupyterLab."""

import argparse
import sys


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand; its exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    parser = argparse.ArgumentParser(prog="autograder", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser(
        "lab",
        help="open the course in JupyterLab; where it is not in this folder yet, it is written to "
        "armdyn/ first; all arguments go to JupyterLab",
        add_help=False,
    )
    if arguments[:1] == ["lab"]:
        from autograder.lab import lab  # imports Jupyter, which takes a second

        return lab(arguments[1:])
    parser.parse_args(arguments)
    return 0
