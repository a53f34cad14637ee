"""Puts the files that were handed in with the notebook into the folder in which its cells run."""

import base64
import importlib
import os
import sys

ROOM = os.path.dirname(os.path.abspath(__file__))
# A student's file may have one of these names; the protocol needs the real modules.
REAL = ("IPython", "matplotlib", "mpmath", "numpy", "scipy", "sympy")


def lay(files: dict[str, str]) -> list[str]:
    """Write files, given by name in base64; return the names of those that could not be written."""
    modules = {name.split("/")[0].removesuffix(".py") for name in files if name.endswith(".py")}
    for module in modules.intersection(REAL):
        importlib.import_module(module)
    for module in modules:
        if _is_the_rooms(sys.modules.get(module)):
            del sys.modules[module]  # the room no longer needs the name
    failed = []
    for name, content in files.items():
        try:
            os.makedirs(os.path.dirname(name) or ".", exist_ok=True)
            with open(name, "xb") as file:
                file.write(base64.b64decode(content))
        except OSError:
            failed.append(name)
    importlib.invalidate_caches()
    return failed


def look_in_the_folder():
    """Import first from the folder in which cells run, as a notebook's kernel does."""
    sys.path.insert(0, "")


def _is_the_rooms(module) -> bool:
    path = getattr(module, "__file__", None) or ""
    return os.path.dirname(os.path.abspath(path)) == ROOM
