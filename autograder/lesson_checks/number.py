"""A lesson's check of one number."""

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass

from autograder.judging.verdict import Verdict
from autograder.lesson_checks import typed
from autograder.protocol import NotNumbersError
from autograder.protocol.readings import read_numbers
from autograder.protocol.words import described

# A wrong number of 0 has no size of its own: it is one that is this share of the right one at most.
ALMOST_NOTHING = 0.0005
SIGN = "The size is right and the sign is not."
DEGREES = "You counted in degrees. The unit of the answer has radians in it."
FACTOR_TO = 0.01  # a factor is one of these, and no other, to this share
# What a number without a sentence of its own may be a multiple of the right one by.
FACTORS = (
    (
        2.0,
        "You are off by a factor of 2. Is there a ½ too many or too few, or does something count twice?",
    ),
    (9.81, "You are off by a factor of 9.81. Is g missing, or is it there once too often?"),
    (1000.0, "You are off by a factor of 1000. Is each of your numbers in SI units?"),
)


@dataclass(frozen=True)
class WrongNumber:
    """A number that a known mistake gives, and the sentence that names the mistake.

    name: of the mistake, for the tests. sentence: says what is seen and where to look, never the number.
    """

    name: str
    number: float
    sentence: str


@dataclass(frozen=True)
class Number:
    """One number, which the student types into `my_…`.

    id: "05-sag" is answered in my_sag. text: what is asked for, as the card's row. unit: "" for none.
    right: within a share `tolerance` of it an answer is right. wrong: of several that fit the nearest
    is named. otherwise: what to say of any other number, unless its sign alone is wrong or it counts
    in degrees; where it is off by one of FACTORS, that comes first. further: on the card of a right
    answer, why it is right or what it leads to. hints: for `hint`.

    ValueError where right is 0 (ask for a Choice), two wrong numbers have one name, or numbers are so
    close that an answer could be both.
    """

    id: str
    text: str
    unit: str
    right: float
    wrong: tuple[WrongNumber, ...]
    otherwise: str
    further: str
    hints: tuple[str, ...]
    tolerance: float = 0.01

    def __post_init__(self):
        if self.right == 0:
            raise ValueError(f"check {self.id}: a right number of 0 has no size: ask for a Choice")
        names = [one.name for one in self.wrong]
        if len(set(names)) < len(names):
            raise ValueError(f"check {self.id}: two wrong numbers have one name")
        for one, other in itertools.combinations([self.right, *(w.number for w in self.wrong)], 2):
            if abs(one - other) <= self._room(one) + self._room(other):
                raise ValueError(
                    f"check {self.id}: {one:g} and {other:g} are too close for {self.tolerance:g}"
                )

    def judge(self, namespace: Mapping) -> Verdict:
        """The verdict on what the namespace has in the student's variable; it raises nothing."""
        try:
            given = typed.typed_in(namespace, self.id)
            if given is ...:
                return typed.not_attempted(self.id)
            number = self._read(given)
        except typed.NoAnswerError as error:
            return typed.no_answer(self.id, str(error))
        text = f"{self.text} ({self.unit})" if self.unit else self.text
        if self._same(number, self.right):
            return typed.right(self.id, text, self.further)
        near = [one for one in self.wrong if self._same(number, one.number)]
        if not near:
            return typed.wrong(self.id, text, self._unnamed(number))
        nearest = min(near, key=lambda one: abs(number - one.number))
        return typed.wrong(self.id, text, nearest.sentence)

    def _read(self, given: object) -> float:
        name = typed.name_of(self.id)
        try:
            array = read_numbers(given)
        except NotNumbersError as error:
            said = str(error) or described(given)
        except Exception:  # an object of the student's own that cannot be read
            said = "an object that is no number"
        else:
            if array.size == 1 and math.isfinite(array.item()):
                return float(array.item())
            said = f"{array.size} numbers" if array.size != 1 else f"{array.item()}"
        how = "Type one number, without its unit."
        if isinstance(given, str):
            how = "Type one number, without quotes and without its unit."
        elif isinstance(given, tuple):
            how += " Its decimals come after a point: 3.5, not 3,5."
        raise typed.NoAnswerError(f"{name} is {said}. {how}")

    def _unnamed(self, number: float) -> str:
        """What to say of a wrong number that is none of `wrong`."""
        if self._same(-number, self.right):
            return SIGN
        if self.unit.startswith("rad") and self._same(math.radians(number), self.right):
            return DEGREES
        if self.unit.endswith("/rad") and self._same(math.degrees(number), self.right):
            return DEGREES
        room = min(self.tolerance, FACTOR_TO) * abs(self.right)
        for factor, said in FACTORS if self.unit else ():
            if min(abs(number * f - self.right) for f in (factor, 1 / factor)) <= room:
                return f"{said} {self.otherwise}"
        return self.otherwise

    def _same(self, given: float, number: float) -> bool:
        return abs(given - number) <= self._room(number)

    def _room(self, number: float) -> float:
        return self.tolerance * abs(number) or ALMOST_NOTHING * abs(self.right)
