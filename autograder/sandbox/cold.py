"""Starts a room as a new process, in bubblewrap or, where that is missing, without."""

import os
import select
import signal
import socket
import subprocess
import tempfile
from contextlib import suppress
from functools import partial
from pathlib import Path

from autograder.sandbox import nursery, unwalled
from autograder.sandbox.bubblewrap import bubblewrapped


class ColdProcess:
    """A room's process, behind walls or without. requests, replies: descriptors of its pipes."""

    def __init__(self, walled: bool):
        self._walled = walled
        self._folder = tempfile.TemporaryDirectory(prefix="room-")
        start = bubblewrapped if walled else partial(unwalled.command, folder=self.folder)
        command, environment = start("runner.py")
        mine, watchs = socket.socketpair()
        with watchs:
            self._process = subprocess.Popen(
                [*command, str(watchs.fileno())],
                env=environment,
                cwd=self.folder,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                start_new_session=True,
                pass_fds=[watchs.fileno()],
            )
        self._watch = nursery.WatchLine(mine)
        pipes = (self._process.stdin, self._process.stdout, self._process.stderr)
        self._pipes = [pipe for pipe in pipes if pipe is not None]  # as asked for, all three
        self.requests, self.replies, self._errors = (pipe.fileno() for pipe in self._pipes)

    @property
    def folder(self) -> Path:
        return Path(self._folder.name)

    @property
    def ended(self) -> bool:
        return self._process.returncode is not None

    def ask_watch(self, request: str, seconds: float) -> tuple[float, float] | None:
        return self._watch.ask(request, seconds)

    def why_ended(self) -> str:
        ready, _, _ = select.select([self._errors], [], [], 0)
        text = os.read(self._errors, 4096).decode(errors="replace").strip() if ready else ""
        return self._watch.reason() or text

    def lost_its_warm_process(self) -> bool:
        return False

    def end(self) -> None:
        self._watch.close()
        if not self.ended:
            if not self._walled and hasattr(os, "pidfd_open"):
                self._await_watch()
            # Without bubblewrap there is no process namespace that ends with its first process, so
            # children may outlive it. The group's number is free only after `wait`.
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        for pipe in self._pipes:
            pipe.close()
        self._folder.cleanup()

    def _await_watch(self) -> None:
        """Wait until the watch ends, after it has ended the processes that left its group."""
        try:
            process = os.pidfd_open(self._process.pid)
        except OSError:
            return
        select.select([process], [], [], unwalled.END_SECONDS)
        os.close(process)
