"""A folder with Pyodide for the tests, from the one that ARMDYN_PYODIDE names.

It may be the current one, as Pyodide's releases hold it. It may also hold only the packages of 0.27.7:
then npm brings the core, and what the course needs of newer packages is put in.
"""

import hashlib
import json
import os
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest

OLD = "0.27.7"
# NumPy 2.2 has them, and 2.0 does not.
PRODUCTS = """

def matvec(x1, x2, /):
    return (x1 @ asarray(x2)[..., None])[..., 0]


def vecmat(x1, x2, /):
    return (asarray(x1).conj()[..., None, :] @ x2)[..., 0, :]
"""
# micropip 0.11 has it, and the kernel imports it, but calls it for no package of the lock file.
LAYER = "\n\nclass CompatibilityLayer:\n    pass\n"


def complete(to: Path, needs) -> Path:
    """The folder `to`, made, with all of a Pyodide; without the variable the test is skipped.

    needs: finds a program, or skips the test.
    """
    named = os.environ.get("ARMDYN_PYODIDE")
    if not named:
        pytest.skip("set ARMDYN_PYODIDE to a folder with Pyodide, which is not part of the project")
    to.mkdir()
    for path in Path(named).iterdir():
        (to / path.name).symlink_to(path)
    if not (to / "pyodide-lock.json").exists():
        _add_core(to, needs("npm"))
        _renew(to)
    return to


def _add_core(to: Path, npm: str) -> None:
    pack = [npm, "pack", "--silent", f"pyodide@{OLD}"]
    subprocess.run(pack, cwd=to, check=True, capture_output=True)
    with tarfile.open(to / f"pyodide-{OLD}.tgz") as core:
        for member in core:
            if (data := core.extractfile(member)) and not member.name.endswith("README.md"):
                (to / Path(member.name).name).write_bytes(data.read())


def _renew(to: Path) -> None:
    """Put what is newer into the packages, and their new sums into the lock file."""
    lock = json.loads((to / "pyodide-lock.json").read_text())
    for name, file, more in (
        ("numpy", "numpy/__init__.py", PRODUCTS),
        ("micropip", "micropip/package_index.py", LAYER),
    ):
        entry = lock["packages"][name]
        path = to / entry["file_name"]
        _append(path, file, more)
        entry["sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
    (to / "pyodide-lock.json").write_text(json.dumps(lock))


def _append(wheel: Path, file: str, more: str) -> None:
    with zipfile.ZipFile(wheel) as packed:
        every = {entry: packed.read(entry) for entry in packed.infolist()}
    wheel.unlink()  # a link to the folder's own
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_STORED) as packed:
        for entry, data in every.items():
            packed.writestr(entry, data + more.encode() * (entry.filename == file))
