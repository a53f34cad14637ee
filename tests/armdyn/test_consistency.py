"""Whether figures belong to bodies: the pseudo-inertia, and the search for bodies alike in torque."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from armdyn import Link, SerialChain
from armdyn.base_parameters import base_parameters
from armdyn.consistency import consistent_parameters, pseudo_inertia
from armdyn.regressor import parameters

RNG = np.random.default_rng(0)


def published(moments) -> SerialChain:
    """An upright trunk that turns about z, and a forearm on a level axis with these moments."""
    with warnings.catch_warnings(action="ignore"):
        return SerialChain(
            [
                Link("revolute", 1.0, inertia=np.diag([0.5, 0.5, 0.35])),
                Link(
                    "revolute", 4.8, (0, -0.07, 0.014), np.diag(moments), axis=(0, 1, 0),
                    translation=(0, 0.15, 0), triangle="warn",
                ),
            ]
        )  # fmt: skip


def test_the_pseudo_inertia_of_particles_is_the_sum_of_their_squares():
    masses, places = RNG.uniform(0.5, 2, size=6), RNG.normal(size=(6, 3))
    mass = masses.sum()
    com = masses @ places / mass
    apart = places - com
    inertia = np.einsum("a,aij->ij", masses, np.vecdot(apart, apart)[:, None, None] * np.eye(3))
    inertia -= np.einsum("a,ai,aj->ij", masses, apart, apart)
    pi = parameters(SerialChain([Link("revolute", mass, com, inertia)]))
    ends = np.column_stack([places, np.ones(6)])
    np.testing.assert_allclose(pseudo_inertia(pi), ends.T @ (masses[:, None] * ends), atol=1e-12)


@pytest.mark.parametrize(
    ("moments", "body"),
    [
        ((0.066, 0.0125, 0.066), True),
        ((0.066, 0.0125, 0.0785), True),  # flat
        ((0.066, 0.0125, 0.086), False),
        ((0.066, 0.012, 0.0535), False),
        ((0.0125, 0.086, 0.066), False),
    ],
)
def test_the_triangle_inequality_is_in_the_smallest_eigenvalue(moments, body):
    pi = parameters(published(moments))[10:]
    smallest = np.linalg.eigvalsh(pseudo_inertia(pi))[0]
    assert (smallest > -1e-12) == body
    a, b, c = sorted(moments)
    lacking = (a + b - c) / 2
    # Steiner's part lifts no direction in which the centre of mass has no component; here it is z.
    assert smallest <= lacking + 4.8 * 0.014**2 + 1e-12


@pytest.mark.parametrize("size", [(9,), (11,), ()])
def test_another_number_of_parameters_is_refused(size):
    with pytest.raises(ValueError, match=r"^pi: got shape"):
        pseudo_inertia(np.zeros(size))


def test_torques_may_hide_that_one_link_is_no_body():
    """What the forearm lacks about two axes can be taken from the trunk: no torque changes."""
    arm = published((0.066, 0.086, 0.0125))  # too large about its own axis, y
    trunk, forearm = arm.links
    lent = 0.004 * np.diag([1.0, 0.0, 1.0])  # across that axis
    with warnings.catch_warnings(action="ignore"):
        other = replace(
            arm,
            links=(
                replace(trunk, inertia=np.array(trunk.inertia) - np.diag([0, 0, 0.004])),
                replace(forearm, inertia=np.array(forearm.inertia) + lent),
            ),
        )
    q, qd, qdd = RNG.normal(size=(3, 20, 2))
    np.testing.assert_allclose(other.rnea(q, qd, qdd), arm.rnea(q, qd, qdd), atol=1e-12)
    base = base_parameters(arm)
    found = consistent_parameters(base.combination, base.combination @ parameters(arm), None, 2)
    assert found.exists
    assert np.linalg.eigvalsh(pseudo_inertia(found.parameters.reshape(2, 10))).min() > 0


def test_torques_show_a_negative_moment():
    """A negative moment about the joint's axis, where nothing else can make up for it."""
    arm = published((0.066, 0.0125, 0.066))
    base = base_parameters(arm)
    target = base.combination @ parameters(arm)
    at = [base.names[j] for j in base.independent].index("Jyy2")
    target[at] = -0.01
    found = consistent_parameters(base.combination, target, None, 2)
    assert not found.exists
    assert found.margin < 0


def test_torques_show_a_moment_across_the_axis_that_is_too_large():
    """The difference of the two moments across the axis is seen, and it needs one about the axis."""
    arm = published((0.066, 0.0125, 0.086))
    base = base_parameters(arm)
    found = consistent_parameters(base.combination, base.combination @ parameters(arm), None, 2)
    assert not found.exists
    assert found.margin < 0
