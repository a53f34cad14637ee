"""A class's archive, taken apart for the browser: notebooks, the student's package, its numbers.

The numbers of the checks are many, and a cell needs those of one check. So they are no part of the
package here: the site serves them, a file a check, and the package asks for one when it is needed.
"""

import io
import json
import zipfile
from pathlib import Path, PurePosixPath

import nbformat

from autograder.bundle.archive import TOP
from autograder.bundle.wheel import write_wheel
from docs.browser import needs, notes
from docs.browser.pyodide import Wheel

HERE = Path(__file__).parent
HANDED_OUT = "autograder/handed_out/"
DATA = "autograder/stored/data/"
NUMBERS = f"{DATA}numbers-"
STARTS = "etc/ipython/startup/00-armdyn.py"


class Course:
    """version: that of the student's package. numbers: the stored checks, by file name."""

    def __init__(self, archive: Path):
        with zipfile.ZipFile(archive) as packed:
            every = {
                PurePosixPath(name).relative_to(TOP).as_posix(): packed.read(name)
                for name in packed.namelist()
            }
        (self._wheel,) = (name for name in every if name.endswith(".whl"))
        self.version = self._wheel.split("-")[1]
        with zipfile.ZipFile(io.BytesIO(every[self._wheel])) as wheel:
            self._package = {name: wheel.read(name) for name in wheel.namelist()}
        self.numbers = {
            name.removeprefix(DATA): data
            for name, data in self._package.items()
            if name.startswith(NUMBERS)
        }
        self._contents = {
            name: data for name, data in every.items() if name.startswith(("lessons/", "problems/"))
        }

    def write_contents(self, to: Path) -> None:
        """Write lessons and problems into the folder, each with what is different in a browser."""
        for name, data in self._contents.items():
            path = to / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if path.suffix == ".ipynb":
                notebook = nbformat.reads(data.decode(), as_version=4)
                notes.add(notebook, path.stem)
                data = nbformat.writes(notebook).encode()
            elif path.suffix == ".svg":
                # JupyterLite shows no picture with letters beyond Latin-1.
                data = data.decode().encode("ascii", "xmlcharrefreplace")
            path.write_bytes(data)

    def write_numbers(self, to: Path) -> None:
        """Write the numbers of the checks into the folder that `where_numbers_are` names."""
        folder = to / self.where_numbers_are
        folder.mkdir(parents=True)
        for name, data in self.numbers.items():
            (folder / name).write_bytes(data)

    @property
    def where_numbers_are(self) -> str:
        """Their folder in the site. A page that was open before a new version finds no wrong ones."""
        return f"static/numbers-{self.version.partition('+')[2]}"

    def package(self, folder: Path) -> Wheel:
        """The student's package without notebooks and numbers, as it is in a browser."""
        files = {
            name: data
            for name, data in self._package.items()
            if not name.startswith((HANDED_OUT, NUMBERS)) and ".dist-info/" not in name
        }
        files |= _sources(HERE / "in_student_package")
        where = {"folder": self.where_numbers_are, "names": sorted(self.numbers)}
        files["autograder/stored/where.json"] = json.dumps(where).encode()
        (text,) = (data for name, data in self._package.items() if name.endswith("/METADATA"))
        path = write_wheel(folder, "armdyn", self.version, text.decode(), "", files)
        return Wheel(
            *("armdyn", self.version, path.name, path.read_bytes()),
            ("armdyn", "autograder"), ("numpy",),
        )  # fmt: skip

    def start_up(self, folder: Path) -> Wheel:
        """What a kernel runs when it starts."""
        files = _sources(HERE / "in_kernel")
        files["in_browser/needs.json"] = json.dumps(needs.of_library(self._package)).encode()
        data = f"in_browser-{self.version}.data/data/"
        files[f"{data}{STARTS}"] = b'__import__("in_browser").start()\n'
        text = f"Metadata-Version: 2.1\nName: in-browser\nVersion: {self.version}\n"
        path = write_wheel(folder, "in_browser", self.version, text, "", files)
        return Wheel(
            *("in-browser", self.version, path.name, path.read_bytes()),
            ("in_browser",), ("numpy", "pyodide-kernel"),
        )  # fmt: skip


def _sources(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*.py"))
    }
