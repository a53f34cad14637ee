"""Which files of a course name a student, beside those that are only about this one."""

import html
import re
import unicodedata
import zipfile
from collections.abc import Iterable
from pathlib import Path

from autograder import roster, term_calendar
from autograder.lti.sent import FILE as SENT
from autograder.roster import Person, folded

# What commands write about the whole class, and can write again without the student.
WRITTEN = ("course/report/*.html", "course/grades.csv", "course/marks*.csv")
OTHERS = ("*.csv", "*.zip", "course/*")
# A student is removed from these line by line.
BY_LINE = (roster.FILE, term_calendar.FILE, SENT)
MOST_BYTES = 64 << 20
FEEDBACK = "_assignfeedback_file/"  # in an archive of feedback pages, as a platform takes it


class Called:
    """What a student is called: the id, the address and the full name in both orders."""

    def __init__(self, person: Person):
        forms = [rf"(?-i:(?<![\w.@-]){re.escape(person.id)}(?![\w@-]))"]
        if person.email:
            forms.append(rf"(?<![\w.+-]){re.escape(person.email)}(?![\w-])")
        first, last = map(_words, (person.first_name, person.last_name))
        self._short = person.keys if first and last else set()
        for words in (first + last, last + first) if first and last else ():
            name = r"[^\w\n]+".join(map(re.escape, words))
            forms.append(rf"(?<!\w){name}(?!\w)")
        self._forms = re.compile("|".join(forms), re.IGNORECASE)

    def in_text(self, text: str) -> bool:
        return bool(self._forms.search(_plain(text)))

    def in_file(self, path: Path) -> bool:
        """Whether a text names the student, or an archive by its files' names or its table of marks."""
        if zipfile.is_zipfile(path):
            return self._in_archive(path)
        if path.stat().st_size > MOST_BYTES:
            return False
        data = path.read_bytes()
        wide = data[:2] in (b"\xff\xfe", b"\xfe\xff")
        return self.in_text(data.decode("utf-16" if wide else "utf-8", errors="replace"))

    def _in_archive(self, path: Path) -> bool:
        try:
            with zipfile.ZipFile(path) as archive:
                names = archive.namelist()
                tables = [name for name in names if name.endswith("/marks.csv")]
                texts = [archive.read(name).decode("utf-8", errors="replace") for name in tables]
        except (OSError, zipfile.BadZipFile):
            return False
        whose = {folded(re.split(r"[/_]", name)[0]) for name in names}
        return bool(self._short & whose) or any(self.in_text(text) for text in [*names, *texts])


def _words(name: str) -> list[str]:
    return re.findall(r"\w+", _plain(name))


def _plain(text: str) -> str:
    return unicodedata.normalize("NFKC", html.unescape(text))


def written(root: Path, called: Called) -> list[Path]:
    """Files of the class that name the student, and that a command can write again."""
    pages = [path for path in root.glob("course/*.zip") if _is_feedback(path)]
    return [path for path in [*_files(root, WRITTEN), *sorted(pages)] if called.in_file(path)]


def mentions(root: Path, called: Called) -> list[Path]:
    """Other files that do: somebody's own, and the archives of `autograder archive`."""
    ours = written(root, called)
    files = _files(root, (*OTHERS, "archive/*.zip"))
    return [
        path
        for path in files
        if path not in ours
        and path.relative_to(root) not in BY_LINE
        and ".db" not in path.suffixes
        and called.in_file(path)
    ]


def _is_feedback(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
    except (OSError, zipfile.BadZipFile):
        return False
    return bool(names) and all(FEEDBACK in name for name in names)


def _files(root: Path, patterns: Iterable[str]) -> list[Path]:
    return [path for one in patterns for path in sorted(root.glob(one)) if path.is_file()]
