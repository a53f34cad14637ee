"""A platform's table of students as CSV: read however it was written, and written the same way."""

import csv
import io
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from autograder.protocol import one_line

MOST_BYTES = 64 << 20
NUMBER = re.compile(r"[+-]?\d+(?:[.,]\d+)?")
# A spreadsheet may take a text for a formula if it starts so, also after spaces or in wide forms.
FORMULA = re.compile(r"[\s']*[=+\-@\uff1d\uff0b\uff0d\uff20]|'*[\t\r\n]")


class SheetError(ValueError):
    """A sheet cannot be used; the message names the file and says what is wrong."""


@dataclass
class Sheet:
    """A table: its headings, and rows that are as wide as they are."""

    path: Path
    head: list[str]
    rows: list[list[str]]
    delimiter: str = ","
    bom: bool = False
    end: str = "\n"

    def text(self) -> str:
        """The table as CSV; no cell of it starts a formula in a spreadsheet."""
        rows = ([kept(cell) for cell in row] for row in [self.head, *self.rows])
        return ("\ufeff" if self.bom else "") + as_csv(rows, self.delimiter, self.end)

    def column(self, heading: str) -> int:
        """Where a heading stands. SheetError if it is there not once."""
        found = [at for at, name in enumerate(self.head) if name.strip() == heading.strip()]
        if len(found) != 1:
            how = "no column is" if not found else f"{len(found)} columns are"
            raise SheetError(f"{self.path.name}: {how} called {heading!r}; {self.headings}")
        return found[0]

    @property
    def headings(self) -> str:
        return "the columns are " + ", ".join(one_line(name, 60) for name in self.head)


def read(path: Path) -> Sheet:
    """The table in a file. FileNotFoundError if there is none, SheetError if it is not CSV in UTF-8."""
    if path.stat().st_size > MOST_BYTES:
        raise SheetError(f"{path.name}: it has more than {MOST_BYTES >> 20} MB")
    data = path.read_bytes()
    if data.startswith(b"PK"):
        raise SheetError(f"{path.name}: it is a workbook and not CSV: download it as CSV")
    try:
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError:
        raise SheetError(
            f"{path.name}: it is not UTF-8: download it again, or save it so"
        ) from None
    delimiter = max(",;\t", key=lambda sign: len(next(_reader(text, sign), [])))
    reader = _reader(text, delimiter)
    try:
        head, *rows = [row for row in reader if row]
    except csv.Error as error:
        raise SheetError(f"{path.name}, line {reader.line_num}: {error}") from None
    except ValueError:
        raise SheetError(f"{path.name}: it is empty") from None
    for row in rows:
        if len(row) > len(head) and any(row[len(head) :]):
            shown = one_line(delimiter.join(row), 60)
            raise SheetError(
                f"{path.name}: the row {shown!r} has more cells than there are headings"
            )
    rows = [(row + [""] * len(head))[: len(head)] for row in rows]
    end = "\r\n" if "\r\n" in text[: len(text.split("\n")[0]) + 2] else "\n"
    return Sheet(path, head, rows, delimiter, data.startswith(b"\xef\xbb\xbf"), end)


def _reader(text: str, delimiter: str):
    return csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)


def as_csv(rows: Iterable[Iterable[str]], delimiter: str = ",", end: str = "\n") -> str:
    """The rows as CSV. Python's writer quotes a line break only if it is the one that ends its rows."""
    table = io.StringIO(newline="")
    for row in rows:
        line = io.StringIO(newline="")
        csv.writer(line, delimiter=delimiter, lineterminator="\r\n").writerow(row)
        table.write(line.getvalue().removesuffix("\r\n") + end)
    return table.getvalue()


def harmless(text: str) -> str:
    """The text, with an apostrophe before it if a spreadsheet would take it for a formula.

    Different texts stay different: without the apostrophe, each is what it was.
    """
    return f"'{text}" if FORMULA.match(text) else text


def kept(cell: str) -> str:
    """A cell that is written back: a number and a lone hyphen, Moodle's for no time, are no formulas."""
    return cell if cell == "-" or NUMBER.fullmatch(cell) else harmless(cell)


def number(cell: str) -> float | None:
    """A number as platforms write it, with a point or a comma; None if it is none."""
    text = cell.strip()
    return float(text.replace(",", ".")) if NUMBER.fullmatch(text) else None


def written(points: float, comma: bool = False) -> str:
    """Points as platforms read them: five digits after the point, as many as Moodle keeps, less if they
    are zeros: a quarter taken off half a point is 0.375, and a sum of such must come out right.
    """
    text = f"{round(points, 5) + 0.0:.5f}".rstrip("0").rstrip(".")
    return text.replace(".", ",") if comma else text
