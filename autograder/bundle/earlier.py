"""Which versions of each problem this course has put into archives: course/versions.json.

A student's package knows by it that a notebook is older than the package.
"""

import json
from pathlib import Path

from autograder.bundle import BundleError
from autograder.files import put_in_place

FILE = Path("course") / "versions.json"


def earlier(root: Path, versions: dict[str, str]) -> dict[str, list[str]]:
    """The other versions that each of these problems had before; the ones given are written down.

    root: the course's folder. versions: by the problem. BundleError if the record is damaged, OSError
    if it cannot be written.
    """
    path = root / FILE
    known = _read(path)
    before = {
        name: [one for one in known.get(name, ()) if one != now] for name, now in versions.items()
    }
    new = known | {name: [*before[name], now] for name, now in versions.items()}
    if new != known:
        path.parent.mkdir(mode=0o700, exist_ok=True)
        put_in_place(path, f"{json.dumps(new, indent=2)}\n")
    return before


def _read(path: Path) -> dict[str, list[str]]:
    if not path.is_file():
        return {}
    try:
        known = json.loads(path.read_text(encoding="utf-8"))
        return {str(name): [str(one) for one in of] for name, of in known.items()}
    except (ValueError, TypeError, AttributeError) as error:
        raise BundleError(
            f"{path} is damaged: {error}. It lists the versions that were handed out; restore it from "
            "a backup, or delete it: then students with an older notebook are not told so"
        ) from None
