"""Who of the class list each member of the platform's course is."""

from autograder.lms.marks import GRADED, Column, Mark, Marks
from autograder.lti import registration, sending
from autograder.lti.sending import How
from autograder.roster import Person
from tests.autograder.lti.a_class import OF_P3, P3, marks, scores
from tests.autograder.lti.platform import member
from tests.autograder.lti.platform import registration as registered


def test_who_is_not_certain_gets_nothing(root, platform):
    platform.members += [
        member("u-x", "Nobody Here"),
        member("u-dan-2", "Day, Dan"),
        member("u-gone", "Ada Lovelace", status="Inactive"),
    ]
    del platform.members[2]  # bob
    of = OF_P3 | {"dan": Mark(GRADED, 3.0)}
    done = sending.send(root, marks(of), How())
    assert set(scores(platform)) == {"u-ada", "u-cem"}
    said = "\n".join(done.faults)
    assert "in the platform's course and not in course/class.csv: Nobody Here" in done.lines
    assert "dan may be any of the platform's users u-dan, u-dan-2" in said
    assert f"{P3}, bob, dan: the platform's course has nobody who is this student" in said
    assert "Instructor" not in said


def test_without_members_the_class_lists_numbers_serve(root, platform):
    (root / registration.FILE).write_text(registered(platform, **{"members-url": ""}))
    done = sending.send(root, marks(), How())
    assert set(scores(platform)) == {"u-cem"}
    (fault,) = done.faults
    assert fault.startswith(
        f"{P3}, ada, bob: course/class.csv has no lms_id, and course/lti.toml no"
    )


def test_who_teaches_or_tries_things_there_is_no_fault(root, platform):
    """Moodle calls a tutor a learner, and Canvas the student with whom teachers try things."""
    platform.members += [member(f"u-tutor-{at}", f"Tom Tutor {at}") for at in range(7)]
    of_canvas = member("u-test", "Test Student")
    of_canvas["roles"].append("http://purl.imsglobal.org/vocab/lti/system/person#TestUser")
    platform.members.append(of_canvas)
    done = sending.send(root, marks(), How())
    assert done.faults == []
    line = "in the platform's course and not in course/class.csv: "
    names = ", ".join(f"Tom Tutor {at}" for at in range(5))
    assert done.lines[0] == f"{line}{names} and 2 more"


def test_a_platforms_number_is_no_id_of_the_class_list(root, platform):
    """The class list may have its own numbers, and the platform's user 77 is another than theirs."""
    people = [Person("77", "Nihil", "Nil"), Person("78", "Lovelace", "Ada")]
    platform.members = [member("77", "Ada Lovelace"), member("12", "Nil Nihil")]
    of = {"77": Mark(GRADED, 1.0), "78": Mark(GRADED, 15.0)}
    done = sending.send(root, Marks(people, [Column(P3, 15.0, None, of)]), How())
    assert done.faults == []
    given = {user: score["scoreGiven"] for user, score in scores(platform).items()}
    assert given == {"77": 15, "12": 1}


def test_members_without_names_are_said_to_be_so(root, platform):
    platform.members = [member(f"{at}") for at in range(40)]
    done = sending.send(root, marks(), How())
    assert "the platform tells neither names nor addresses of its members" in done.faults[0]
    assert done.faults[1] == (
        f"{P3}, ada, bob, cem: the platform's course has nobody who is this student"
    )
    assert done.lines == [
        f"{P3}: 0 scores sent, in a new line item",
        "  not sent: 1, nothing handed in",
    ]
