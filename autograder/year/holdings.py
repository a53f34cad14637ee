"""What of a course's folder an archive keeps."""

import os
import stat
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

COURSE = "course"
MADE_AGAIN = ("cache-of-results",)  # in course/: what commands make again when it is needed
OF_THE_MOMENT = ("grading.lock",)
PARTS = (".part", "-journal", "-wal", "-shm")  # what a file ends with that is being written
# How a platform knows the course: of no year, and who has the key can send marks.
OF_THE_PLATFORM = ("lti-key.pem", "lti-public.pem", "lti-key-set.json", "lti.toml")
BESIDE_IT = (
    "solutions",
    "checks",
    "nbgrader_config.py",
)  # without which no mark could be explained


@dataclass
class Holdings:
    """files: by their names in the archive. left: what cannot be kept, each with the reason."""

    files: dict[str, Path] = field(default_factory=dict)
    left: list[str] = field(default_factory=list)


def holdings(root: Path) -> Holdings:
    """What an archive keeps of the course in the folder `root`; no link is followed below course/."""
    found = Holdings()
    for top in (root / COURSE, *(root / name for name in BESIDE_IT)):
        for path in [top] if top.is_file() else _below(top):
            name = path.relative_to(root).as_posix()
            if _passing(path.relative_to(root)):
                continue
            if why := _unfit(path, name):
                found.left.append(f"{name} is not kept: {why}")
            else:
                found.files[name] = path
    return found


def _below(folder: Path) -> Iterator[Path]:
    """All that is in a folder and is no folder; what stands directly in it may be a link to one."""
    for path in sorted(folder.iterdir()) if folder.exists() else ():
        if path.name in (".ipynb_checkpoints", "__pycache__"):
            continue
        if not path.is_dir():
            yield path
            continue
        for above, folders, names in os.walk(path, onerror=_raise):
            links = [name for name in folders if os.path.islink(os.path.join(above, name))]
            yield from sorted(Path(above, name) for name in [*names, *links])


def _raise(error: OSError) -> None:
    raise error


def _passing(name: Path) -> bool:
    top, *below = name.parts
    if top != COURSE or not below:
        return False
    return below[0] in (*MADE_AGAIN, *OF_THE_MOMENT, *OF_THE_PLATFORM) or name.name.endswith(PARTS)


def _unfit(path: Path, name: str) -> str:
    try:
        name.encode("utf-8")
    except UnicodeEncodeError:
        return "its name is not UTF-8"
    kind = path.lstat().st_mode
    if stat.S_ISLNK(kind):
        return f"it is a link, to {os.readlink(path)}"
    return "" if stat.S_ISREG(kind) else "it is no plain file"
