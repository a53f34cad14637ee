"""The mechanisms that come with the kit, by their names."""

from autograder.mechanisms.carts import CART_POLE, SPRING_CART
from autograder.mechanisms.elastic_joint import ELASTIC_JOINT
from autograder.mechanisms.pendulums import FURUTA, PENDULUM, SPHERICAL
from autograder.mechanisms.planar_arms import (
    PLANAR_2R,
    PLANAR_2R_ABSOLUTE,
    PLANAR_2R_BESIDE,
    PLANAR_2R_HANGING,
    PLANAR_2R_SLOPE,
    PLANAR_3R,
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
