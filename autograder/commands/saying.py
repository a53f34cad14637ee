"""How a command ends that could not do all that it was asked."""

import sys

from autograder.terminal import say, shown_note


def complain(what: str, status: int = 2) -> int:
    say(f"autograder: {what}", sys.stderr)
    return status


def of_gradebook(error: Exception) -> str:
    """What to say of an error of the gradebook's database; "" for any other error."""
    if "sqlalchemy" not in sys.modules:
        return ""
    from autograder.nbgrader_glue.locked import why_unusable  # loaded with the gradebook

    return why_unusable(error)


def to_be_looked_at(faults: list[str]) -> int:
    """Say what needs a look; the exit status."""
    if faults:
        say("\nTo be looked at:")
    for fault in faults:
        say(f"  {shown_note(fault)}")
    return 1 if faults else 0


def agreed(question: str) -> bool:
    """Whether somebody at the terminal says yes."""
    try:
        return input(question).strip().casefold() in ("y", "yes")
    except EOFError:
        return False
