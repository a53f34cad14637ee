"""Wheels of packages that are installed here: pure Python, for what a Pyodide does not have."""

import re
import tempfile
from importlib import metadata
from pathlib import Path

from autograder.bundle.wheel import write_wheel
from docs.browser.pyodide import Wheel

# A package's own tests are half of SymPy.
LEFT_OUT = re.compile(r"(^|/)(tests?|benchmarks?|__pycache__)/|^\.\.|\.dist-info/|\.(pyc|so|pyd)$")


class NotPureError(ValueError):
    """A package is not pure Python, so it runs in no browser."""


def wheel_of(name: str, imports: str, needs: tuple[str, ...] = ()) -> Wheel:
    """The wheel of an installed package; PackageNotFoundError, NotPureError."""
    package = metadata.distribution(name)
    files = {}
    for file in package.files or ():
        if file.suffix in (".so", ".pyd"):
            raise NotPureError(f"{name} is not pure Python: {file}")
        if not LEFT_OUT.search(file.as_posix()):
            files[file.as_posix()] = Path(str(package.locate_file(file))).read_bytes()
    text = f"Metadata-Version: 2.1\nName: {name}\nVersion: {package.version}\n"
    with tempfile.TemporaryDirectory() as folder:
        distribution = name.replace("-", "_")
        path = write_wheel(Path(folder), distribution, package.version, text, "", files)
        return Wheel(name, package.version, path.name, path.read_bytes(), (imports,), needs)
