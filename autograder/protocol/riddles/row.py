"""A row of the table: which errors it reads, what it says of them."""

import re
from collections.abc import Callable
from dataclasses import dataclass

from .scene import Scene

Words = tuple[str, ...]


@dataclass(frozen=True)
class Row:
    """An error that a student need not understand, and the sentence that says it in the student's names.

    errors: names of its classes, such as "TypeError". pattern: searched in its message. words(scene,
    found, error): what is filled into `says`; None where the row does not fit.
    """

    kind: str
    errors: tuple[str, ...]
    pattern: str
    says: str
    words: Callable[[Scene, re.Match, BaseException], Words | None] = lambda *_: ()

    def read(self, error: BaseException, message: str, scene: Scene) -> Words | None:
        """The words for an error; None where the row does not fit."""
        if not any(cls.__name__ in self.errors for cls in type(error).__mro__):
            return None
        found = re.search(self.pattern, message)
        return self.words(scene, found, error) if found else None

    @property
    def places(self) -> int:
        """How many words the sentence takes."""
        return len({int(place) for place in re.findall(r"{(\d)}", self.says)})
