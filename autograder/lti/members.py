"""Who of the class list each user of a platform is."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from autograder.lms.people import NobodyError, UnknownError, who
from autograder.protocol import one_line
from autograder.roster import FILE, Person, Roster

NAMES = ("name", "given_name", "family_name")
# A number of the platform's own is no id of the class list, though both may be 1234.
IDS = ("lis_person_sourcedid", "ext_user_username", "email")
SHOWN = 5


def first_few(names: list[str]) -> str:
    """The first names, and how many more there are."""
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(one_line(name, 64) for name in names[:SHOWN]) + more


@dataclass
class Found:
    """users: the platform's id of each student, by the class list's. lines: what may be told of the
    others. faults: who is not certain.
    """

    users: dict[str, str] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


def users(roster: Roster, learners: Iterable[Mapping]) -> Found:
    """Who is who. learners: the members of the platform's course, as its service names them.

    A tutor may be one of them, so a member who is not in the class list is no fault.
    """
    done, meant, strangers = Found(), dict[str, list[str]](), []
    learners = list(learners)
    for member in learners:
        user = str(member["user_id"])
        parts = (member.get("given_name"), member.get("family_name"))
        name = str(member.get("name") or " ".join(str(part) for part in parts if part) or user)
        cells = [str(member[key]) for key in IDS if member.get(key)]
        try:
            meant.setdefault(who(roster, name, [name, *cells], user).id, []).append(user)
        except NobodyError:
            strangers.append(name)
        except UnknownError as error:
            done.faults.append(f"in the platform's course: {error}")
    for id, numbers in meant.items():
        if len(numbers) == 1:
            done.users[id] = numbers[0]
        else:
            done.faults.append(
                f"{one_line(id, 64)} may be any of the platform's users "
                f"{', '.join(one_line(n, 64) for n in numbers)}: put the right one's number into the "
                f"column lms_id of {FILE}"
            )
    if learners and not any(member.get(key) for member in learners for key in (*NAMES, *IDS)):
        done.faults.append(
            "the platform tells neither names nor addresses of its members: let it share both with the "
            f"course, or put their numbers into the column lms_id of {FILE}"
        )
    elif strangers:
        done.lines.append(f"in the platform's course and not in {FILE}: {first_few(strangers)}")
    return done


def by_number(people: Iterable[Person]) -> dict[str, str]:
    """The same by the class list's lms_id alone, where the platform gives out no members."""
    return {one.id: one.lms_id for one in people if one.lms_id}
