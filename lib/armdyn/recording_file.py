"""Reads a recording from a CSV file, and says where the file is not what it seems to be.

The first line names the columns, in any order, separated by commas:

| column | meaning | unit, if nothing is said | units that may be said |
|---|---|---|---|
| t | time | s | t_s, t_ms |
| q1, q2, … | angles (or lengths) of the joints | rad | q1_rad, q1_deg, q1_m |
| u1, u2, … | torques (or forces); tau1 means the same | N·m | u1_Nm, u1_N |

Each further line is a sample. Other columns are left out.
"""

import csv
import math
import re
from pathlib import Path

import numpy as np

from armdyn.recording import Recording

UNITS = {
    "t": {"s": 1.0, "ms": 1e-3},
    "q": {"rad": 1.0, "deg": math.pi / 180, "m": 1.0},
    "u": {"Nm": 1.0, "N": 1.0},
}
COLUMN = re.compile(
    r"(?:(?P<t>t)(?:_(?P<t_unit>s|ms))?"
    r"|(?P<q>q)(?P<q_joint>\d{1,2})(?:_(?P<q_unit>rad|deg|m))?"
    r"|(?P<u>u|tau)(?P<u_joint>\d{1,2})(?:_(?P<u_unit>Nm|N))?)"
)
# Without a unit: angles that go further are taken for degrees, slower samples for ms.
TURNS, SLOW = 4 * math.pi, 0.2
QUOTED = 40


def read(path: str | Path) -> Recording:
    """The recording in a CSV file whose columns are those of the table above.

    Raises FileNotFoundError; and ValueError, with the line, for a column that is missing or named twice,
    joints that are not counted from 1, what is no finite number, times that do not increase, angles
    that jump by half a turn or more, and for angles that look like degrees and times that look like
    milliseconds where their column does not say its unit.
    """
    path = Path(path)
    with path.open(newline="", encoding="utf-8-sig", errors="replace") as file:
        try:
            numbered = enumerate(csv.reader(file), start=1)
            rows = [(line, row) for line, row in numbered if any(map(str.strip, row))]
        except csv.Error as error:
            raise ValueError(f"{path.name}: is no CSV file ({error})") from None
    if len(rows) < 3:
        raise ValueError(
            f"{path.name}: has {len(rows)} lines; needs one with names, and 2 samples or more"
        )
    (_, header), *samples = rows
    columns, n = _columns(path.name, header)
    lines = [line for line, _ in samples]
    wanted = _names(n)
    values = np.array(
        [
            [_number(path.name, line, name, row, columns[name][0]) for name in wanted]
            for line, row in samples
        ]
    )
    for k, name in enumerate(wanted):
        unit = columns[name][1]
        if not unit:
            _suspect(path.name, name, values[:, k])
        values[:, k] *= UNITS[name[0]][unit] if unit else 1.0
    _check_order(path.name, lines, values[:, 0])
    for k in range(n):
        if columns[f"q{k + 1}"][1] != "m":
            _check_jumps(path.name, lines, f"q{k + 1}", values[:, 1 + k])
    return Recording(values[:, 0], values[:, 1 : n + 1], values[:, n + 1 :])


def _columns(name, header) -> tuple[dict[str, tuple[int, str]], int]:
    """Of t, q1, … and u1, …: the place in a line, and the unit said; and how many joints there are."""
    columns: dict[str, tuple[int, str]] = {}
    for place, text in enumerate(header):
        found = COLUMN.fullmatch(text.strip())
        if not found:
            continue
        kind = next(kind for kind in UNITS if found[kind])
        joint = "" if kind == "t" else str(int(found[f"{kind}_joint"]))
        if joint == "0":
            raise ValueError(f"{name}: column {text.strip()}; needs joints that are counted from 1")
        if kind + joint in columns:
            raise ValueError(f"{name}: two columns are {kind + joint}; needs one")
        columns[kind + joint] = place, found[f"{kind}_unit"] or ""
    n = max((int(column[1:]) for column in columns if column != "t"), default=1)
    for column in _names(n):
        if column not in columns:
            units = " or ".join(f"{column}_{unit}" for unit in UNITS[column[0]])
            by = "; separate the columns by commas" if ";" in "".join(header) else ""
            raise ValueError(
                f"{name}: no column {column}, which may be named {units}, too; the first line is "
                f"{_quoted(','.join(header))}{by}"
            )
    return columns, n


def _names(n) -> list[str]:
    return ["t", *(f"{kind}{i}" for kind in "qu" for i in range(1, n + 1))]


def _number(name, line, column, row, place) -> float:
    text = row[place].strip() if place < len(row) else ""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{name}, line {line}: {column} is {_quoted(text)}; needs a finite number")
    return value


def _suspect(name, column, values) -> None:
    if column[0] == "q" and np.ptp(values) > TURNS:
        raise ValueError(
            f"{name}: {column} goes from {values.min():g} to {values.max():g}: are these degrees? Name "
            f"the column {column}_deg, or {column}_rad if they are rad"
        )
    if column == "t" and len(values) > 1 and np.median(np.diff(values)) > SLOW:
        raise ValueError(
            f"{name}: most steps of t are {np.median(np.diff(values)):g}: are these ms? Name the column "
            "t_ms, or t_s if they are s"
        )


def _check_order(name, lines, t) -> None:
    late = np.flatnonzero(np.diff(t) <= 0)
    if late.size:
        k = int(late[0])
        raise ValueError(
            f"{name}, line {lines[k + 1]}: t is {t[k + 1]:g} s after {t[k]:g} s; needs increasing times"
        )


def _check_jumps(name, lines, column, angles) -> None:
    jumps = np.flatnonzero(np.abs(np.diff(angles)) >= math.pi)
    if jumps.size:
        k = int(jumps[0])
        raise ValueError(
            f"{name}, line {lines[k + 1]}: {column} jumps by {angles[k + 1] - angles[k]:.3g} rad; if "
            "the encoder starts again after a turn, use np.unwrap first"
        )


def _quoted(text) -> str:
    return repr(text if len(text) <= QUOTED else text[:QUOTED] + "…")
