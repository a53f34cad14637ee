"""A mechanism whose parameters are π, the inertial parameters that its energies are linear in."""

from functools import lru_cache
from typing import TYPE_CHECKING

from autograder.mechanisms.outline import BuiltIn, Outline
from autograder.mutation import kept

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism


class InPi(BuiltIn):
    """The outline of one that comes with the kit, in π."""

    @property
    def full(self) -> "Mechanism":
        from autograder.mechanisms.built_in import named
        from autograder.mutation.inertial_parameters import IN_PI, in_inertial_parameters

        return in_inertial_parameters(named(self.name.removesuffix(IN_PI)))


@lru_cache(maxsize=64)
def in_pi(mechanism: Outline) -> Outline:
    """The same mechanism in π: its parameters that are not known are π, in order."""

    def made() -> "Mechanism":
        from autograder.mutation.inertial_parameters import in_inertial_parameters

        return in_inertial_parameters(mechanism.full)

    if not mechanism.is_built_in:
        return made()
    return kept.entry(
        ("in pi", *kept.definition(mechanism)), lambda: InPi.of(made()).as_data(), InPi.from_data
    )
