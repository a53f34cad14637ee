"""What Moodle and Canvas hand out, made as they make it.

From their sources: Moodle 4 and 5, mod/assign (classes/downloader.php, gradingtable.php) and PARAM_FILE,
and Canvas, lib/content_zipper.rb and lib/gradebook_exporter.rb.
"""

import csv
import io
import re
import zipfile
from pathlib import Path

MOODLE_HEADINGS = {
    "en": (
        *("Identifier", "Full name", "Email address", "Status", "Grade", "Maximum grade"),
        *("Grade can be changed", "Last modified (submission)", "Last modified (grade)"),
        "Feedback comments",
    ),
    "de": (
        *("ID", "Vollständiger Name", "E-Mail-Adresse", "Status", "Bewertung", "Bestwertung"),
        *("Bewertung kann geändert werden", "Zuletzt geändert (Abgabe)"),
        *("Zuletzt geändert (Bewertung)", "Feedback als Kommentar"),
    ),
}
HIDDEN_USER = {"en": "Participant ", "de": "Teilnehmer/in "}


def clean_filename(name: str) -> str:
    """Moodle's PARAM_FILE."""
    return re.sub(r"[\x00-\x1f\x7f&<>\"`|':\\/]", "", name)


def moodle_folder(name: str, number: int, since_4_1: bool = True) -> str:
    prefix = clean_filename(f"{name.replace('_', ' ')}_{number}")
    return f"{prefix}_assignsubmission_file{'' if since_4_1 else '_'}"


def canvas_name(sortable: str, user: int, file: int, display: str, late: bool = False) -> str:
    """sortable: as "Lovelace, Ada"."""
    name = re.sub(r"_(\d+)_", r"\1", sortable).lower()
    parts = [name, *(["LATE"] if late else []), str(user)]
    prefix = re.sub(r"[^\w]", "", "_".join(parts))
    shown = re.sub(r'[\x00/\\:*?"<>|]+', "_", display)
    return f"{prefix}_{file}_{shown}"


def zipped(path: Path, files: dict[str, bytes | str]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def moodle_sheet(path: Path, rows: list[dict], language: str = "en", most: str = "15.00") -> Path:
    """A grading worksheet. rows: number, name, email, and, where it is there, submitted and grade."""
    head = MOODLE_HEADINGS[language]
    table = io.StringIO(newline="")
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(head)
    for row in rows:
        submitted = row.get("submitted", "-")
        state = "No submission" if submitted == "-" else "Submitted for grading"
        writer.writerow(
            [
                f"{HIDDEN_USER[language]}{row['number']}",
                *(row["name"], row.get("email", ""), state, row.get("grade", ""), most, "Yes"),
                *(submitted, "-", ""),
            ]
        )
    path.write_text(table.getvalue(), encoding="utf-8")
    return path


def canvas_sheet(
    path: Path, rows: list[dict], titles: dict[str, str], sign: str = ",", bom: bool = False
) -> Path:
    """A gradebook. rows: name (sortable), number, sis, login, marks. titles: with their points."""
    head = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", *titles, "Current Score"]
    table = io.StringIO(newline="")
    writer = csv.writer(table, delimiter=sign, lineterminator="\n")
    writer.writerow(head)
    writer.writerow(["", "", "", "", "", *("Manual Posting" for _ in titles), ""])
    writer.writerow(["    Points Possible", "", "", "", "", *titles.values(), "(read only)"])
    for row in rows:
        marks = [row.get("marks", {}).get(title, "") for title in titles]
        about = (row["name"], row["number"], row.get("sis", ""), row.get("login", ""), "Group 1")
        writer.writerow([*about, *marks, ""])
    writer.writerow(["Student, Test", 99999, "", "a8f3", "Group 1", *("" for _ in titles), ""])
    path.write_text(table.getvalue(), encoding="utf-8-sig" if bom else "utf-8")
    return path
