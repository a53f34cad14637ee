"""Run as one account of a class server: tries to get at what is others', and prints what it got.

Its argument is JSON: {"read": […], "list": […], "write": […], "folders": […]}.
"""

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path


def attempts(given: dict[str, list[str]]) -> dict[str, Callable[[], object]]:
    """Each attempt by its name."""
    found: dict[str, Callable[[], object]] = {}
    for path in given["read"]:
        found[f"read {path}"] = lambda path=path: os.read(os.open(path, os.O_RDONLY), 1)
    for path in given["list"]:
        found[f"list {path}"] = lambda path=path: os.listdir(path)
    for path in given["write"]:
        found[f"write {path}"] = lambda path=path: os.open(path, os.O_WRONLY)
    for path in given["folders"]:
        inside, beside = Path(path, "mine"), Path(path).with_name("moved")
        found[f"add to {path}"] = lambda inside=inside: os.open(inside, os.O_WRONLY | os.O_CREAT)
        found[f"move {path}"] = lambda path=path, beside=beside: os.rename(path, beside)
        found[f"open {path}"] = lambda path=path: os.chmod(path, 0o777)
    return found


if __name__ == "__main__":
    succeeded = []
    for name, attempt in attempts(json.loads(sys.argv[1])).items():
        try:
            attempt()
            succeeded.append(name)
        except OSError:
            pass
    print(json.dumps(succeeded))
