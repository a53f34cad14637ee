"""Which scores a platform has taken: course/lti-sent.json, so that only what has changed is sent."""

import json
from pathlib import Path

from autograder.files import put_in_place
from autograder.lti import LtiError

FILE = Path("course") / "lti-sent.json"


class Sent:
    """The scores by line item and the student's id. LtiError if the file is damaged."""

    def __init__(self, root: Path):
        self._path = root / FILE
        self._held: dict[str, dict[str, dict]] = {}
        if self._path.is_file():
            try:
                self._held = json.loads(self._path.read_text(encoding="utf-8"))
                for score in [one for of in self._held.values() for one in of.values()]:
                    score["userId"], score["comment"]
            except (ValueError, AttributeError, KeyError, TypeError) as error:
                raise LtiError(
                    f"{self._path} is damaged: {error}; delete it, and all scores are sent again"
                ) from None

    def of(self, line_item: str, student: str) -> dict | None:
        """What the platform has of a student; None if it has nothing."""
        return self._held.get(line_item, {}).get(student)

    def note(self, line_item: str, student: str, score: dict) -> None:
        self._held.setdefault(line_item, {})[student] = score

    def names(self, student: str) -> bool:
        """Whether anything of a student was sent."""
        return any(student in scores for scores in self._held.values())

    def forget(self, student: str) -> None:
        """Remove a student from the file. OSError if it cannot be written."""
        for scores in self._held.values():
            scores.pop(student, None)
        self.write()

    def write(self) -> None:
        """OSError if the file cannot be written."""
        text = json.dumps(self._held, ensure_ascii=False, indent=1)
        put_in_place(self._path, f"{text}\n", 0o600)
