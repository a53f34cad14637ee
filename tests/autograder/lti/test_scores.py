"""Each score goes out once, to the right student, and says what the mark says."""

import os
import stat
from datetime import datetime

import pytest

from autograder.lms.marks import GRADED, UNGRADED, UNREAD, Column, Mark, Marks
from autograder.lti import LtiError, sending
from autograder.lti.scores import OF_CANVAS
from autograder.lti.sending import How
from autograder.lti.sent import FILE as SENT
from tests.autograder.lti.a_class import OF_P3, P1, P3, PEOPLE, marks, scores


def test_each_student_gets_the_score_that_the_mark_says(root, platform):
    done = sending.send(root, marks(), How())
    assert done.faults == []
    assert done.lines == [
        f"{P3}: 3 scores sent, in a new line item",
        "  not sent: 1, nothing handed in",
    ]
    (item,) = platform.items
    assert (item["label"], item["resourceId"], item["scoreMaximum"]) == (P3, P3, 15.0)
    full = {"activityProgress": "Completed", "gradingProgress": "FullyGraded", "scoreMaximum": 15.0}
    assert scores(platform) == {
        "u-ada": {"userId": "u-ada", "scoreGiven": 12.504, **full,
                  "submission": {"submittedAt": "2026-11-28T17:59:00.000+00:00"}},
        "u-bob": {"userId": "u-bob", "scoreGiven": 0.0, "comment": "graded, late, −1.5", **full,
                  OF_CANVAS: {"new_submission": False}},
        "u-cem": {"userId": "u-cem", "activityProgress": "Submitted",
                  "gradingProgress": "PendingManual", "comment": "proof not yet marked",
                  OF_CANVAS: {"new_submission": False}},
    }  # fmt: skip


def test_what_is_suggested_is_sent_only_when_asked(root, platform):
    sending.send(root, marks(), How(unread=True))
    assert scores(platform)["u-cem"]["scoreGiven"] == 7.0
    assert scores(platform)["u-cem"]["gradingProgress"] == "PendingManual"


def test_whole_points_are_whole_numbers(root, platform):
    """Some platforms have whole numbers alone for what a line item gives."""
    sending.send(root, marks({"ada": Mark(GRADED, 12.0)}), How())
    score = scores(platform)["u-ada"]
    found = (platform.items[0]["scoreMaximum"], score["scoreMaximum"], score["scoreGiven"])
    assert [type(one) for one in found] == [int] * 3


def test_canvas_makes_one_attempt_a_hand_in(root, platform):
    """It makes one of each score that does not say otherwise, and at the time that the score names."""
    when = datetime(2026, 11, 28, 17, 59)

    def send(mark: Mark) -> dict | None:
        sending.send(root, marks({"ada": mark}), How())
        return scores(platform)["u-ada"].get(OF_CANVAS)

    assert send(Mark(UNREAD, handed_in=when)) is None
    assert send(Mark(GRADED, 12.0, handed_in=when)) == {"new_submission": False}
    assert send(Mark(GRADED, 11.0, handed_in=datetime(2026, 11, 29))) is None
    assert send(Mark(GRADED, 10.0)) == {"new_submission": False}


def test_a_comment_that_says_nothing_replaces_one_and_is_else_no_comment(root, platform):
    said = []
    for mark in (Mark(GRADED, 1.0), Mark(UNREAD), Mark(GRADED, 2.0), Mark(GRADED, 3.0)):
        sending.send(root, marks({"ada": mark}), How())
        said.append(scores(platform)["u-ada"].get("comment"))
    assert said == [None, "proof not yet marked", "graded", None]


def test_only_what_has_changed_is_sent_again(root, platform):
    sending.send(root, marks(), How())
    again = sending.send(root, marks(), How())
    assert again.lines[:2] == [f"{P3}: 0 scores sent", "  as they were sent before: 3"]
    assert platform.posted == 3
    read = OF_P3 | {"cem": Mark(GRADED, 11.0)}
    assert sending.send(root, marks(read), How()).lines[0] == f"{P3}: 1 score sent"
    assert scores(platform)["u-cem"]["scoreGiven"] == 11.0
    assert sending.send(root, marks(read), How(again=True)).lines[0] == f"{P3}: 3 scores sent"
    assert (platform.posted, len(platform.items)) == (7, 1)
    if os.name == "posix":
        assert stat.S_IMODE((root / SENT).stat().st_mode) == 0o600


def test_a_dry_run_sends_and_makes_nothing(root, platform):
    done = sending.send(root, marks(), How(dry=True))
    assert done.lines[0] == f"{P3}: 3 scores would be sent, in a new line item to be made"
    assert (platform.items, platform.posted, (root / SENT).exists()) == ([], 0, False)


def test_nothing_graded_is_no_score(root, platform):
    done = sending.send(root, marks({"ada": Mark(UNGRADED)}), How())
    assert platform.posted == 0
    assert done.lines[1:] == ["  not sent: 1, not graded yet", "  not sent: 3, nothing handed in"]


def test_after_the_platform_has_gone_the_rest_is_sent_the_next_time(root, platform):
    """Its line items are there, and then it answers with what is no answer."""
    sending.send(root, marks({"ada": OF_P3["ada"]}), How())
    platform.answers.append(("/items", 200, "[", {}))
    of_p1 = Column(P1, 20.0, None, {"ada": Mark(GRADED, 1.0)})
    done = sending.send(root, Marks(PEOPLE, [of_p1, *marks().columns]), How())
    assert "run the command again: it sends the rest" in done.faults[-1]
    assert platform.posted == 1
    done = sending.send(root, Marks(PEOPLE, [of_p1, *marks().columns]), How())
    assert done.faults == []
    assert platform.posted == 4


@pytest.mark.parametrize("text", ["[", "[1]", '{"x": 1}', '{"x": {"ada": 1}}'])
def test_a_damaged_record_of_what_was_sent_is_named(root, platform, text):
    (root / SENT).write_text(text)
    with pytest.raises(LtiError, match=r"lti-sent\.json is damaged: .* all scores are sent again"):
        sending.send(root, marks(), How())
    assert platform.posted == 0
