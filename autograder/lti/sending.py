"""`autograder lti send`: the scores of assignments, each student's by itself."""

from collections import Counter
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

from autograder.lms.marks import Column, Marks
from autograder.lti import LtiError, key, members, registration
from autograder.lti.platform import Platform, RefusedError
from autograder.lti.scores import in_time, score_of
from autograder.lti.sent import Sent
from autograder.protocol import one_line
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
        numbers, done.faults = members.users(roster, platform.learners())
        unknown = "the platform's course has nobody who is this student"
    else:
        numbers = members.by_number(marks.people)
        unknown = f"{FILE} has no lms_id, and {registration.FILE} no members-url to ask"
    try:
        for column in marks.columns:
            _send_column(platform, column, marks, numbers, unknown, sent, how, done)
    except LtiError as error:  # what is said of one student is caught where it arises
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
    """Send one assignment's. RefusedError, LtiError where the platform takes none of them."""
    line_item, is_new = platform.line_item(column.assignment, column.most, make=not how.dry)
    count, left, same = 0, Counter[str](), 0
    try:
        for person in marks.people:
            mark = column.of(person.id)
            score = score_of(mark, column.most, numbers.get(person.id, ""), how.unread)
            if score is None:
                left[mark.state] += 1
            elif not score["userId"]:
                done.faults.append(f"{column.assignment}, {one_line(person.id, 64)}: {unknown}")
            elif not how.again and sent.has(line_item, score):
                same += 1
            else:
                try:
                    if not how.dry:
                        now = in_time(datetime.now(UTC))
                        platform.send(line_item, score | {"timestamp": now})
                        sent.note(line_item, score)
                    count += 1
                except RefusedError as error:
                    said = f"{column.assignment}, {one_line(person.id, 64)}: not sent: {error}"
                    done.faults.append(said)
    finally:
        would = "would be sent" if how.dry else "sent"
        new = f", in a new line item{' to be made' if how.dry else ''}" if is_new else ""
        scores = "1 score" if count == 1 else f"{count} scores"
        done.lines.append(f"{column.assignment}: {scores} {would}{new}")
        if same:
            done.lines.append(f"  as they were sent before: {same}")
        done.lines += [f"  not sent: {n}, {why}" for why, n in sorted(left.items())]
