"""The checks of a student's package, each with its numbers."""

from functools import cache
from typing import cast

from autograder.judging.check import Check
from autograder.judging.models import Beside, Model
from autograder.stored import files
from autograder.stored.left_out import LeftOut
from autograder.stored.numbers import Later, Numbers, Stored, StoredCatalogue, mistake_of
from autograder.stored.reading import restored


def checks(name: str) -> tuple:
    """Those of a problem or a lesson, by the name of its module's file; none where it is not here."""
    if not files.has(f"checks-{name}"):
        return ()
    return tuple(map(_made, files.read(f"checks-{name}")["checks"]))


@cache
def of_arm(id: str, arm: str) -> Check | None:
    """The check on a student's own arm; None where the arm makes no difference to it."""
    name = f"checks-{id}@{arm}"
    return _made(files.read(name)["checks"][0]) if files.has(name) else None


def _made(said: dict):
    """A check; or, of a lesson, what needs no function."""
    if "asked" not in said:
        return restored(said)
    numbers = Numbers(said["numbers"])

    def beside(place: int) -> Beside:
        return Beside(cast(Model, Later(numbers, "beside", place)))

    asked = {name: restored(part, beside) for name, part in said["asked"].items()}
    if said["left_out"]:
        return LeftOut(
            reference=cast(Model, Stored({})),
            calls=numbers.calls,
            why=said["left_out"],
            fits=restored(said["fits"]),
            **asked,
        )
    return Check(
        reference=cast(Model, Later(numbers, "reference")),
        calls=numbers.calls,
        mistakes=tuple(
            mistake_of(own, Later(numbers, "of_mistake", place))
            for place, own in enumerate(said["mistakes"])
        ),
        catalogue=StoredCatalogue(numbers) if said["generated"] else None,
        terms=numbers.terms,
        pose=numbers.pose if said["pose"] else None,
        **asked,
    )
