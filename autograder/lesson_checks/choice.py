"""A lesson's check of a choice, with its reason."""

import re
import string
from collections.abc import Mapping
from dataclasses import dataclass

from autograder.judging.verdict import Verdict
from autograder.lesson_checks import typed
from autograder.protocol.words import described, one_line


@dataclass(frozen=True)
class Option:
    """An answer with its reason, as the lesson prints it; and what is said of it, "" of the right one.

    said: what is seen and where to look; it does not say which option is right.
    """

    text: str
    said: str = ""


@dataclass(frozen=True)
class Choice:
    """One of several options, whose letter the student types into `my_…` in quotes.

    id: "05-moon" is answered in my_moon. text: what is asked for, as the card's row. options: a, b, c …
    in the order of the lesson's list, one of them right. further, hints: as in a Number.

    ValueError where not exactly one option is right, or where two are the same.
    """

    id: str
    text: str
    options: tuple[Option, ...]
    further: str
    hints: tuple[str, ...]

    def __post_init__(self):
        if sum(not option.said for option in self.options) != 1:
            raise ValueError(f"check {self.id}: one option must be right, with nothing said of it")
        texts = {option.text for option in self.options}
        said = {option.said for option in self.options}
        if min(len(texts), len(said)) < len(self.options):
            raise ValueError(f"check {self.id}: two of its options are the same")

    @property
    def by_letter(self) -> dict[str, Option]:
        """The options by their letters, from "a" on."""
        return dict(zip(string.ascii_lowercase, self.options, strict=False))

    def judge(self, namespace: Mapping) -> Verdict:
        """The verdict on what the namespace has in the student's variable; it raises nothing."""
        try:
            given = typed.typed_in(namespace, self.id)
            if given is ...:
                return typed.not_attempted(self.id)
            option = self._read(given)
        except typed.NoAnswerError as error:
            return typed.no_answer(self.id, str(error))
        if option.said:
            return typed.wrong(self.id, self.text, option.said)
        return typed.right(self.id, self.text, self.further)

    def _read(self, given: object) -> Option:
        name, options = typed.name_of(self.id), self.by_letter
        if isinstance(given, str):
            letter = re.fullmatch(r"\s*\(?([a-z])[.)]?\s*", given, re.IGNORECASE)
            if letter and letter[1].lower() in options:
                return options[letter[1].lower()]
        try:
            said = one_line(described(given))
        except Exception:  # an object of the student's own that cannot be described
            said = "an object that is no letter"
        *most, last = (f'"{letter}"' for letter in options)
        raise typed.NoAnswerError(
            f"{name} is {said}. Type one letter in quotes: {', '.join(most)} or {last}."
        )
