"""Which scores a platform has taken: course/lti-sent.json, so that only what has changed is sent."""

import json
from pathlib import Path

from autograder.files import put_in_place
from autograder.lti import LtiError

FILE = Path("course") / "lti-sent.json"


class Sent:
    """The scores by line item and the platform's user. LtiError if the file is damaged."""

    def __init__(self, root: Path):
        self._path = root / FILE
        self._held: dict[str, dict[str, dict]] = {}
        if self._path.is_file():
            try:
                self._held = json.loads(self._path.read_text(encoding="utf-8"))
                for scores in self._held.values():
                    scores.items()
            except (ValueError, AttributeError) as error:
                raise LtiError(
                    f"{self._path} is damaged: {error}; delete it, and all scores are sent again"
                ) from None

    def has(self, line_item: str, score: dict) -> bool:
        return self._held.get(line_item, {}).get(score["userId"]) == score

    def note(self, line_item: str, score: dict) -> None:
        self._held.setdefault(line_item, {})[score["userId"]] = score

    def write(self) -> None:
        """OSError if the file cannot be written."""
        put_in_place(self._path, f"{json.dumps(self._held, indent=1)}\n", 0o600)
