"""The right numbers of lesson 06 once more, by `armdyn` in place of a formula."""

from dataclasses import replace

import numpy as np
import pytest

from armdyn import Planar2R, PlanarChain
from armdyn.base_parameters import base_parameters, on_link_axes
from armdyn.identify import identify
from armdyn.regressor import parameters, regressor
from autograder.lesson_checks import checks_of

RIGHT = {id: getattr(check, "right", None) for id, check in checks_of("06").items()}
ARM = Planar2R(l1=1.0, l2=0.8, lc1=0.5, lc2=0.4, m1=3.0, m2=2.0, I1=0.25, I2=0.11)


def test_bodies_that_are_bolted_together_add_up():
    motor = replace(ARM, m2=1.5, lc2=0.6, I2=0.05)
    assert np.isclose(RIGHT["06-motor"], parameters(ARM)[7] + parameters(motor)[7])


@pytest.mark.parametrize(("g", "named"), [(0.0, "right"), (9.81, "with gravity")])
def test_three_links_have_so_many_base_parameters(g, named):
    arm = PlanarChain(l=(0.5, 0.4, 0.3), lc=(0.2, 0.3, 0.1), m=(3, 2, 1), I=(0.1, 0.2, 0.3), g=g)
    count = base_parameters(arm, on_link_axes(arm)).rank
    wrong = {one.name: one.number for one in checks_of("06")["06-count"].wrong}
    assert count == (RIGHT["06-count"] if named == "right" else wrong[named])


@pytest.mark.parametrize(("factor", "exist"), [(0.99, False), (1.01, True)])
def test_bodies_exist_above_the_number_and_not_below(factor, exist):
    arm = replace(ARM, l1=0.5)
    columns = list(on_link_axes(arm))
    motion = np.random.default_rng(6).uniform(-3, 3, size=(3, 50, 2))
    kept = regressor(arm, *motion)[..., list(base_parameters(arm, columns).independent)]
    u = kept @ [1.5, 0.9, 0.8, factor * RIGHT["06-bodies"]]
    assert identify(arm, *motion, u, columns=columns).consistent is exist
