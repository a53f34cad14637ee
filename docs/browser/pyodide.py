"""Pyodide, Python for the browser: its list of packages (the lock file), and where their files are.

The site has a list of its own: Pyodide's, and what the course adds to it. So no page asks a package
registry for anything.
"""

import hashlib
import json
import re
import shutil
import urllib.request
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from jupyterlite_pyodide_kernel.constants import PYODIDE_CDN_URL

LOCK = "pyodide-lock.json"
START = "pyodide.mjs"
CORE = (START, "pyodide.asm.wasm", "python_stdlib.zip")
# Until 0.29, and since.
ASM = ("pyodide.asm.js", "pyodide.asm.mjs")
SECONDS = 60


class PyodideError(RuntimeError):
    """This Pyodide does not serve; the message says what it lacks."""


@dataclass(frozen=True)
class Wheel:
    """A package that the site brings. imports: what a cell imports it by. needs: packages."""

    name: str
    version: str
    file: str
    data: bytes
    imports: tuple[str, ...]
    needs: tuple[str, ...] = ()

    def entry(self) -> dict:
        """Its entry in the lock file."""
        return {
            "name": self.name,
            "version": self.version,
            "file_name": self.file,
            "install_dir": "site",
            "sha256": hashlib.sha256(self.data).hexdigest(),
            "package_type": "package",
            "imports": list(self.imports),
            "depends": list(self.needs),
            "unvendored_tests": False,
        }


@dataclass(frozen=True)
class Pyodide:
    """place: its folder or its address. lock: its lock file."""

    place: Path | str
    lock: dict

    @classmethod
    def in_folder(cls, folder: Path) -> "Pyodide":
        """The one in a folder, as Pyodide's releases hold it; PyodideError where a part is missing."""
        missing = [name for name in (LOCK, *CORE) if not (folder / name).is_file()]
        if not any((folder / name).is_file() for name in ASM):
            missing.append(ASM[-1])
        if missing:
            raise PyodideError(f"{folder} is no Pyodide: it has no {', '.join(missing)}")
        return cls(folder, json.loads((folder / LOCK).read_text(encoding="utf-8")))

    @classmethod
    def at_its_address(cls) -> "Pyodide":
        """The one that the kernel is made for, at its official address."""
        try:
            with urllib.request.urlopen(f"{PYODIDE_CDN_URL}/{LOCK}", timeout=SECONDS) as reply:
                return cls(PYODIDE_CDN_URL, json.load(reply))
        except (OSError, ValueError) as error:
            raise PyodideError(
                f"{PYODIDE_CDN_URL}/{LOCK} could not be read: {error}. "
                "ARMDYN_PYODIDE can name a folder with Pyodide instead."
            ) from error

    def has(self, name: str) -> bool:
        """Whether this package and all that it needs are there."""
        try:
            return all(self._is_there(package) for package in self._with_all_it_needs([name]))
        except KeyError:
            return False

    def write(self, to: Path, wheels: Iterable[Wheel], packages: Iterable[str]) -> None:
        """Write the list of packages and the course's own into the folder; and, where Pyodide is a
        folder, Pyodide itself, with what these packages of it need.
        """
        to.mkdir(parents=True, exist_ok=True)
        own = {_normal(wheel.name): wheel for wheel in wheels}
        for wheel in own.values():
            (to / wheel.file).write_bytes(wheel.data)
        if isinstance(self.place, Path):
            kept = self._copy_to(to, [name for name in packages if _normal(name) not in own])
        else:
            kept = {
                name: {**entry, "file_name": f"{self.place}/{entry['file_name']}"}
                for name, entry in self.lock["packages"].items()
            }
        kept |= {name: wheel.entry() for name, wheel in own.items()}
        (to / LOCK).write_text(json.dumps({**self.lock, "packages": kept}), encoding="utf-8")

    def _copy_to(self, to: Path, packages: list[str]) -> dict:
        place = Path(self.place)
        kept = self._with_all_it_needs(packages)
        for name in (*CORE, *ASM, *(entry["file_name"] for entry in kept.values())):
            if name not in ASM or (place / name).is_file():
                shutil.copyfile(place / name, to / name)
        return kept

    def _with_all_it_needs(self, names: Iterable[str]) -> dict:
        """The entries of these packages and of all that they need; KeyError where one has none."""
        entries = {_normal(name): entry for name, entry in self.lock["packages"].items()}
        found: dict = {}
        ahead = [_normal(name) for name in names]
        while ahead:
            name = ahead.pop()
            if name not in found:
                found[name] = entries[name]
                ahead += map(_normal, entries[name]["depends"])
        return found

    def _is_there(self, name: str) -> bool:
        entry = self._with_all_it_needs([name])[name]
        return isinstance(self.place, str) or (self.place / entry["file_name"]).is_file()


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()
