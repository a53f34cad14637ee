"""Sends marks to a learning platform by LTI 1.3."""

import argparse
import json
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.assignments import add_roster, name_of, unknown
from autograder.commands.saying import complain, to_be_looked_at
from autograder.terminal import say, shown_note

MISSING = "this needs the extra lti: python -m pip install -c constraints.txt -e '.[lti]'"


def add_to(commands) -> None:
    parser = commands.add_parser("lti", help="send marks to a learning platform by LTI 1.3")
    steps = parser.add_subparsers(dest="step", required=True)
    keys = steps.add_parser("key", help="make the course's key pair, and show the public key")
    keys.set_defaults(run=make_key)
    sending = steps.add_parser("send", help="send marks, those alone that the platform has not got")
    sending.add_argument(
        "assignment",
        nargs="*",
        type=argument.name,
        help="such as p3-pendulum (default: all that count)",
    )
    sending.add_argument(
        "--with-unread",
        action="store_true",
        help="give points also where a proof is not yet marked: the checks', and those suggested",
    )
    sending.add_argument(
        "--again", action="store_true", help="send also what the platform has got already"
    )
    sending.add_argument(
        "--dry-run",
        action="store_true",
        help="ask the platform, but send nothing; say what would be",
    )
    add_roster(sending)
    sending.set_defaults(run=send)


def make_key(root: Path, given: argparse.Namespace) -> int:
    """Make the key pair where there is none, and say what to give the platform."""
    from autograder.lti import LtiError, key

    try:
        made, is_new = key.make(root)
    except ImportError:
        return complain(MISSING)
    except (LtiError, OSError) as error:
        return complain(str(error))
    say(f"{root / key.PRIVATE}: {'made' if is_new else 'there already'}. Keep it to yourself.")
    say(f"The public key, for platforms that ask for it (Moodle), is in {root / key.PUBLIC}:\n")
    say(made.public)
    say("For those that ask for a JWK (Canvas):\n")
    say(f"{json.dumps(made.jwk, indent=2)}\n")
    say(f"For those that ask for a key set, it is in {root / key.KEY_SET}.")
    return 0


def send(root: Path, given: argparse.Namespace) -> int:
    """Send the marks; the exit status is 1 if somebody's could not be."""
    from autograder import roster, term_calendar
    from autograder.lms.export import chosen
    from autograder.nbgrader_glue.marks import read_marks

    try:
        from autograder.lti import sending
    except ImportError:
        return complain(MISSING)

    given.assignment = [name_of(name) for name in given.assignment]
    for name in given.assignment:
        if why := unknown(root, name):
            return complain(why)
    given.count = given.leave_out = None
    try:
        calendar = term_calendar.read_if_there(root)
        people = roster.read(given.roster) if given.roster else roster.read_if_there(root)
        marks, lines = read_marks(root, people)
        marks, left_out = chosen(marks, calendar, given)
        how = sending.How(given.with_unread, given.again, given.dry_run)
        done = sending.send(root, marks, how)
    except (OSError, ValueError) as error:
        return complain(str(error))
    for line in [*lines, *left_out, *done.lines]:
        say(shown_note(line) if not line.startswith("  ") else f"  {shown_note(line.strip())}")
    return to_be_looked_at(done.faults)
