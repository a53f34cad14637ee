"""Who of the class list each user of a platform is."""

from collections.abc import Iterable, Mapping

from autograder.lms.people import UnknownError, who
from autograder.protocol import one_line
from autograder.roster import FILE, Person, Roster

IDS = ("user_id", "lis_person_sourcedid", "ext_user_username", "email")


def users(roster: Roster, learners: Iterable[Mapping]) -> tuple[dict[str, str], list[str]]:
    """The platform's id of each student, by the class list's, and who is not certain.

    learners: the members of the platform's course, as its service names them. A member who is not in the
    class list is left out in a line.
    """
    found: dict[str, list[str]] = {}
    faults = []
    for member in learners:
        user = str(member["user_id"])
        parts = (member.get("given_name"), member.get("family_name"))
        name = str(member.get("name") or " ".join(str(part) for part in parts if part) or user)
        cells = [str(member[key]) for key in IDS if member.get(key)]
        try:
            student = who(roster, name, [name, *cells], user)
        except UnknownError as error:
            faults.append(f"in the platform's course: {error}")
            continue
        found.setdefault(student.id, []).append(user)
    certain = {}
    for id, numbers in found.items():
        if len(numbers) == 1:
            certain[id] = numbers[0]
        else:
            faults.append(
                f"{one_line(id, 64)} may be any of the platform's users "
                f"{', '.join(one_line(n, 64) for n in numbers)}: put the right one's number into the "
                f"column lms_id of {FILE}"
            )
    return certain, faults


def by_number(people: Iterable[Person]) -> dict[str, str]:
    """The same by the class list's lms_id alone, where the platform gives out no members."""
    return {one.id: one.lms_id for one in people if one.lms_id}
