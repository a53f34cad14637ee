"""The `autograder` command."""

import argparse
import sys
from pathlib import Path


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand; its exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    parser = argparse.ArgumentParser(prog="autograder", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("problems", help="write the student notebooks to problems/")
    commands.add_parser(
        "lab",
        help="open JupyterLab on the first lesson; further arguments go to JupyterLab",
        add_help=False,
    )
    if arguments[:1] == ["lab"]:
        from autograder.lab import lab  # imports Jupyter, which takes a second

        return lab(arguments[1:])
    parser.parse_args(arguments)
    return problems()


def problems() -> int:
    """Write the student notebooks that are not there yet, from the course's folder."""
    root = Path.cwd()
    if not (root / "nbgrader_config.py").exists():
        print(
            f"autograder: {root} is not the course's folder (no nbgrader_config.py); "
            "change to the folder that holds solutions/ and try again",
            file=sys.stderr,
        )
        return 2
    for source in sorted((root / "solutions").glob("*/*.ipynb")):
        folder = root / "problems" / source.parent.name
        shown = (folder / source.name).relative_to(root)
        if (folder / source.name).exists():
            print(f"{shown}: kept as it is, it is yours; move it away for a new one")
            continue
        from autograder.nbgrader_glue import write_problem  # imports nbgrader, which takes seconds

        write_problem(root, source.parent.name, folder)
        print(f"{shown}: written")
    return 0
