"""The archive of feedback files that Moodle takes in: a folder a participant, named as Moodle reads it.

Moodle splits a folder's name at each "_" and looks for the participant's number in the second part; so a
name must hold no "_" of its own.
"""

import io
import re
import zipfile
from pathlib import Path

from autograder.roster import Person

UNFIT = re.compile(r"[_/\\:*?\"<>|\x00-\x1f\x7f]+")
MADE = (2000, 1, 1, 0, 0, 0)  # the same pages make the same archive


def feedback_archive(
    found: dict[str, Person], pages: dict[str, list[Path]]
) -> tuple[bytes, list[str]]:
    """The archive, and who has no page. found: by participant's number; pages: by student."""
    made, without = io.BytesIO(), []
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, person in found.items():
            if not pages.get(person.id):
                without.append(person.id)
            for page in pages.get(person.id, []):
                name = UNFIT.sub(" ", person.name).strip(" .") or "student"
                info = zipfile.ZipInfo(f"{name}_{number}_assignfeedback_file/{page.name}", MADE)
                info.compress_type = zipfile.ZIP_DEFLATED
                info.external_attr = 0o644 << 16
                archive.writestr(info, page.read_bytes())
    return made.getvalue(), without
