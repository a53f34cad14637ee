"""The graders' side of the exchange: what is collected is read as what a stranger wrote."""

import os
import stat
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from nbgrader.exchange import ExchangeError, default
from nbgrader.utils import ignore_patterns

from autograder.nbgrader_glue.exchange.entered import Entered
from autograder.nbgrader_glue.foreign_folder import ForeignFolderError, copy_foreign

# What a student's clock and a slow disk may differ by.
TOLERANCE = timedelta(minutes=5)


class ReleaseFeedback(Entered, default.ExchangeReleaseFeedback):
    """Also lets students read the pages where the graders' own files are closed."""

    def copy_files(self) -> None:
        super().copy_files()
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
        mode = stat.S_IMODE(os.stat(self.inbound_path).st_mode)
        os.chmod(self.inbound_path, mode | stat.S_ISVTX | stat.S_ISGID)


class Collect(Entered, default.ExchangeCollect):
    """Takes only what its owner handed in, and no link."""

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
        super().copy_files()
        if self.refused:
            self.fail("Not collected: " + "; ".join(self.refused))

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
