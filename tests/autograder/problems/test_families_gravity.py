"""What is said where a student takes gravity's pull, or the rest of the arm, for another than it is."""

from dataclasses import replace

import numpy as np
import pytest

from autograder.judging.verdict import State
from autograder.problems import check_for
from autograder.problems.families import _said
from autograder.problems.material.conventions import FAMILY, Convention
from tests.autograder.problems.test_families import members, verdict

sloped = pytest.mark.parametrize(
    "own", [own for own in FAMILY if own.slope], ids=lambda own: own.name
)


def tilted(own, degrees):
    """The arm with gravity pulling at so many degrees to the −y axis."""
    return replace(own, slope=degrees / 30)


@sloped
@pytest.mark.parametrize("id", ["p4-potential_energy", "p4-g_vec"])
def test_gravity_to_the_other_side_is_named(own, id):
    answer = getattr(tilted(own, -30), id.removeprefix("p4-"))
    (said,) = verdict(id, own, answer).diagnosis
    assert "where gravity pulls at 30° to the −y axis, away from the x axis." in said
    answer = getattr(tilted(own, 60), id.removeprefix("p4-"))
    assert "pulls at 60° to the −y axis, towards the x" in verdict(id, own, answer).diagnosis[0]


@sloped
def test_degrees_for_radians_in_gravitys_pull_are_named(own):
    wrong = tilted(own, np.degrees(30))
    (said,) = verdict("p4-g_vec", own, wrong.g_vec).diagnosis
    assert "as 30 radians" in said
    (said,) = verdict("p4-potential_energy", own, wrong.potential_energy).diagnosis
    assert "as 30 radians" in said


@sloped
@pytest.mark.parametrize("link", [1, 2])
def test_a_pull_that_is_tilted_for_one_link_alone_is_named(own, link):
    def g_vec(q, arm):
        phi = own.directions(q) - np.pi / 6 * (np.array([1, 2]) == link)
        first, second = np.cos(phi)
        weights = [(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * first, arm.m2 * arm.lc2 * second]
        return own.turns.T @ np.array(weights) * arm.g

    (said,) = verdict("p4-g_vec", own, g_vec).diagnosis
    assert f"pulls on link {link} as your table says" in said


def same_configurations(first, second):
    """Whether both hold the same, up to whole turns."""
    apart = np.abs(np.exp(1j * first)[:, None] - np.exp(1j * second)).sum(axis=-1)
    return np.max(np.min(apart, axis=0)) < 1e-6 and np.max(np.min(apart, axis=1)) < 1e-6


@members
def test_configurations_are_called_another_arms_only_where_they_are(own):
    """Also those on the other side of gravity's pull, which leave the same torques."""
    for member in FAMILY:
        phi = own.directions(member.equilibria())
        for sides in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
            given = own.angles_at(own.pull + np.array(sides) * (phi - own.pull))
            found = verdict("p4-equilibria", own, lambda arm, given=given: given)
            if found.state is State.CORRECT:
                continue
            (said,) = found.diagnosis
            if said.startswith("Your answer is right for"):
                assert any(
                    said == _said(own, other, "answer is")
                    and same_configurations(other.equilibria(), given)
                    for other in FAMILY
                    if other != own
                )


def test_configurations_askew_say_how_far():
    own = Convention("relative", "hanging", slope=True)
    given = tilted(own, -30).equilibria()
    (said,) = verdict("p4-equilibria", own, lambda arm: given).diagnosis
    assert said.startswith("At your configurations both links lie at 60° to the pull of gravity.")


@members
def test_some_of_the_equilibria_and_degrees_are_named(own):
    def said(given):
        return " ".join(verdict("p4-equilibria", own, lambda arm: given).diagnosis)

    right = check_for("p4-equilibria", own).reference(None)
    degrees = np.round(np.degrees(right), 9)
    assert "in degrees" in said(180 - np.remainder(180 - degrees, 360))
    along, against = own.pull, own.pull + np.pi
    assert "the arm is stretched" in said(own.angles_at([(along, along), (against, against)]))
    assert "be stable" in said(own.angles_at([(along, along)]))
