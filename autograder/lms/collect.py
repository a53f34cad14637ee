"""Takes students' hand-ins out of a platform's archives and puts them where the grader looks."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Protocol

from autograder.lms import archive, hand_in, people, registered
from autograder.lms.archive import ArchiveError, Entry
from autograder.lms.file_names import CANVAS, Origin, is_anonymous, origin
from autograder.lms.hand_in import HandIn
from autograder.lms.people import UnknownError
from autograder.lms.registered import Registered
from autograder.protocol import one_line
from autograder.roster import Person, Roster
from autograder.term_calendar import Assignment, Calendar

AS_A_TIME = "%Y-%m-%d %H:%M:%S %Z"


class Shelf(Protocol):
    """Where an assignment's submissions are."""

    def held(self, person: Person) -> HandIn | None:
        """What is there of a student's. ValueError if it cannot be handled."""

    def put(self, new: HandIn) -> str:
        """Put a hand-in there; where that which was there before is now, or "". OSError, ValueError."""


@dataclass(frozen=True)
class Line:
    """One student of the summary. changed: whether something was written."""

    student: str
    when: datetime | None
    notes: tuple[str, ...]
    changed: bool


@dataclass
class Collected:
    """Who handed in, in the order of the class list; and what could not be taken, or needs a look."""

    lines: list[Line] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


def collect(
    archives: Iterable[Path],
    assignment: str,
    roster: Roster,
    calendar: Calendar,
    shelf: Shelf,
    sheet: Path | None = None,
    latest: bool = False,
    others: Iterable[str] = (),
) -> Collected:
    """Put each student's hand-in that counts on the shelf.

    archives: in the order in which they were downloaded. sheet: the platform's own, which says who has
    which number, and when they handed in. latest: the last hand-in counts though it is late. others: the
    course's other assignments, whose notebooks are not taken. Nothing that is wrong with one hand-in
    stops another. SheetError, OSError if the sheet cannot be read.
    """
    done = Collected()
    known: dict[tuple[str, str], Registered] = {}
    if sheet:
        known, faults = registered.read(sheet, calendar.zone)
        done.faults += faults
    of = calendar.of(assignment)
    best: dict[str, HandIn] = {}
    others = [other for other in others if other != assignment]
    for path in archives:
        found = _handed_in(path, assignment, roster, known, of, done)
        for new in _of_this(found, path, assignment, others, done):
            old, due = best.get(new.person.id), of.due_for(new.person.id)
            best[new.person.id] = _chosen(new, old, due, latest) if old else new
    for student in roster.people:
        if student in best:
            _put(shelf, best[student], assignment, of.due_for(student), latest, done)
    return done


def _of_this(
    found: list[HandIn], path: Path, assignment: str, others: list[str], done: Collected
) -> list[HandIn]:
    """Those whose notebook is not another assignment's, as in an archive that was chosen by mistake."""
    of = {new.person.id: hand_in.of_another(new.files, assignment, others) for new in found}
    if len(found) > 1 and all(of.values()):
        whose = " and ".join(sorted(set(of.values())))
        done.faults.append(
            f"{path.name}: its notebooks are those of {whose}, and not of {assignment}: none was taken"
        )
        return []
    for student, other in of.items():
        if other:
            done.faults.append(
                f"{student}: not taken: the notebook is called as that of {other}, and not of "
                f"{assignment}: ask the student"
            )
    return [new for new in found if not of[new.person.id]]


def _chosen(new: HandIn, old: HandIn, due: datetime | None, latest: bool) -> HandIn:
    taken, other = (new, old) if hand_in.counts_rather(new, old, due, latest) else (old, new)
    why = "the last" if latest or taken.in_time(due) == other.in_time(due) else "the last in time"
    return taken.noted(f"of several, {why} counts: {said(taken)}, and not {said(other)}")


def said(one: HandIn) -> str:
    """A hand-in in words, by its time or, where that is not known, by where it comes from."""
    return one.when.strftime(AS_A_TIME) if one.when else f"that in {one.source}"


def _put(
    shelf: Shelf,
    new: HandIn,
    assignment: str,
    due: datetime | None,
    latest: bool,
    done: Collected,
) -> None:
    """Put a hand-in on the shelf, unless what is there counts rather."""
    student = new.person.id
    try:
        held = shelf.held(new.person)
        why = hand_in.fault(new.files, assignment)
        same = held is not None and held.files == new.files
        if held and same and (not new.when or new.guessed or held.when == new.when):
            done.lines.append(Line(student, held.when, (*new.notes, "unchanged"), False))
        elif held and not same and why and not hand_in.fault(held.files, assignment):
            why = f"{why}; the hand-in that is there stays"
            done.lines.append(Line(student, held.when, new.notes, False))
        elif (
            held
            and not same
            and not hand_in.fault(held.files, assignment)
            and not hand_in.counts_rather(new, held, due, latest)
        ):
            note = f"the hand-in that is there counts: {said(held)}, and not {said(new)}"
            done.lines.append(Line(student, held.when, (*new.notes, note), False))
        else:
            before = shelf.put(new)
            notes = (*new.notes, *([f"the hand-in before it is now in {before}"] if before else []))
            done.lines.append(Line(student, new.when, notes, True))
        if why:
            done.faults.append(f"{student}: {why}")
    except (OSError, ValueError) as error:
        done.faults.append(f"{student}: not taken: {one_line(str(error), 300)}")


