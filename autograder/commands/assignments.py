"""What several commands ask of an assignment's name, and of the class list."""

from pathlib import Path

from autograder import arguments as argument
from autograder.meant import meant


def name_of(assignment: str) -> str:
    """The assignment's name, also where a shell has completed it to the path of its folder."""
    return Path(assignment).name


def unknown(root: Path, assignment: str) -> str:
    """Why there is no such assignment, with the names that may be meant; empty if there is one."""
    names = known(root)
    if assignment in names:
        return ""
    near = meant(assignment, names)
    named = f"Did you mean {' or '.join(near)}?" if near else f"There are {', '.join(names)}."
    return (
        f"there is no solutions/{assignment}/{assignment}.ipynb. {named if names else ''}".rstrip()
    )


def known(root: Path) -> list[str]:
    """The names of the course's assignments."""
    return sorted(path.stem for path in (root / "solutions").glob("*/*.ipynb")
                  if path.stem == path.parent.name)  # fmt: skip


def add_roster(parser) -> None:
    parser.add_argument(
        "--roster", type=argument.there, help="the class list (default: course/class.csv)"
    )
