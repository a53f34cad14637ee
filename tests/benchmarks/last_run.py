"""The figures of a table beside those of the last run, which stand on the page that it replaces."""

import re
from datetime import date

TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)
DATE = re.compile(r"^Measured on (\d{4}-\d\d-\d\d)", re.MULTILINE)
LAST = "last"


def rows_of(table: str) -> list[dict[str, str]]:
    """The rows of a table, each cell by its heading; of several "last" the last one stays."""
    head, _, *rows = ([c.strip() for c in line[1:-1].split("|")] for line in table.splitlines())
    return [dict(zip(head, row, strict=True)) for row in rows]


def beside_last(text: str, before: str, measured: tuple[str, ...], today: date) -> str:
    """The text of a section, with the last figures from `before`, its text of the last run.

    measured: the headings of the columns that get a column of last figures beside them. The first
    cell of a row names it; a row that is new has no last figures. The dates stand above the table.
    """
    last = {
        next(iter(row.values())): row for table in TABLE.findall(before) for row in rows_of(table)
    }

    def widened(table: re.Match[str]) -> str:
        rows = rows_of(table.group())
        heads = [n for name in rows[0] for n in ((name, LAST) if name in measured else (name,))]
        lines = [_line(heads), "|" + "---|" * len(heads) + "\n"]
        for row in rows:
            old, cells = last.get(next(iter(row.values())), {}), []
            for name, cell in row.items():
                cells += [cell, old.get(name, "")] if name in measured else [cell]
            lines.append(_line(cells))
        return "".join(lines)

    return TABLE.sub(lambda table: f"{_dates(before, today)}\n\n{widened(table)}", text, count=1)


def _line(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |\n"


def _dates(before: str, today: date) -> str:
    """When this run was, and the last one."""
    found = DATE.search(before)
    return f"Measured on {today}" + (f"; the last run was on {found[1]}." if found else ".")
