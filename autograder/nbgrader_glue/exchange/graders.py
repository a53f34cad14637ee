"""The graders' side of the exchange: what is collected is read as what a stranger wrote."""

import glob
import os
import shutil
import stat
import tempfile
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import nbformat
from nbgrader.exchange import ExchangeError, default
from nbgrader.utils import ignore_patterns
from traitlets import Bool

from autograder.nbgrader_glue import agreement
from autograder.nbgrader_glue.exchange.entered import Entered
from autograder.nbgrader_glue.foreign_folder import ForeignFolderError, copy_foreign
from autograder.terminal import shown_names

# What a student's clock and a slow disk may differ by.
TOLERANCE = timedelta(minutes=5)


class ReleaseFeedback(Entered, default.ExchangeReleaseFeedback):
    """Also lets students read the pages where the graders' own files are closed. Leaves out who did not
    hand in through the exchange: such a student has no secret to fetch a page by.
    """

    src_path: str

    def copy_files(self) -> None:
        folders = sorted({os.path.dirname(page) for page in glob.glob(f"{self.src_path}/*.html")})
        elsewhere = [folder for folder in folders if not _from_the_exchange(Path(folder))]
        if not folders:
            name = self.coursedir.assignment_id
            self.log.warning(
                "There are no pages of %s to release: `nbgrader generate_feedback %s` writes them",
                *(name, name),
            )
        for folder in folders:
            if folder not in elsewhere:
                self.src_path = glob.escape(folder)
                super().copy_files()
        if elsewhere:
            self.log.warning(
                "No page was released to %s, who handed in otherwise than through the exchange. "
                "To give it to them by Moodle: `autograder export --for moodle %s --feedback …`",
                shown_names(Path(folder).parent.name for folder in elsewhere),
                self.coursedir.assignment_id,
            )
        for page in os.scandir(self.dest_path):
            if page.stat().st_uid == os.geteuid():
                os.chmod(page.path, 0o644)


class ReleaseAssignment(Entered, default.ExchangeReleaseAssignment):
    """Also sees to it that nobody can remove or rename what another hands in."""

    def ensure_root(self) -> None:
        try:
            if not os.path.exists(self.root):
                os.makedirs(self.root)
                os.chmod(self.root, 0o755)
        except OSError as error:
            self.fail(f"The exchange cannot be made: {error}.")
        super().ensure_root()

    def init_dest(self) -> None:
        try:
            super().init_dest()
        except PermissionError as error:
            self.fail(f"The course cannot be set up in the exchange: {error}.")
        self._tell_what_is_older()
        mode = stat.S_IMODE(os.stat(self.inbound_path).st_mode)
        os.chmod(self.inbound_path, mode | stat.S_ISVTX | stat.S_ISGID)

    def _tell_what_is_older(self) -> None:
        course, name = self.coursedir, self.coursedir.assignment_id
        source = Path(course.format_path(course.source_directory, ".", name), f"{name}.ipynb")
        released = Path(self.src_path, f"{name}.ipynb")
        try:
            made = nbformat.read(source, as_version=4)
            found = agreement.from_release(made, released.read_text(encoding="utf-8"))
        except (OSError, ValueError):  # no source on this machine, or one that is being written
            return
        if found:
            self.log.warning(
                "Students get the release as it was made last, and solutions/%s has changed since: %s. "
                "To release what is there now, %s, and then this command again with --force",
                *(name, agreement.few(found), agreement.again(name)),
            )


class Collect(Entered, default.ExchangeCollect):
    """Takes only what its owner handed in, and no link. A later hand-in takes the place of an earlier
    one, which stays if the later one cannot be taken.
    """

    update = Bool(
        True, help="Whether a later hand-in takes the place of one that was collected before."
    ).tag(config=True)

    src_records: list[dict[str, Any]]

    def init_src(self) -> None:
        super().init_src()
        self.src_records = [r for r in self.src_records if r["username"] is not None]

    def _path_to_record(self, path: str) -> dict[str, Any]:
        """nbgrader's; one that must not be taken is nobody's, and so is in nobody's way."""
        nobody = {"username": None, "filename": path, "timestamp": datetime.min}
        try:
            record = super()._path_to_record(path)
            owner = _owner(path)
        except (ExchangeError, ValueError, OverflowError, OSError) as error:
            self.log.warning("%s is left out: %s", path, error)
            return nobody
        if self.check_owner and owner != record["username"]:
            self.log.warning("%s is left out: it belongs to the account %s.", path, owner)
            return nobody
        return record

    def copy_files(self) -> None:
        self.refused: list[str] = []
        self.src_records = [r for r in self.src_records if not self._is_by_hand(r["username"])]
        with tempfile.TemporaryDirectory(prefix="collected-") as aside:
            before = {}
            for number, record in enumerate(self.src_records):
                there = self._collected(record["username"])
                if self.coursedir.get_existing_timestamp(str(there)) not in (
                    None,
                    record["timestamp"],
                ):
                    kept = shutil.copytree(there, Path(aside, str(number)), symlinks=True)
                    before[record["username"]] = kept
            try:
                super().copy_files()
            finally:
                for student, kept in before.items():
                    if not self._collected(student).exists():
                        shutil.copytree(kept, self._collected(student), symlinks=True)
        if self.refused:
            self.fail("Not collected: " + "; ".join(self.refused))

    def _collected(self, student: str) -> Path:
        course = self.coursedir
        folder = course.format_path(course.submitted_directory, student, course.assignment_id)
        return Path(folder)

    def _is_by_hand(self, student: str) -> bool:
        """Whether somebody else has put a submission there, which no hand-in may replace unasked."""
        folder = self._collected(student)
        if not folder.is_dir() or (folder / "timestamp.txt").exists():
            return False
        self.log.warning(
            "%s has no timestamp.txt: it was not collected, and stays. To take the hand-in of %s "
            "instead, remove that folder",
            *(os.path.relpath(folder), student),
        )
        return True

    def do_copy(self, src: str, dest: str, log: Any = None) -> None:
        ignored: Callable[[str, list[str]], list[str]] = ignore_patterns(
            self.coursedir.ignore, self.coursedir.include, self.coursedir.max_file_size, self.log
        )
        try:
            most = 1000 * self.coursedir.max_dir_size
            changed = copy_foreign(Path(src), Path(dest), ignored, most)
        except (ForeignFolderError, OSError) as error:
            self.refused.append(f"{src}: {error}")
            return
        if self.coursedir.groupshared:
            self.set_perms(dest, fileperms=0o660, dirperms=0o2770)
        stated = super()._path_to_record(src)["timestamp"].replace(tzinfo=UTC)
        if datetime.fromtimestamp(changed, UTC) > stated + TOLERANCE:
            self.log.warning(
                "%s says that it was handed in at %s, but was changed at %s.",
                *(src, f"{stated:%Y-%m-%d %H:%M} UTC"),
                f"{datetime.fromtimestamp(changed, UTC):%Y-%m-%d %H:%M} UTC",
            )


def _from_the_exchange(folder: Path) -> bool:
    """Whether a page is of a hand-in with what nbgrader's exchange writes beside one."""
    return all((folder / name).is_file() for name in ("timestamp.txt", "submission_secret.txt"))


def _owner(path: str) -> str:
    """The account that a folder belongs to; ValueError if the path is no folder."""
    import pwd  # not on Windows, where nbgrader has no exchange

    found = os.lstat(path)
    if not stat.S_ISDIR(found.st_mode):
        raise ValueError("it is no folder.")
    try:
        return pwd.getpwuid(found.st_uid).pw_name
    except KeyError:
        return f"number {found.st_uid}"
