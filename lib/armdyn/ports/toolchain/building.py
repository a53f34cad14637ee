"""Compiles source files once, and keeps the result under the hash of the sources."""

import hashlib
import json
import os
import platform
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from . import processes

# Templates can fail in a hundred thousand characters; the first of them say why.
LONGEST = 4000
SAID = "compiler.txt"


class BuildError(RuntimeError):
    """Sources do not compile; the message is what the compiler says."""


def build(
    files: Mapping[str, str], command: Sequence[str], cache: Path, seconds: float = 120
) -> Path:
    """The folder with these files and what the command makes of them; built now or kept from before.

    files: name, which may have folders in it, → text. command: run in the folder; () where there
    is nothing to compile. cache: the folder of all that is kept. Warnings of the compiler are kept
    beside the files, in compiler.txt. Raises BuildError with the compiler's own message, and where
    it takes longer than `seconds`.
    """
    made_from = json.dumps([dict(files), list(command), platform.platform()], sort_keys=True)
    folder = cache / hashlib.sha256(made_from.encode()).hexdigest()[:32]
    if folder.is_dir():
        return folder
    cache.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=cache, ignore_cleanup_errors=True) as unfinished:
        work = Path(unfinished) / "work"
        for name, text in files.items():
            (work / name).parent.mkdir(parents=True, exist_ok=True)
            (work / name).write_text(text, encoding="utf-8")
        said = _run(command, work, seconds) if command else ""
        (work / SAID).write_text(said, encoding="utf-8")
        try:
            # Renamed into place: another process never sees half of it.
            os.rename(work, folder)
        except OSError:
            if not folder.is_dir():  # otherwise another process was first, with the same
                raise
    return folder


def _run(command, folder, seconds) -> str:
    """What the command writes; BuildError if it fails."""
    pipe = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    process = processes.start(command, cwd=folder, **pipe)
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        raise BuildError(f"{Path(command[0]).name} took more than {seconds:g} s") from None
    finally:
        processes.end(process)
        if process.stdout is not None:
            process.stdout.close()
    said = output.decode(errors="replace").replace(f"{folder}{os.sep}", "").strip()
    if process.returncode:
        told = said or f"{Path(command[0]).name} ended with exit status {process.returncode}"
        raise BuildError(told if len(told) <= LONGEST else told[:LONGEST] + "\n…")
    return said
