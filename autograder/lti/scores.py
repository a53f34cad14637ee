"""A mark as a score of the Assignment and Grade Services."""

from datetime import UTC, datetime

from autograder.lms.marks import GRADED, UNREAD, Mark


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
        score |= {"scoreGiven": round(points, 2) + 0.0, "scoreMaximum": most}
    if mark.handed_in:
        score["submission"] = {"submittedAt": in_time(mark.handed_in.replace(tzinfo=UTC))}
    return score


def in_time(when: datetime) -> str:
    """As the services want it: with its zone, and parts of a second."""
    return when.isoformat(timespec="milliseconds")
