"""What all processes of a test run share: the first that asks makes it, in pytest's folder."""

import os
import tempfile
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path

PATIENCE = 500.0  # s; a test has 600
# Pytest's folder of this run, as long as one runs: conftest.py says where.
folder: Path | None = None


def of_the_run(basetemp: Path) -> Path:
    """The folder of a whole run, by the one that a process of it has."""
    return (basetemp.parent if "PYTEST_XDIST_WORKER" in os.environ else basetemp) / "once"


@cache
def _own() -> tempfile.TemporaryDirectory:
    return tempfile.TemporaryDirectory(prefix="once-")


def made_once(name: str, make: Callable[[Path], object]) -> Path:
    """The folder `name`, which `make` fills; whoever reads it changes nothing in it."""
    top = folder or Path(_own().name)
    made, done, failed = (top / f"{name}{end}" for end in ("", ".done", ".failed"))
    try:
        made.mkdir(parents=True)
    except FileExistsError:
        end = time.monotonic() + PATIENCE
        while not done.exists():
            assert not failed.exists(), f"{name} could not be made: see the first failure"
            assert time.monotonic() < end, f"{name} is not made after {PATIENCE:g} s"
            time.sleep(0.1)
    else:
        try:
            make(made)
        except BaseException:
            failed.touch()
            raise
        done.touch()
    return made
