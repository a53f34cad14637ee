"""Writes the archive for a class: lessons, released problems, the student's package, a start file."""

import json
import tempfile
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from importlib import metadata
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from autograder.bundle import BundleError
from autograder.bundle.earlier import earlier
from autograder.bundle.package import package
from autograder.bundle.wheel import write_wheel, zipped
from autograder.digest import digest
from autograder.files import put_in_place
from autograder.judging.check import Check
from autograder.nbgrader_glue.handed_in import mechanisms_beside
from autograder.notebook.beside import DEFINES
from autograder.notebook.version import version_of
from autograder.problems import MODULES, check_for, own_checks

TOP = "armdyn"
HERE = Path(__file__).parent / "to_start"
COMMANDS = "[console_scripts]\nautograder = autograder.cli:main\n"


@dataclass(frozen=True)
class Bundle:
    """What was written, its version, and the names of its assignments."""

    path: Path
    version: str
    assignments: tuple[str, ...]


def write_bundle(
    root: Path,
    assignments: Iterable[str],
    to: Path,
    release: Callable[[Path, str, Path], None],
    only_package: bool = False,
) -> Bundle:
    """Write the archive of these assignments; without any, of all in solutions/.

    root: the course's folder. to: the folder for the archive, which is made. release(root, assignment,
    folder): writes the student version of an assignment into the folder. only_package: write the
    student's package in place of an archive, without lessons and problems. BundleError, DescribingError,
    ShakingError or OSError where it cannot be made.
    """
    names = tuple(assignments) or tuple(
        path.parent.name
        for path in sorted((root / "solutions").glob("*/*.ipynb"))
        if path.stem == path.parent.name
    )
    if not names:
        raise BundleError(f"there is no assignment in {root / 'solutions'}")
    with tempfile.TemporaryDirectory(prefix="bundle-") as folder:
        course = dict(_lessons(root))
        own: list[Check] = []
        files_of: dict[str, str] = {}
        versions: dict[str, str] = {}
        for name in names:
            release(root, name, Path(folder) / name)
            source = nbformat.read(root / "solutions" / name / f"{name}.ipynb", as_version=4)
            mechanisms = mechanisms_beside(root / "solutions" / name)
            try:
                own_checks.refuse_broken(mechanisms)
            except own_checks.OwnChecksError as error:
                raise BundleError(str(error)) from error
            own += _own_checks(name, source, mechanisms)
            files_of |= mechanisms
            versions[name] = version_of(source, mechanisms)
            course |= _problem(name, Path(folder) / name)
        held = {"versions": versions, "earlier": earlier(root, versions)}
        told = {"armdyn.json": f"{json.dumps(held, indent=2)}\n".encode()}
        course |= told
        own_checks.import_again(files_of)
        completed = partial(own_checks.with_mistakes, files=files_of)
        files = package([name.replace("-", "_") for name in names], own, completed)
        brought = told if only_package else course
        files |= {f"autograder/handed_out/{path}": data for path, data in brought.items()}
        number = digest(*(part for path in sorted(files) for part in (path, files[path])))[:8]
        version = f"{metadata.version('armdyn')}+{number}"
        to.mkdir(parents=True, exist_ok=True)
        wheel = write_wheel(Path(folder), "armdyn", version, _metadata(version), COMMANDS, files)
        if only_package:
            path = to / wheel.name
            put_in_place(path, wheel.read_bytes())
            return Bundle(path, version, names)
        every = {**course, wheel.name: wheel.read_bytes()} | dict(_beside(root, wheel.name))
        path = to / f"armdyn-{number}.zip"
        path.write_bytes(zipped({f"{TOP}/{name}": data for name, data in every.items()}))
    return Bundle(path, version, names)


def _lessons(root: Path) -> Iterable[tuple[str, bytes]]:
    for path in sorted((root / "lessons").rglob("*")):
        parts = path.relative_to(root).parts
        if path.is_file() and not any(part.startswith((".", "_")) for part in parts):
            yield "/".join(parts), path.read_bytes()


def _problem(name: str, released: Path) -> dict[str, bytes]:
    """The files of a released problem."""
    found = {}
    for path in sorted(path for path in released.rglob("*") if path.is_file()):
        data = path.read_bytes()
        if path.suffix == ".py" and DEFINES.search(data.decode(errors="replace")):
            continue  # its energies lead to every answer
        found[f"problems/{name}/{path.relative_to(released).as_posix()}"] = data
    return found


def _own_checks(name: str, source: NotebookNode, files: Mapping[str, str]) -> Iterable[Check]:
    """Those of mechanisms, and those of the course's own files; none of the kit's problems."""
    of_kit = name.replace("-", "_") in {module.__name__.split(".")[-2] for module in MODULES}
    for cell in source.cells:
        id = (cell.metadata.get("nbgrader") or {}).get("grade_id", "")
        if of_kit and not own_checks.check_of(id, files):
            continue
        if check := check_for(id, None, files):
            yield check


def _beside(root: Path, wheel: str) -> Iterable[tuple[str, bytes]]:
    for path in sorted(HERE.iterdir()):
        if path.is_file():
            yield path.name, path.read_text(encoding="utf-8").replace("{wheel}", wheel).encode()
    for name in ("LICENSE", "constraints.txt"):
        if (root / name).is_file():
            yield name, (root / name).read_bytes()


def _metadata(version: str) -> str:
    """METADATA: what the package needs, as this installation says it."""
    kept = []
    for said in metadata.requires("armdyn") or []:
        when = said.partition(";")[2]
        if "extra ==" not in when or 'extra == "lab"' in when:
            kept.append(f"Requires-Dist: {said}")
    lines = [
        "Metadata-Version: 2.4",
        "Name: armdyn",
        f"Version: {version}",
        f"Summary: {metadata.metadata('armdyn')['Summary']}",
        f"License-Expression: {metadata.metadata('armdyn')['License-Expression']}",
        f"Requires-Python: {metadata.metadata('armdyn')['Requires-Python']}",
        "Provides-Extra: lab",
        *kept,
    ]
    return "\n".join(lines) + "\n"
