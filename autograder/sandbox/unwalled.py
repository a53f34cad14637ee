"""Starts rooms without bubblewrap: lays out their folders, and lets a warm process fork them."""

import select
import shutil
import sys
import tempfile
import weakref
from pathlib import Path

from autograder.sandbox import nursery
from autograder.sandbox.bubblewrap import ENVIRONMENT, INSIDE

# A room's watch must end what is left in the room within this time.
END_SECONDS = 10.0


def command(script: str, folder: Path) -> tuple[list[str], dict[str, str]]:
    """The command that runs a script of INSIDE, laid out in the folder, and its environment."""
    inside = folder / ".room"  # apart from what cells write, and what was handed in
    for path, name in INSIDE.items():
        (inside / name).parent.mkdir(exist_ok=True, parents=True)
        shutil.copy(path, inside / name)
    environment = ENVIRONMENT | {
        name: str(folder) for name in ("HOME", "IPYTHONDIR", "MPLCONFIGDIR", "TMPDIR")
    }
    return [sys.executable, "-I", "-u", str(inside / script)], environment


class UnwalledNursery(nursery.Nursery):
    """A warm process without walls. Its folder holds the files that its rooms run.

    It removes its folder and those of its rooms when it ends, however this process ends.
    """

    def __init__(self):
        self._rooms: weakref.WeakSet[UnwalledProcess] = weakref.WeakSet()
        self._folder = tempfile.mkdtemp(prefix="warm-")
        super().__init__(*command("unwalled_forks.py", Path(self._folder)))

    def has_room(self, room: "UnwalledProcess") -> None:
        """Remember the room, to end it when this nursery ends."""
        self._rooms.add(room)

    def close(self) -> None:
        for room in list(self._rooms):
            room.end()
        super().close()
        shutil.rmtree(self._folder, ignore_errors=True)  # if the warm process could not


class UnwalledProcess(nursery.WarmProcess):
    """A room without walls: its processes, which are one group, and their folder."""

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
                # The watch ends after it has ended the processes that left its group.
                select.select([self._handle], [], [], END_SECONDS)
        super().end()
        self._remove_folder()

    def _remove_folder(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)
