"""Reads when a submission was handed in: nbgrader's timestamp.txt, and other usual forms of a time.

nbgrader takes "+0100" for 100 seconds, and a zone that it does not know for UTC; a text that is no time
stops the formgrader. So such a file is written again as nbgrader writes it. What it held stays
beside it.
"""

import errno
import os
import re
from datetime import UTC, datetime, timedelta, timezone, tzinfo
from pathlib import Path
from zoneinfo import ZoneInfo

from dateutil import parser  # type: ignore[import-untyped]
from nbgrader import utils

from autograder.files import put_in_place
from autograder.protocol import one_line

FILE = "timestamp.txt"
ORIGINAL = "timestamp-original.txt"
MOST_BYTES = 1000
AS = "2025-01-31 23:59:59 UTC"
# What RFC 5322 and European computers call them. Others, such as IST, are of several zones.
HOURS = {
    **{"UTC": 0, "UT": 0, "GMT": 0, "Z": 0, "WET": 0, "WEST": 1, "CET": 1, "MET": 1, "CEST": 2},
    **{"MEST": 2, "EET": 2, "EEST": 3, "EST": -5, "EDT": -4, "CST": -6, "CDT": -5, "MST": -7},
    **{"MDT": -6, "PST": -8, "PDT": -7},
}
OFFSET = re.compile(r"\s*(?:UTC|GMT)?([+-])(\d{1,2}):?(\d\d)?$")
PLACE = re.compile(r"\s+([A-Za-z]+(?:/[A-Za-z0-9_+-]+)+)$")
DATE = re.compile(r"\d{4}-\d{1,2}-\d{1,2}|\b[A-Z][a-z]{2,8}\b")


def read(text: str) -> datetime | None:
    """The time in UTC, without its zone, as nbgrader keeps it; None for an empty text.

    A time without a zone is in UTC, as nbgrader has it. ValueError if it is no time, or if its zone is
    not known.
    """
    text = text.strip()
    if not text:
        return None
    try:
        found = datetime.fromisoformat(text)
    except ValueError:
        found = _of_words(text)
    try:
        return found.astimezone(UTC).replace(tzinfo=None) if found.tzinfo else found
    except OverflowError:
        raise ValueError(f"{text!r} is out of range") from None


def _of_words(text: str) -> datetime:
    zone: tzinfo | None = None
    if place := PLACE.search(text):
        try:
            zone = ZoneInfo(place[1])
        except Exception:  # of several kinds, as it looks for a file of this name
            raise ValueError(f"no zone is called {place[1]}") from None
        text = text[: place.start()]
    elif offset := OFFSET.search(text):
        hours, minutes = int(offset[2]), int(offset[3] or 0)
        if ":" in text[: offset.start()]:
            sign = -1 if offset[1] == "-" else 1
            zone = timezone(sign * timedelta(hours=hours, minutes=minutes))
            text = text[: offset.start()]
    if not DATE.search(text):
        raise ValueError(f"{text!r} does not say which number is the month")
    # What the text leaves out is taken from the default.
    first, second = (_parsed(text, datetime(*day)) for day in ((2001, 1, 1), (2002, 2, 2)))
    if first != second:
        raise ValueError(f"{text!r} has no day, month or year")
    return first.replace(tzinfo=zone) if zone else first


def _parsed(text: str, default: datetime) -> datetime:
    return parser.parse(text, default=default, tzinfos=_zone)


def _zone(name: str | None, offset: int | None) -> tzinfo | None:
    if offset is not None:
        return timezone(timedelta(seconds=offset))
    if name is None:
        return None
    if name not in HOURS:
        raise ValueError(f"several zones, or none, are called {name}")
    return timezone(timedelta(hours=HOURS[name]))


def of(folder: Path) -> datetime | None:
    """What timestamp.txt in a submission's folder says, in UTC; None if it is not there, or empty.

    Where nbgrader would read something else, the file is written again, or, if it holds no time, put
    aside. ValueError, or OSError, if that cannot be done.
    """
    path = folder / FILE
    if not os.path.lexists(path):
        return None
    if not path.is_file():  # to read a pipe would wait for ever
        raise OSError(errno.EINVAL, "it is no plain file")
    with path.open("rb") as file:
        held = file.read(MOST_BYTES)
    try:
        found = read(held.decode("utf-8-sig"))
    except ValueError:  # of which a text that is not UTF-8 is one
        path.replace(folder / ORIGINAL)
        return None
    if found is not None and _of_nbgrader(path) != found:
        put_in_place(folder / ORIGINAL, held)  # never through a link of a student's
        put_in_place(path, f"{found:%Y-%m-%d %H:%M:%S} UTC\n")
    return found


def _of_nbgrader(path: Path) -> datetime | None:
    try:
        return utils.parse_utc(path.read_text().strip())
    except Exception:
        return None


def note(folder: Path) -> str:
    """What the instructor has to know of a submission's time; "" for nothing."""
    original = folder / ORIGINAL
    if (folder / FILE).exists() or not original.is_file():
        return ""
    with original.open("rb") as file:
        held = one_line(file.read(MOST_BYTES).decode(errors="replace").strip(), 60)
    return (
        f"{FILE} held no time that can be read ({held!r}), and is now called {ORIGINAL}: there is no "
        f"penalty until you write the time into {FILE}, such as {AS}"
    )
