"""python -m docs.browser FOLDER [ASSIGNMENT …]: writes the site, with these problems or all.

ARMDYN_PYODIDE names a folder with Pyodide, to be copied into the site. Without it, the pages fetch it
from Pyodide's official address.
"""

import os
import shutil
import sys
import tempfile
from pathlib import Path

from autograder.bundle.archive import BundleError, write_bundle
from autograder.nbgrader_glue import write_problem
from docs.browser import bytecode
from docs.browser.course import Course
from docs.browser.lite import AT_ONCE, PLACE, SiteError, build
from docs.browser.pyodide import Pyodide, PyodideError

ROOT = Path(__file__).parents[2]


def main(to: Path, assignments: list[str]) -> int:
    """Write the site; 1 with a line on stderr where it cannot be made."""
    try:
        folder = os.environ.get("ARMDYN_PYODIDE")
        pyodide = Pyodide.in_folder(Path(folder)) if folder else Pyodide.at_its_address()
        with tempfile.TemporaryDirectory(prefix="browser-") as work:
            bundle = write_bundle(ROOT, assignments, Path(work), write_problem)
            course = Course(bundle.path)
            site = Path(work) / "site"
            build(course, pyodide, site)
            slower = _add_bytecode(site) if folder else ""
            shutil.rmtree(to, ignore_errors=True)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(site, to)
    except (BundleError, PyodideError, SiteError, OSError) as error:
        print(f"docs.browser: {error}", file=sys.stderr)
        return 1
    print(f"{to}: written, version {course.version}. Pyodide is {pyodide.place}.")
    if slower:
        print(slower)
    print(
        "Serve it as it is, over https; browsers start no Python from a page opened from the disk."
    )
    return 0


def _add_bytecode(site: Path) -> str:
    """A line for whoever made the site, where its packages have to be compiled in each page."""
    try:
        bytecode.add(site / PLACE, AT_ONCE)
    except bytecode.BytecodeError as error:
        return f"A page starts some seconds later than it could: {error}."
    return ""


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))
