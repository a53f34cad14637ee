"""The mechanisms of the kit by name, without their formulas, as they are kept."""

from functools import cache

from autograder.mechanisms.outline import BuiltIn
from autograder.mutation import kept


@cache
def outline(name: str) -> BuiltIn:
    """KeyError where the kit has no mechanism of this name."""

    def made() -> dict:
        from autograder.mechanisms.built_in import named

        return BuiltIn.of(named(name)).as_data()

    return kept.entry(("outline", name), made, BuiltIn.from_data)
