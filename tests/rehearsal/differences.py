"""Where the course's gradebook, tables, sheets and reports differ from the ledger, in lines."""

import csv
import html
import re
from collections.abc import Iterator
from pathlib import Path

from tests.rehearsal.ledger import RULES
from tests.rehearsal.mistakes import MISTAKES
from tests.rehearsal.term import Term

NEAR = 1e-5  # points: tables have five digits after the point


def of_the_gradebook(term: Term) -> Iterator[str]:
    """Its rows: who is there, points, penalties, what waits for a person."""
    ledger = term.ledger
    with term.gradebook() as gradebook:
        known = {one.id for one in gradebook.students}
        for student in ledger.withdrawn & known:
            yield f"{student} has withdrawn, and is in the gradebook"
        rows = {(one.student_id, one.assignment.name): one
                for assignment in gradebook.assignments for one in assignment.submissions}  # fmt: skip
        for (student, name), entry in ledger.hand_ins.items():
            row = rows.pop((student, name), None)
            where = f"gradebook: {student}, {name}"
            if entry.damaged:
                continue
            if row is None:
                yield f"{where}: no row"
                continue
            yield from _differ(where, "score", row.score, ledger.raw(student, name))
            taken = row.late_submission_penalty or 0.0
            yield from _differ(where, "penalty", taken, ledger.penalty(student, name))
            if row.needs_manual_grade != entry.unread:
                yield f"{where}: waits for a person: {row.needs_manual_grade}, not {entry.unread}"
        for (student, name), row in rows.items():
            if row.notebooks and any(
                grade.auto_score for one in row.notebooks for grade in one.grades
            ):
                yield f"gradebook: {student}, {name}: a row with points, and nothing was handed in"


def of_the_long_table(term: Term, path: Path) -> Iterator[str]:
    ledger = term.ledger
    counted = [name for name in term.names if RULES[name].counts]
    rows = {(row["student"], row["assignment"]): row for row in table(path)}
    wanted = {(one.id, name) for one in term.students for name in counted}
    if set(rows) != wanted:
        yield f"{path.name}: rows that are not to be there, or missing: {set(rows) ^ wanted}"
    for student in term.students:
        for name in counted:
            row = rows.get((student.id, name))
            if row is None:
                continue
            where = f"{path.name}: {student.id}, {name}"
            yield from _differ(
                where, "points", points(row["points"]), ledger.mark(student.id, name)
            )
            status = row["status"].split(", late")[0]
            if status != ledger.status(student.id, name):
                yield f"{where}: {status}, not {ledger.status(student.id, name)}"
            if (
                harmless(student.last) != row["last_name"]
                or harmless(student.first) != row["first_name"]
            ):
                yield f"{where}: {row['first_name']} {row['last_name']} is not {student.name}"


def of_the_wide_table(term: Term, path: Path) -> Iterator[str]:
    for row in table(path):
        where = f"{path.name}: {row['student']}"
        yield from _differ(where, "total", float(row["total"]), term.ledger.total(row["student"]))


def of_a_sheet(term: Term, path: Path, name: str, key: str, mark: str) -> Iterator[str]:
    """Of a learning platform's: key, mark: the headings with the student's number and the points."""
    rows = {row[key].removeprefix("Participant "): row for row in table(path)}
    for student in term.students:
        where = f"{path.name}: {student.id}, {name}"
        found = rows[str(student.number)][mark]
        yield from _differ(where, "points", points(found), term.ledger.mark(student.id, name))


def of_the_files(term: Term, name: str) -> Iterator[str]:
    """A page for each whose hand-in could be read, and nothing that other accounts can open."""
    for (student, of), entry in term.ledger.hand_ins.items():
        page = term.root / "course" / "feedback" / student / of / f"{of}.html"
        if of == name and page.is_file() == entry.damaged:
            yield f"{student}, {name}: {'a' if entry.damaged else 'no'} feedback page"
    for path in (term.root / "course", *term.root.glob("archive/*")):
        if path.stat().st_mode & 0o077:
            yield f"{path.name} is open to other accounts: {path.stat().st_mode:o}"
    if not list(term.root.glob("archive/*.zip")):
        yield "there is no archive"


def of_the_text(term: Term, name: str) -> Iterator[str]:
    """Of the problem as students read it: it has to say what a mistake leaves of the points."""
    text = "\n".join(cell.source for cell in term.problems[name].release.cells)
    for wrong in MISTAKES[name]:
        if wrong.published not in text:
            yield f"{name}: the problem does not say {wrong.published!r}"


def of_the_report(term: Term, name: str) -> Iterator[str]:
    """Each mistake that the lecturer reads of, with as many students as made it; the commonest first."""
    page = (term.root / "course" / "report" / f"{name}.html").read_text(encoding="utf-8")
    rows = re.findall(
        r'<tr><td class="number">(\d+)</td><td>(.*?)</td>\n<td>(.*?)<details>', page, re.S
    )
    shown = [(int(count), check, html.unescape(text)) for count, check, text in rows]
    wanted: dict[tuple[str, str], int] = {}
    for wrong in MISTAKES[name]:
        for told in wrong.told.items():
            wanted[told] = wanted.get(told, 0) + len(term.ledger.made(name, wrong))
    for (check, words), count in wanted.items():
        found = [many for many, of, text in shown if of == check and words in text]
        if found != [count] * bool(count):
            yield f"{name}.html: {check}, “{words}”: {found} students, not {count}"
    read = r"(?:, who|; \d+ of them) read: \S"
    stopped = dict(re.findall(rf'<span class="name">(\S+):</span> (\d+) students?{read}', page))
    for wrong in MISTAKES[name]:
        for check in wrong.kept if not wrong.told else ():
            count, found = len(term.ledger.made(name, wrong)), int(stopped.get(check, 0))
            if found != count:
                yield f"{name}.html: {check} gave no numbers to {found} students, not {count}"
    counts = [count for count, *_ in shown]
    if counts != sorted(filter(None, wanted.values()), reverse=True):
        yield f"{name}.html: mistakes of {counts} students, not of {sorted(wanted.values())}"


def table(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        return list(csv.DictReader(file))


def points(cell: str) -> float | None:
    return float(cell.replace(",", ".")) if cell else None


def harmless(name: str) -> str:
    """A cell that a spreadsheet would take for a formula has an apostrophe in front."""
    return f"'{name}" if name[:1] in "=+-@" else name


def _differ(where: str, what: str, found: float | None, wanted: float | None) -> Iterator[str]:
    if (found is None) != (wanted is None) or (found is not None and abs(found - wanted) > NEAR):
        yield f"{where}: {what} {found}, not {wanted}"
