"""The operators: what people do wrong in one term, each as a rewriting of its expressions.

The expressions are the term's energy, from which the answer is then derived, or what the right term
contributes to the answer, where somebody made the mistake later. The same rewriting of all terms at
once is a mistake too: "m1 for m2 everywhere".
"""

from collections.abc import Iterator

import sympy as sp

from autograder.mechanisms import Mechanism
from autograder.mutation.operators.of_conventions import another_convention
from autograder.mutation.operators.of_counts import astray, doubled, dropped, halved, wrong_sign
from autograder.mutation.operators.of_parameters import (
    about_another_point,
    gravity_of_earth,
    kind_left_out,
    parameter_added,
    parameter_inverted,
    parameter_left_out,
    parameters_exchanged,
    square_added,
    square_lost,
    sum_of_lengths,
    wrong_parameter,
)
from autograder.mutation.operators.of_velocities import (
    velocity_left_out,
    velocity_missing,
    velocity_not_squared,
    wrong_velocity,
)
from autograder.mutation.operators.of_waves import (
    degrees,
    double_angle,
    half_angle,
    sine_for_cosine,
    small_angle,
    triple_angle,
    wave_lost,
    wave_power,
    wave_without_sign,
    wrong_angle,
    wrong_wave,
)
from autograder.mutation.operators.rewriting import Operator, Rewriting

__all__ = ["OF_ENERGIES", "OPERATORS", "Operator", "Rewriting", "astray", "rewritings"]

OPERATORS: tuple[Operator, ...] = (
    dropped,
    wrong_sign,
    doubled,
    halved,
    wrong_parameter,
    parameter_added,
    parameters_exchanged,
    wrong_angle,
    sine_for_cosine,
    velocity_left_out,
    wrong_velocity,
    another_convention,
    about_another_point,
    square_lost,
    sum_of_lengths,
    wave_lost,
    parameter_left_out,
    kind_left_out,
    gravity_of_earth,
    small_angle,
    degrees,
    velocity_not_squared,
    velocity_missing,
    square_added,
    parameter_inverted,
    double_angle,
    half_angle,
    wave_power,
    wave_without_sign,
    wrong_wave,
    triple_angle,
)
# What gives a K that is not quadratic in the velocities.
OF_ENERGIES = ("velocity not squared", "velocity missing")


def rewritings(term: sp.Tuple, mechanism: Mechanism) -> Iterator[Rewriting]:
    """All wrong forms of a term, the likeliest first; some may be equal to each other or to it."""
    for operator in OPERATORS:
        yield from operator(term, mechanism)
