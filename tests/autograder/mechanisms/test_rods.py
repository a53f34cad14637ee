"""A body of which a mechanism gives no length is drawn as the rod that has its inertia."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mechanisms.shapes import Link, Mass

ROD = 0.9  # length, m, and 1.6 kg
OWN = ROD**2 / 12  # about its centre of mass, per kg, m²
LC = 0.35
NUMBERS = {
    "pendulum": {"m": 1.6, "lc": LC, "I": 1.6 * (OWN + LC**2), "g": 9.81},
    "elastic-joint": {"m": 1.6, "lc": LC, "I": 1.6 * (OWN + LC**2), "J": 0.3, "k": 9.0, "g": 9.81},
    "cart-pole": {"mc": 2.0, "m": 1.6, "lc": LC, "I": 1.6 * OWN, "g": 9.81},
    "spring-cart": {"mc": 2.0, "m": 1.6, "lc": LC, "I": 1.6 * OWN, "g": 9.81, "k": 9.0},
    # Its arm along the axis that is seen aslant turns the pendulum into the plane of the picture.
    "furuta": {"J1": 0.3, "l1": 0.7, "m2": 1.6, "lc2": LC, "I2": 1.6 * OWN, "g": 9.81},
}


@pytest.mark.parametrize("name", NUMBERS)
def test_the_picture_has_the_inertia(name):
    mechanism = MECHANISMS[name]
    assert {p.name for p in mechanism.parameters} == set(NUMBERS[name])
    q = np.array([-math.pi / 2, 0.7]) if name == "furuta" else np.full(mechanism.n, 0.7)
    shapes = mechanism.shapes(q, SimpleNamespace(**NUMBERS[name]))
    body = [shape for shape in shapes if isinstance(shape, Link)][-1]
    (centre,) = (shape.at for shape in shapes if isinstance(shape, Mass))
    assert math.dist(body.start, centre) == pytest.approx(LC)
    assert math.dist(body.start, body.end) == pytest.approx(LC + ROD / 2)
    assert math.dist(centre, body.end) == pytest.approx(ROD / 2)


def test_a_point_mass_is_drawn_at_the_end():
    numbers = SimpleNamespace(m=1.6, lc=LC, I=1.6 * LC**2, g=9.81)
    _, body, mass = MECHANISMS["pendulum"].shapes(np.array([0.7]), numbers)
    assert body.end == pytest.approx(mass.at)
