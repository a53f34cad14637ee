"""A mark as a score of the Assignment and Grade Services, and as it goes out."""

from datetime import UTC, datetime

from autograder.lms.marks import GRADED, UNREAD, Mark

# Canvas's own key. It makes a submission of each score that does not say otherwise: one more attempt,
# handed in when the score came where the score says no other time. Other platforms do not read it.
OF_CANVAS = "https://canvas.instructure.com/lti/submission"


def score_of(mark: Mark, most: float, user: str, unread: bool = False) -> dict | None:
    """The score, without its time; None where there is nothing to send.

    most: the assignment's points. user: the platform's id of the student. unread: give points also where
    a proof is not yet marked. Nothing handed in is no score of 0, and nor is what is not graded yet.
    """
    if mark.state not in (GRADED, UNREAD):
        return None
    is_graded = mark.state == GRADED
    score: dict = {
        "userId": user,
        "activityProgress": "Completed" if is_graded else "Submitted",
        "gradingProgress": "FullyGraded" if is_graded else "PendingManual",
        "comment": mark.status,
    }
    points = mark.so_far if unread else mark.points
    if points is not None:
        score |= {"scoreGiven": number(round(points, 5) + 0.0), "scoreMaximum": number(most)}
    if mark.handed_in:
        score["submission"] = {"submittedAt": in_time(mark.handed_in.replace(tzinfo=UTC))}
    return score


def outgoing(score: dict, before: dict | None) -> dict:
    """The score as it is sent now. before: what the platform got of this student's last time.

    Students see each comment, and Canvas keeps all: "graded" is sent only in place of another one.
    """
    out = score | {"timestamp": in_time(datetime.now(UTC))}
    if score["comment"] == GRADED and (before is None or before["comment"] == GRADED):
        del out["comment"]
    when = score.get("submission")
    if when is None or (before is not None and before.get("submission") == when):
        out[OF_CANVAS] = {"new_submission": False}
    return out


def number(points: float) -> int | float:
    """Points as JSON that a platform which counts in whole ones reads, too: 15 and not 15.0."""
    return int(points) if points == int(points) else points


def in_time(when: datetime) -> str:
    """As the services want it: with its zone, and parts of a second."""
    return when.isoformat(timespec="milliseconds")
