"""Writes the student notebooks."""

import argparse
from pathlib import Path

from autograder.commands.saying import complain
from autograder.terminal import say


def add_to(commands) -> None:
    writing = commands.add_parser("problems", help="write the student notebooks to problems/")
    writing.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
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
        complain(
            f"plain `jupyter lab` will not find the course ({error}); use `autograder lab` instead"
        )
    return 0
