"""Copies a folder that another account owns and may change meanwhile."""

import os
import shutil
import stat
from collections.abc import Callable
from pathlib import Path

MOST_FILES = 10_000
MOST_LEVELS = 32  # each holds a file descriptor
# A link is not followed, and a pipe does not keep us waiting.
_READ = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)


class ForeignFolderError(Exception):
    """Something in the folder must not be copied; the message names it."""


def copy_foreign(
    source: Path, target: Path, ignored: Callable[[str, list[str]], list[str]], most_bytes: int
) -> float:
    """Copy a folder's plain files, and say when the last of them was changed (seconds since 1970).

    Our account can read more than the folder's owner can. So no link is followed, also where one takes
    the place of a folder while we read, and each file has to be the owner's own. `ignored` gets a folder
    and the names in it, and says which of them stay behind. ForeignFolderError, with nothing left of the
    copy, if something is no plain file, or too much.
    """
    try:
        return _copied(source, target, ignored, most_bytes)
    except BaseException:
        shutil.rmtree(target, ignore_errors=True)
        raise


def _copied(source: Path, target: Path, ignored, most_bytes: int) -> float:
    owner = os.lstat(source).st_uid
    changed, files, size = 0.0, 0, 0
    for root, folders, names, opened in os.fwalk(source, onerror=_give_up, follow_symlinks=False):
        inside = Path(root).relative_to(source)
        if len(inside.parts) > MOST_LEVELS:
            raise ForeignFolderError(f"{inside.parts[0]} holds more than {MOST_LEVELS} folders")
        files += len(folders) + len(names)
        if files > MOST_FILES:
            raise ForeignFolderError(f"there are more than {MOST_FILES} files")
        left_out = set(ignored(root, [*folders, *names]))
        folders[:] = [name for name in folders if name not in left_out]
        for name in folders:
            if not stat.S_ISDIR(os.stat(name, dir_fd=opened, follow_symlinks=False).st_mode):
                raise ForeignFolderError(f"{inside / name} is a link")
        (target / inside).mkdir(parents=True)
        for name in sorted(set(names) - left_out):
            what = inside / name
            try:
                here = os.open(name, _READ, dir_fd=opened)
            except OSError as error:
                raise ForeignFolderError(f"{what} is a link, or unreadable: {error}") from error
            with open(here, "rb") as file:
                found = os.fstat(here)
                if not stat.S_ISREG(found.st_mode):
                    raise ForeignFolderError(f"{what} is no plain file")
                if found.st_uid != owner:
                    raise ForeignFolderError(f"{what} belongs to somebody else")
                size += found.st_size
                if size > most_bytes:
                    raise ForeignFolderError(f"there is more than {most_bytes / 1e6:g} MB")
                with open(target / what, "xb") as copy:
                    _copy_bytes(file, copy, found.st_size, what)
            os.utime(target / what, ns=(found.st_atime_ns, found.st_mtime_ns))
            changed = max(changed, found.st_ctime)
    return changed


def _copy_bytes(file, copy, size: int, what: Path) -> None:
    """Copy as many bytes as there were when the file was opened: it may grow without an end."""
    while size and (part := file.read(min(size, 1 << 20))):
        copy.write(part)
        size -= len(part)
    if size:
        raise ForeignFolderError(f"{what} was cut while it was read")


def _give_up(error: OSError) -> None:
    raise error
