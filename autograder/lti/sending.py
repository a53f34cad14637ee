"""`autograder lti send`: the scores of assignments, each student's by itself."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from autograder.lms.marks import Column, Marks
from autograder.lms.sheet import written
from autograder.lti import LtiError, key, members, registration
from autograder.lti.platform import Platform, RefusedError
from autograder.lti.scores import outgoing, score_of
from autograder.lti.sent import Sent
from autograder.roster import FILE, Roster


@dataclass
class Done:
    """What is to be said, and what needs a look."""

    lines: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class How:
    """unread: with points where a proof is not marked. again: also what was sent. dry: send nothing."""

    unread: bool = False
    again: bool = False
    dry: bool = False


def send(root: Path, marks: Marks, how: How) -> Done:
    """Send the marks of these assignments. LtiError, OSError where nothing can be sent."""
    registered = registration.read(root)
    platform, sent, done = Platform(registered, key.read(root)), Sent(root), Done()
    if registered.members_url:
        roster = Roster({one.id: one for one in marks.people})
        found = members.users(roster, platform.learners())
        numbers, done.lines, done.faults = found.users, found.lines, found.faults
        unknown = "the platform's course has nobody who is this student"
    else:
        numbers = members.by_number(marks.people)
        unknown = f"{FILE} has no lms_id, and {registration.FILE} no members-url to ask"
    try:
        for column in marks.columns:
            try:
                _send_column(platform, column, marks, numbers, unknown, sent, how, done)
            except RefusedError as error:
                done.faults.append(f"{column.assignment}: not sent: {error}")
    except LtiError as error:
        rest = "" if how.dry else "; when that is mended, run the command again: it sends the rest"
        done.faults.append(f"{error}{rest}")
    finally:
        if not how.dry:
            sent.write()
    return done


def _send_column(
    platform: Platform, column: Column, marks: Marks, numbers: dict[str, str], unknown: str,
    sent: Sent, how: How, done: Done,
) -> None:  # fmt: skip
    """Send one assignment's. RefusedError where the platform has no line item for it, LtiError where it
    takes nothing more at all.
    """
    item = platform.line_item(column.assignment, column.most, make=not how.dry)
    count, left, same = 0, Counter[str](), 0
    refused: dict[str, list[str]] = {}
    try:
        for person in marks.people:
            mark = column.of(person.id)
            score = score_of(mark, column.most, numbers.get(person.id, ""), how.unread)
            if score is None:
                left[mark.state] += 1
                continue
            before = sent.of(item.address, person.id)
            if not score["userId"]:
                refused.setdefault(unknown, []).append(person.id)
            elif not how.again and score == before:
                same += 1
            else:
                try:
                    if not how.dry:
                        platform.send(item.address, outgoing(score, before))
                        sent.note(item.address, person.id, score)
                    count += 1
                except RefusedError as error:
                    refused.setdefault(f"not sent: {error}", []).append(person.id)
    finally:
        would = "would be sent" if how.dry else "sent"
        new = f", in a new line item{' to be made' if how.dry else ''}" if item.is_new else ""
        scores = "1 score" if count == 1 else f"{count} scores"
        done.lines.append(f"{column.assignment}: {scores} {would}{new}")
        if item.most is not None and abs(item.most - column.most) > 1e-9:
            points = f"{written(item.most)} points there, {written(column.most)} here"
            done.lines.append(f"  {points}: the platform converts the marks")
        if same:
            done.lines.append(f"  as they were sent before: {same}")
        done.lines += [f"  not sent: {n}, {why}" for why, n in sorted(left.items())]
        done.faults += [
            f"{column.assignment}, {members.first_few(ids)}: {why}" for why, ids in refused.items()
        ]
