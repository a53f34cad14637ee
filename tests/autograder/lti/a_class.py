"""A class with its marks, and its course at a platform."""

from datetime import datetime

from autograder.lms.marks import GRADED, NOTHING, UNREAD, Column, Mark, Marks
from autograder.lti import LtiError, sending
from autograder.lti.sending import How
from autograder.roster import Person
from tests.autograder.lti.platform import Platform, member

P1, P3 = "p1-inertia", "p3-pendulum"
PEOPLE = [
    Person("ada", "Lovelace", "Ada", "ada@x.org"),
    Person("bob", "Doe, Jr.", "Bob"),
    Person("cem", lms_id="u-cem"),
    Person("dan", "Day", "Dan", "dan@x.org"),
]
HANDED_IN = datetime(2026, 11, 28, 17, 59)
OF_P3 = {
    "ada": Mark(GRADED, 12.504, handed_in=HANDED_IN),
    "bob": Mark(GRADED, 0.0, 1.5, late=True),
    "cem": Mark(UNREAD, 7.0),
    "dan": Mark(NOTHING),
}
MEMBERS = [
    member("t-1", "Ines Instructor", "Instructor"),
    member("u-ada", "A. Lovelace", email="ADA@x.org"),
    member("u-bob", given_name="Bob", family_name="Doe, Jr."),
    member("u-cem"),
    member("u-dan", "Dan Day"),
]


def marks(of_p3=None, *columns: Column) -> Marks:
    return Marks(PEOPLE, [Column(P3, 15.0, None, of_p3 or OF_P3), *columns])


def scores(platform: Platform, number: int = 1) -> dict:
    """The scores that a line item has, without their times."""
    found = platform.scores.get(f"/items/{number}/lineitem", {})
    return {user: {k: v for k, v in one.items() if k != "timestamp"} for user, one in found.items()}


def refusal(root) -> str:
    """What is said where nothing can be sent."""
    try:
        return "\n".join(sending.send(root, marks(), How()).faults)
    except LtiError as error:
        return str(error)
