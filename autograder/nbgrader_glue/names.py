"""Checks folders' names, which are students' ids: can nbgrader, gradebook and terminal handle them?"""

import glob
import os
import re
import shlex
import unicodedata
from collections.abc import Iterator

from nbgrader.converters.base import NbGraderException
from nbgrader.coursedir import CourseDirectory

from autograder.terminal import shown_name

MOST_CHARACTERS = 128  # the gradebook's column for ids holds no more
PATTERN = re.compile(r"[*?[]")
# Control characters, ends of lines and paragraphs; and characters that turn the text's direction.
UNFIT = {"Cc", "Zl", "Zp"}
TURNING = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}


def refusal(student: str) -> str:
    """Why a folder of this name cannot be graded, and what to do; empty if it can be."""
    return f"{why}: rename the folder" if (why := _fault(student)) else ""


def release_first(assignment: str) -> str:
    """What to do about an assignment that is not in the gradebook yet."""
    if found := PATTERN.search(assignment):
        return (
            f"nbgrader takes the {found[0]} in its name for a pattern, and cannot release it: give the "
            f"folder solutions/{assignment} and its notebook a name without it"
        )
    return f"run `nbgrader generate_assignment {shlex.quote(assignment)}` first"


def _fault(student: str) -> str:
    if re.search("[\ud800-\udfff]", student):  # bytes that Python could not read
        return "the folder's name is not UTF-8"
    for character in student:
        kind, turns = unicodedata.category(character), unicodedata.bidirectional(character)
        if kind in UNFIT or turns in TURNING:
            return f"the folder's name contains {character!a}, which no list can show"
    if found := PATTERN.search(student):
        return f"the folder's name contains {found[0]}, which nbgrader takes for a pattern"
    if student.startswith("."):
        return "the folder's name starts with a dot, so nbgrader does not see it"
    if len(student) > MOST_CHARACTERS:
        return (
            f"the folder's name has {len(student)} characters; the gradebook takes "
            f"{MOST_CHARACTERS} at most"
        )
    return ""


def folders(course: CourseDirectory, step: str, student: str, assignment: str) -> dict[str, str]:
    """Folder → student in one of the course's steps, in order, whatever the names contain.

    student, assignment: patterns, as `glob` has them. Excluded students are left out.
    """
    names = {"nbgrader_step": step, "student_id": student, "assignment_id": assignment}
    structure = course.directory_structure.format(**names)
    part = f"[^{re.escape(os.sep)}]*"
    wanted = course.format_path(step, f"(?P<student>{part})", part, escape=True)
    excluded = course.student_id_exclude.split(",")
    found = {}
    for folder in glob.glob(os.path.join(glob.escape(course.root), structure), include_hidden=True):
        match = re.fullmatch(wanted, folder)
        if match and match["student"] not in excluded:
            found[folder] = match["student"]
    return dict(sorted(found.items(), key=lambda item: item[::-1]))


def leave_out_unfit(converter) -> None:
    """Let an nbgrader command leave out the names that it cannot handle, with a line on each at its end.

    converter: nbgrader's own, which has found its notebooks and not touched them yet. Without this, a
    line break in a name stops the command, and a pattern matches other people's folders.
    """
    lines = list(_take_out(converter))
    if not lines:
        return
    convert = converter.convert_notebooks

    def convert_and_say() -> None:
        try:
            convert()
        finally:
            for line in lines:
                converter.log.error(line)
        raise NbGraderException("some folders were left out: see the lines above")

    converter.convert_notebooks = convert_and_say


def _take_out(converter) -> Iterator[str]:
    course = converter.coursedir
    step = converter._input_directory
    for folder, student in folders(course, step, course.student_id, course.assignment_id).items():
        if why := refusal(student):
            converter.assignments.pop(folder, None)
            yield f"{shown_name(student)} was left out: {why} in {step}"
