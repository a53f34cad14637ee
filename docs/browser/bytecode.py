"""The bytecode of what is imported before a first card: a page then need not compile it.

Python compiles a module when it is first imported, and a page has nowhere to keep the result. Only
Pyodide's own Python writes bytecode that it can read, and here it runs in Node.
"""

import hashlib
import json
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Iterable
from pathlib import Path

from docs.browser.pyodide import LOCK

SCRIPT = Path(__file__).with_name("start_in_node.mjs")
# By the kernel, and by the first cell of a problem.
IMPORTS = ("pyodide_kernel", "numpy", "sympy", "autograder")
# Bytecode beside the sources makes a page fetch more. Of these it saves most of the time, and what is
# fetched before a first card stays below 30 MB.
PACKAGES = ("numpy", "sympy", "armdyn", "ipython", "prompt-toolkit", "traitlets")
SECONDS = 300


class BytecodeError(RuntimeError):
    """Node is missing, or the site's Python did not start in it; the message says which."""


def add(folder: Path, at_once: Iterable[str]) -> None:
    """Put the bytecode into the packages of a site, beside their sources, and renew their list.

    folder: as `Pyodide.write` leaves it, with all of a Pyodide. at_once: the packages that a kernel has
    when it starts. BytecodeError, and then nothing is changed; OSError.
    """
    program = shutil.which("node") or shutil.which("nodejs")
    if not program:
        raise BytecodeError("Node, which would compile the packages, is not installed here")
    with tempfile.TemporaryDirectory(prefix="bytecode-") as made:
        command = [program, SCRIPT, folder.resolve(), made, ",".join(at_once), ",".join(IMPORTS)]
        try:
            ran = subprocess.run(
                command, capture_output=True, text=True, check=False, timeout=SECONDS
            )
        except subprocess.TimeoutExpired as error:
            raise BytecodeError(f"Python did not start in Node within {SECONDS} s") from error
        if ran.returncode:
            raise BytecodeError(f"Python did not start in Node: {ran.stderr.strip()[-1000:]}")
        put_in(folder, Path(made))


def put_in(folder: Path, made: Path) -> None:
    """Put each file below `made`, as a/__pycache__/b.cpython-312.pyc, into the wheel that has a/b.py."""
    files = {_source(path.relative_to(made)): path for path in made.rglob("*.pyc")}
    lock = json.loads((folder / LOCK).read_text(encoding="utf-8"))
    for entry in (entry for name, entry in lock["packages"].items() if name in PACKAGES):
        wheel = folder / entry["file_name"]
        with zipfile.ZipFile(wheel, "a", zipfile.ZIP_DEFLATED) as packed:
            for source in sorted(files.keys() & set(packed.namelist())):
                name = files[source].relative_to(made).as_posix()
                # Without a time: the same packages give the same file, of which browsers keep copies.
                packed.writestr(
                    zipfile.ZipInfo(name), files[source].read_bytes(), zipfile.ZIP_DEFLATED
                )
        entry["sha256"] = hashlib.sha256(wheel.read_bytes()).hexdigest()
    (folder / LOCK).write_text(json.dumps(lock), encoding="utf-8")


def _source(compiled: Path) -> str:
    return (compiled.parents[1] / f"{compiled.name.partition('.')[0]}.py").as_posix()
