"""What several commands ask of an assignment's name, and of the class list."""

import difflib
from pathlib import Path

from autograder import arguments as argument


def name_of(assignment: str) -> str:
    """The assignment's name, also where a shell has completed it to the path of its folder."""
    return Path(assignment).name


def unknown(root: Path, assignment: str) -> str:
    """Why there is no such assignment, with the names that may be meant; empty if there is one."""
    known = sorted(path.stem for path in (root / "solutions").glob("*/*.ipynb")
                   if path.stem == path.parent.name)  # fmt: skip
    if assignment in known:
        return ""
    near = [name for name in known if assignment and assignment.casefold() in name.casefold()]
    meant = near or difflib.get_close_matches(assignment, known)
    named = f"Did you mean {' or '.join(meant)}?" if meant else f"There are {', '.join(known)}."
    return (
        f"there is no solutions/{assignment}/{assignment}.ipynb. {named if known else ''}".rstrip()
    )


def add_roster(parser) -> None:
    parser.add_argument(
        "--roster", type=argument.there, help="the class list (default: course/class.csv)"
    )
