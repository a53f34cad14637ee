"""Reads the times of Moodle's sheets, which are written out in the site's language.

"Sunday, 29 November 2026, 11:03 PM", "Sonntag, 29. November 2026, 23:03". Babel knows the words of all
languages. Where a word means different months, as listopad does, the day of the week tells which.
"""

import re
import unicodedata
from datetime import date, datetime, tzinfo
from functools import cache

from babel import Locale, localedata

CLOCKS = [
    re.compile(rf"\b(\d{{1,2}}){sign}(\d{{2}})(?:{sign}\d{{2}})?\b") for sign in (":", r"\.", "h")
]
YEAR = re.compile(r"(?<!\d)(?:19|20)\d\d(?!\d)")
IN_NUMBERS = re.compile(r"(\d{4})(?:年|[-/.])\s?(\d{1,2})(?:月|[-/.])\s?(\d{1,2})")
IN_DOTTED_NUMBERS = re.compile(r"\b(\d{1,2})\.\s?(\d{1,2})\.\s?(\d{4})")
WORD = re.compile(r"[^\W\d_]+(?:['’.-][^\W\d_]+)*")
AFTER_NOON = {"pm", "p.m", "p.m.", "下午", "오후", "μμ", "م"}
BEFORE_NOON = {"am", "a.m", "a.m.", "上午", "오전", "πμ", "ص"}


def is_like_one(cell: str) -> bool:
    """Whether a text has a year and a time of day in it."""
    return bool(_clock(cell) and YEAR.search(cell))


def read(cell: str, zone: tzinfo | None) -> datetime:
    """The time, with its zone. zone: the site's; None: this machine's. ValueError if it is not clear."""
    text = unicodedata.normalize("NFKC", cell).casefold()
    clock, year = _clock(text), YEAR.search(text)
    days = _days(text, clock, year) if clock and year else set()
    if len(days) != 1 or not clock:
        raise ValueError(f"{cell[:60]!r} is no time that can be read")
    hour, minute = int(clock[1]), int(clock[2])
    words = set(WORD.findall(text)) | {text[clock.end() :].strip(" ,.")}
    if AFTER_NOON & words and hour < 12:
        hour += 12
    elif BEFORE_NOON & words and hour == 12:
        hour = 0
    try:
        found = datetime.combine(days.pop(), datetime.min.time().replace(hour, minute))
    except ValueError:
        raise ValueError(f"{cell[:60]!r} is no time that can be read") from None
    return found.replace(tzinfo=zone) if zone else found.astimezone()


def _clock(text: str) -> re.Match | None:
    """The time of day: the last one, since a day comes before it."""
    found = [one for clock in CLOCKS for one in list(clock.finditer(text))[-1:]]
    return found[0] if found else None


def _days(text: str, clock: re.Match, year: re.Match) -> set[date]:
    """The dates that the text may mean."""
    rest = " ".join(
        part for part in (text[: clock.start()], text[clock.end() :]) if part
    ).replace(year[0], " ", 1)  # fmt: skip
    numbers = [int(one) for one in re.findall(r"\d+", rest)]
    if found := IN_NUMBERS.search(text):
        return _dates(*map(int, found.groups()))
    if found := IN_DOTTED_NUMBERS.search(text):
        return _dates(*map(int, reversed(found.groups())))
    if len(numbers) != 1:
        return set()
    words = set(WORD.findall(rest)) - AFTER_NOON - BEFORE_NOON
    known = [(months, weekdays, len(words & (months.keys() | weekdays.keys())))
             for months, weekdays in _languages()]  # fmt: skip
    most = max(count for *_, count in known)
    meant: set[date] = set()
    for months, weekdays, count in known:
        if count == most:  # one that knows less is not the language of the text
            said = {weekdays[word] for word in words if word in weekdays}
            for month in {months[word] for word in words if word in months}:
                days = _dates(int(year[0]), month, numbers[0])
                meant |= {day for day in days if not said or day.weekday() in said}
    return meant


def _dates(year: int, month: int, day: int) -> set[date]:
    try:
        return {date(year, month, day)}
    except ValueError:
        return set()


@cache
def _languages() -> list[tuple[dict[str, int], dict[str, int]]]:
    """Of each language the words for months (1 to 12) and for days of the week (0 is Monday)."""
    found = []
    for name in localedata.locale_identifiers():
        if "_" not in name:
            locale = Locale.parse(name)
            found.append((_words(locale.months), _words(locale.days)))
    return found


def _words(forms) -> dict[str, int]:
    return {
        word.casefold().strip("."): number
        for context in forms.values()
        for width in ("wide", "abbreviated")
        for number, name in context.get(width, {}).items()
        for word in WORD.findall(unicodedata.normalize("NFKC", name))
        if len(word) > 1
    }
