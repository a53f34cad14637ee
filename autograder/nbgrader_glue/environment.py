"""Environment variables that nbgrader sets for what it runs: gone again, also where that fails.

nbgrader 0.9 leaves them set after an error. In JupyterLab's server each kernel started later would then
take itself for one of Validate's, or of the grader's.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager

from nbgrader import utils


@contextmanager
def setenv(**values: str) -> Iterator[None]:
    """Set environment variables; at the end they are as before."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def mend() -> None:
    """Let nbgrader use this `setenv` in this process, in which Validate and the formgrader work."""
    utils.setenv = setenv
