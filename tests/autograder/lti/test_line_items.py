"""Line items are found, made once, and may have other points than the assignment."""

import json

from autograder.lms.marks import GRADED, Column, Mark, Marks
from autograder.lti import registration, sending
from autograder.lti.sending import How
from tests.autograder.lti.a_class import P1, P3, PEOPLE, marks, scores
from tests.autograder.lti.platform import AGS
from tests.autograder.lti.platform import registration as registered


def test_a_line_item_is_found_on_any_page_and_not_made_twice(root, platform):
    for at in range(5):
        name = P3 if at == 4 else f"other-{at}"
        of = {"label": name, "resourceId": name, "scoreMaximum": 100.0}
        platform.items.append(of | {"id": platform.url(f"/items/{at + 1}/lineitem?type_id=3")})
    sending.send(root, marks(), How())
    assert len(platform.items) == 5
    assert len(scores(platform, 5)) == 3


def test_a_line_item_of_the_platforms_own_needs_no_right_to_make_some(root, platform):
    own = platform.url("/items/9/lineitem?type_id=3")
    platform.items.append({"id": own, "label": "Homework 3", "scoreMaximum": 15.0})
    platform.allowed.remove(f"{AGS}lineitem")
    text = registered(platform) + f"[line-items]\n{P3} = {json.dumps(own)}\n"
    (root / registration.FILE).write_text(text)
    assert sending.send(root, marks(), How()).faults == []
    assert len(scores(platform, 9)) == 3


def test_other_points_are_said_and_converted_by_the_platform(root, platform):
    of = {"label": P3, "resourceId": P3, "scoreMaximum": 20.0}
    platform.items.append(of | {"id": platform.url("/items/1/lineitem?type_id=3")})
    done = sending.send(root, marks(), How())
    assert done.lines[1] == "  20 points there, 15 here: the platform converts the marks"
    assert scores(platform)["u-ada"]["scoreMaximum"] == 15


def test_a_line_item_that_is_refused_stops_no_other_assignment(root, platform):
    platform.answers += [("/items", 200, "[]", {})] * 2
    platform.answers.append(
        ("/items", 400, '{"scoreMaximum": ["A valid integer is required."]}', {})
    )
    half = Column(P1, 7.5, None, {"ada": Mark(GRADED, 1.0)})
    done = sending.send(root, Marks(PEOPLE, [half, *marks().columns]), How())
    (fault,) = done.faults
    assert fault.startswith(f"{P1}: not sent: ")
    assert "answers 400: " in fault
    assert "A valid integer" in fault
    assert done.lines[0] == f"{P3}: 3 scores sent, in a new line item"
