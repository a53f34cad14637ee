"""What a platform's sheet says of its students, by the numbers in the names of its files."""

from dataclasses import dataclass
from datetime import datetime, tzinfo
from pathlib import Path

from autograder.lms import canvas, moodle
from autograder.lms.file_names import CANVAS, MOODLE
from autograder.protocol import one_line


@dataclass(frozen=True)
class Registered:
    """One student's row. when: the time of the hand-in, None if it is not known."""

    cells: list[str]
    when: datetime | None = None


def read(path: Path, zone: tzinfo | None) -> tuple[dict[tuple[str, str], Registered], list[str]]:
    """The rows of a sheet of Moodle's or Canvas's by (platform, number), and what cannot be read in it.

    zone: that of the sheet's times. SheetError if it is neither's.
    """
    if canvas.is_one(path):
        held = canvas.read(path)
        return {(CANVAS, held.number(row)): Registered(held.cells(row)) for row in held.rows}, []
    worksheet = moodle.read(path)
    found, faults = {}, []
    for row in worksheet.sheet.rows:
        try:
            when = worksheet.handed_in(row, zone)
        except ValueError as error:
            when = None
            faults.append(f"{path.name}: {one_line(worksheet.name(row), 60)}: {error}")
        found[MOODLE, worksheet.number(row)] = Registered(worksheet.cells(row), when)
    return found, faults
