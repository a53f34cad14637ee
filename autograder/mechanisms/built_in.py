"""The mechanisms that come with the kit, by their names."""

from functools import lru_cache
from itertools import product
from typing import get_args

from autograder.mechanisms.carts import CART_POLE, SPRING_CART
from autograder.mechanisms.elastic_joint import ELASTIC_JOINT
from autograder.mechanisms.mechanism import Mechanism
from autograder.mechanisms.pendulums import FURUTA, PENDULUM, SPHERICAL
from autograder.mechanisms.planar_arms import (
    PLANAR_2R,
    PLANAR_2R_ABSOLUTE,
    PLANAR_2R_BESIDE,
    PLANAR_2R_HANGING,
    PLANAR_2R_SLOPE,
    PLANAR_3R,
    Angles,
    Zero,
    planar_arm,
)
from autograder.mechanisms.slider_crank import SLIDER_CRANK
from autograder.mechanisms.sliding_arm import TURN_AND_SLIDE

MECHANISMS = {
    mechanism.name: mechanism
    for mechanism in (
        PENDULUM,
        PLANAR_2R,
        PLANAR_2R_ABSOLUTE,
        PLANAR_2R_HANGING,
        PLANAR_2R_BESIDE,
        PLANAR_2R_SLOPE,
        CART_POLE,
        TURN_AND_SLIDE,
        PLANAR_3R,
        SPRING_CART,
        FURUTA,
        SPHERICAL,
        SLIDER_CRANK,
        ELASTIC_JOINT,
    )
}

# The 2R arms that students are given: planar-2r-square-hanging-slope.
FAMILY: dict[str, tuple[Angles, Zero, bool]] = {
    f"planar-2r-{angles}-{zero}{'-slope' if slope else ''}": (angles, zero, slope)
    for angles, zero, slope in product(get_args(Angles), get_args(Zero), (False, True))
}


@lru_cache(maxsize=64)
def named(name: str) -> Mechanism:
    """One of `MECHANISMS` or of the family. KeyError where none has this name."""
    if name in MECHANISMS:
        return MECHANISMS[name]
    angles, zero, slope = FAMILY[name]
    return planar_arm(name, 2, angles, zero, slope=slope)