def _handed_in(
    path: Path,
    assignment: str,
    roster: Roster,
    known: dict[tuple[str, str], Registered],
    of: Assignment,
    done: Collected,
) -> list[HandIn]:
    """The hand-ins in one archive, one of each student."""
    try:
        entries, left_out = archive.entries(path)
    except (ArchiveError, OSError) as error:
        done.faults.append(str(error))
        return []
    done.faults += left_out
    sent = _by_sender(path, entries, done)
    called = {files[0][0].name for files in sent.values()}
    if (
        len(sent) > 1 and len(called) == 1 and not roster.named(*called)
    ):  # Moodle's word for anybody
        done.faults.append(f"{path.name}: it names nobody: show the names, and download it again")
        return []
    if not sent and not left_out:
        done.faults.append(f"{path.name}: it holds no hand-in of Moodle's or Canvas's")
    if known and sent and not known.keys() & sent.keys():
        done.faults.append(
            f"{path.name}: the sheet names nobody who handed this in: is it of the same assignment and "
            "the same platform?"
        )
    found: dict[str, list[tuple[Origin, HandIn]]] = {}
    for (platform, number), files in sent.items():
        first = files[0][0]
        try:
            row = known.get((platform, number), Registered([]))
            person = people.who(roster, first.name, row.cells, number if platform == CANVAS else "")
            new = _read(path, assignment, person, files, row.when)
            new = _timed(new, first, of)
            found.setdefault(person.id, []).append((first, new))
        except UnknownError as error:
            done.faults.append(f"{path.name}: {error}")
        except ArchiveError as error:
            shown = one_line(first.name, 80)
            done.faults.append(f"{path.name}: {shown}: {error}: nothing of this hand-in was taken")
    for student, several in found.items():
        if len(several) > 1:
            shown = " and ".join(f"{one_line(one.name, 60)} ({one.number})" for one, _ in several)
            done.faults.append(
                f"{path.name}: {shown} would both be {student}: none was taken; give the sheet of "
                "the platform with --sheet"
            )
    return [several[0][1] for several in found.values() if len(several) == 1]


def _by_sender(
    path: Path, entries: list[Entry], done: Collected
) -> dict[tuple[str, str], list[tuple[Origin, Entry]]]:
    sent: dict[tuple[str, str], list[tuple[Origin, Entry]]] = {}
    strange: list[str] = []
    for entry in entries:
        from_ = origin(entry.parts)
        if from_ is None or not from_.parts:
            strange.append(entry.shown)
        else:
            sent.setdefault((from_.platform, from_.number), []).append((from_, entry))
    if any(is_anonymous(entry.parts) for entry in entries):
        done.faults.append(f"{path.name}: it names nobody: show the names, and download it again")
    elif strange:
        more = f" and {len(strange) - 1} more" if len(strange) > 1 else ""
        done.faults.append(f"{path.name}: {strange[0]}{more}: no name of a hand-in")
    return sent


def _read(
    path: Path,
    assignment: str,
    person: Person,
    files: list[tuple[Origin, Entry]],
    when: datetime | None,
) -> HandIn:
    notes, taken = [], {}
    sizes: Counter = Counter()
    for one, entry in files:
        name = "/".join(one.parts)
        if one.typed:
            notes.append(f"text typed into {one.platform} was left out")
            continue
        data = entry.read()
        sizes.update(files=1, bytes=len(data))
        if why := hand_in.unfit(name, sizes):
            raise ArchiveError(f"{one_line(name, 80)}: {why}")
        taken[name] = data
    if not taken:
        raise ArchiveError(f"text was typed into {files[0][0].platform}, and no file handed in")
    arranged, more = hand_in.arranged(taken, assignment)
    called = files[0][0]
    if people.differs(person, called.name):
        more.append(f"{called.platform} calls the student {one_line(called.name, 60)}")
    return HandIn(person, path.name, arranged, when, notes=(*notes, *more))


def _timed(new: HandIn, first: Origin, of: Assignment) -> HandIn:
    """With what is known of its time: Canvas marks what is late, and does not say by how much."""
    if not first.late:
        return new
    new = replace(new, late=True)
    if new.when:
        return new
    if of.due is None:
        return new.noted("Canvas calls it LATE, but the calendar has no due date")
    return replace(new, when=of.due + timedelta(seconds=1), guessed=True).noted(
        "Canvas calls it LATE and not by how much; its timestamp.txt says one second"
    )
