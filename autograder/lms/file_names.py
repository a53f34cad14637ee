"""Reads the names that Moodle and Canvas give to files: whose they are, and what students called them.

Moodle: "Ada Lovelace_1234_assignsubmission_file/p3-pendulum.ipynb" since 4.1; before, with "_" at the
folder's end; or, as teachers may choose, all in one folder with the file's name behind that. The number
is the participant's in this assignment. Canvas: "lovelaceada_LATE_98_7654_p3.ipynb", with the numbers
of the user and of the file.
"""

import re
import unicodedata
from dataclasses import dataclass

MOODLE, CANVAS = "Moodle", "Canvas"
IN_MOODLE = re.compile(r"([^_]*)_(\d+)_assignsubmission_([a-z]+)(?:_(.*))?", re.DOTALL)
IN_CANVAS = re.compile(r"(.*?)_(LATE_)?(\d+)_(?:(\d+)_(.+)|(text|link)\.html)", re.DOTALL)
ANONYMOUS = re.compile(r"(LATE_)?anon_[^_]+_(\d+_|text\.html$|link\.html$)")
# The browser's site saves a notebook under its whole path, in which browsers replace the slashes.
SLASH = r"[ _:-]"
# What browsers, JupyterLab, desktops and Canvas add to the name of a file that is there already.
COPY = r"(?:[ _-]*(?:\((\d+)\)|(?:copy|kopie|copie|copia)[ _-]*\(?(\d*)\)?|[_-](\d{1,3})))"
ENDING = re.compile(r"\.ipynb(\.txt|\.json)?$", re.IGNORECASE)


@dataclass(frozen=True)
class Origin:
    """Whose file it is, in the platform's words, and the parts of the path that the student gave it.

    name: as the platform writes it. number: the participant's or the user's. typed: text that was typed
    into the platform and is no file.
    """

    platform: str
    name: str
    number: str
    late: bool
    parts: tuple[str, ...]
    typed: bool = False


def origin(parts: tuple[str, ...]) -> Origin | None:
    """Where a file of an archive comes from; None if its name is neither Moodle's nor Canvas's."""
    for at, part in enumerate(parts):
        if found := IN_MOODLE.fullmatch(part):
            name, number, plugin, rest = found.groups()
            below = (*((rest,) if rest else ()), *parts[at + 1 :])
            return Origin(MOODLE, name, number, False, below, typed=plugin != "file")
    if len(parts) <= 2 and (found := IN_CANVAS.fullmatch(parts[-1])):  # its own folder, or none
        name, late, user, _, file, typed = found.groups()
        return Origin(CANVAS, name, user, bool(late), (file or typed,), typed=bool(typed))
    return None


def is_anonymous(parts: tuple[str, ...]) -> bool:
    return bool(ANONYMOUS.match(parts[-1]))


def copy_of(name: str, assignment: str) -> int | None:
    """Which copy of the assignment's notebook a file is by its name: 0 for the very name; None: no copy.

    "p3-pendulum (2).ipynb" is copy 2, "p3-pendulum-Copy1.ipynb" and "Copy of p3-pendulum.ipynb" copy 1.
    What the browser's site downloads, "problems_p3-pendulum_p3-pendulum.ipynb", is copy 0, too.
    """
    if name == f"{assignment}.ipynb":
        return 0
    name = unicodedata.normalize("NFKC", name)
    if not ENDING.search(name):
        return None
    stem = ENDING.sub("", name)
    of = re.match(r"(?:copy|kopie|copie|copia) (?:of|von|de|di) ", stem, re.IGNORECASE)
    words = r"[ _-]".join(map(re.escape, assignment.split("-")))
    folders = rf"(problems{SLASH}{words}{SLASH})?"
    stem = stem[of.end() if of else 0 :]
    found = re.fullmatch(rf"{folders}{words}({COPY}*)", stem, re.IGNORECASE)
    if not found:
        return None
    numbers = [int(number or 1) for *_, number in re.findall(r"(\(|[a-z_-])?(\d+)", found[2])]
    least = 0 if found[1] and not found[2] else 1
    return max([least, *numbers])
