"""A private PostgreSQL server for a test, reached by its socket alone."""

import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

# The server refuses to run as root.
USER = {"user": "postgres"} if os.name == "posix" and os.geteuid() == 0 else {}
START_SECONDS = 120.0


@contextmanager
def running(programs: Path, superuser: str, auth: str) -> Iterator[Path]:
    """The folder of its socket. `programs`: where initdb is; `auth`: how it knows who asks."""
    folder = Path(tempfile.mkdtemp(prefix="postgresql-"))
    if USER:
        shutil.chown(folder, **USER)
    data = folder / "data"
    made = [
        *(programs / "initdb", f"--username={superuser}", f"--auth={auth}"),
        *("--no-sync", "--encoding=UTF8", data),
    ]
    subprocess.run(made, check=True, capture_output=True, cwd=folder, **USER)
    started = [programs / "postgres", "-D", data, "-k", folder, "-h", "", "-F"]
    with (folder / "log").open("wb") as log:
        process = subprocess.Popen(started, stdout=log, stderr=log, cwd=folder, **USER)
    try:
        _wait_for(programs / "pg_isready", folder, process)
        yield folder
    finally:
        process.terminate()
        process.wait(START_SECONDS)
        shutil.rmtree(folder)


def _wait_for(pg_isready: Path, folder: Path, process: subprocess.Popen) -> None:
    deadline = time.monotonic() + START_SECONDS
    while subprocess.run([pg_isready, "--quiet", "--host", folder]).returncode:
        assert process.poll() is None, (folder / "log").read_text()
        assert time.monotonic() < deadline, (folder / "log").read_text()
        time.sleep(0.1)
