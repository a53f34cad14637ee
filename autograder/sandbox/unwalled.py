"""Rooms without bubblewrap: what lies in their folders, and those that a warm process forks."""

import select
import shutil
import sys
import tempfile
import weakref
from pathlib import Path

from autograder.sandbox import nursery
from autograder.sandbox.bubblewrap import ENVIRONMENT, INSIDE

# For a room's watch to end what is left in the room.
END_SECONDS = 10.0


def command(script: str, folder: Path) -> tuple[list[str], dict[str, str]]:
    """What runs a script of INSIDE, laid out in the folder, and the environment to start it in."""
    inside = folder / ".room"  # apart from what cells write, and what was handed in
    for path, name in INSIDE.items():
        (inside / name).parent.mkdir(exist_ok=True, parents=True)
        shutil.copy(path, inside / name)
    environment = ENVIRONMENT | {
        name: str(folder) for name in ("HOME", "IPYTHONDIR", "MPLCONFIGDIR", "TMPDIR")
    }
    return [sys.executable, "-I", "-u", str(inside / script)], environment


class UnwalledNursery(nursery.Nursery):
    """A warm process without walls. Its folder holds the files that its rooms run; theirs are empty.

    It removes its own and theirs when it ends, however this process does.
    """

    def __init__(self):
        self._rooms: weakref.WeakSet[UnwalledProcess] = weakref.WeakSet()
        self._folder = tempfile.mkdtemp(prefix="warm-")
        super().__init__(*command("unwalled_forks.py", Path(self._folder)))

    def has_room(self, room: "UnwalledProcess") -> None:
        """To be ended with this: nothing else ends it."""
        self._rooms.add(room)

    def close(self) -> None:
        for room in list(self._rooms):
            room.end()
        super().close()
        shutil.rmtree(self._folder, ignore_errors=True)  # where it could not


class UnwalledProcess(nursery.WarmProcess):
    """A room's processes without walls, which are one group, and their folder."""

    def __init__(self, own: nursery.Nursery):
        self.folder = Path(tempfile.mkdtemp(prefix="room-"))
        try:
            super().__init__(own, str(self.folder))
        except OSError:
            self._remove_folder()
            raise
        if isinstance(own, UnwalledNursery):
            own.has_room(self)

    def end(self) -> None:
        if not self.ended:
            self._watch.close()
            if self._handle is not None:
                # The watch ends itself, after what is in no group of its own.
                select.select([self._handle], [], [], END_SECONDS)
        super().end()
        self._remove_folder()

    def _remove_folder(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)
