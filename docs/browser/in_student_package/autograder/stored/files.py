"""The files of stored checks. The site serves their numbers: each is fetched when its check is asked."""

import json
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent / "data"
WHERE = json.loads((FOLDER.parent / "where.json").read_text(encoding="utf-8"))
# The kernel's program, which runs this Python, comes from below this folder of the site.
OF_KERNEL = "/extensions/"


@cache
def read(name: str) -> dict:
    """What a file holds; FileNotFoundError where there is none, OSError where it cannot be fetched."""
    file = FOLDER / f"{name}.json"
    if not file.is_file() and file.name in WHERE["names"]:
        return json.loads(_fetched(file.name))
    return json.loads(file.read_text(encoding="utf-8"))


def has(name: str) -> bool:
    file = FOLDER / f"{name}.json"
    return file.is_file() or file.name in WHERE["names"]


def _fetched(name: str) -> str:
    import js

    site = str(js.location.href).partition(OF_KERNEL)[0]
    request = js.XMLHttpRequest.new()
    try:
        # Not in the background: the check waits for it.
        request.open("GET", f"{site}/{WHERE['folder']}/{name.replace('@', '%40')}", False)
        request.send()
        status = request.status
    except Exception:  # JavaScript's own, where the network is gone
        status = 0
    if status != 200:
        raise OSError(
            "The numbers that this check compares with could not be fetched. Is the network there? "
            "If it is, save your work and load the page again."
        )
    return str(request.responseText)
