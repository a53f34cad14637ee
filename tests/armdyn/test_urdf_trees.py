"""One chain out of a tree of links, with the rest of the tree at rest."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn.spatial import rotation
from armdyn.urdf import read_urdf
from tests.armdyn.arms import a_few, assert_close, between, vectors
from tests.armdyn.chains import angles
from tests.armdyn.urdf_files import Part, chain_file, joint, link, parts, robot
from tests.armdyn.urdf_trees import TORSO, humanoid, leaves, tree_file, trees

HAND = [Part("revolute", xyz=(0, 0, k)) for k in (1, 2)]
FINGER = Part("prismatic", axis=(0, 1, 0), xyz=(0, 0, 0.3), damping=0.4)


def arm_with_fingers(mimic='<mimic joint="left" multiplier="-2" offset="0.1"/>'):
    """j1 and j2, and on link2 two sliding fingers, of which the right one follows the left."""
    return chain_file(HAND).replace(
        "</robot>",
        link("finger1", FINGER)
        + link("finger2", FINGER)
        + joint("left", "link2", "finger1", FINGER)
        + joint("right", "link2", "finger2", FINGER, mimic)
        + "</robot>",
    )


@a_few
@given(trees(), st.data())
def test_what_is_not_in_the_chain_is_locked_in_it(tree, data):
    """The same tree, once with all other joints written down as fixed ones."""
    tip = data.draw(st.sampled_from(leaves(tree)))
    names = tree.path(tip)
    rigid = tree_file(tree, fixed=set(range(len(tree.parts))) - set(names))
    arm, other = read_urdf(tree_file(tree), tip=f"link{tip}"), read_urdf(rigid)
    assert arm == other
    assert [b.name for b in arm.links] == [f"link{k}" for k in names]


@a_few
@given(trees(), st.data())
def test_a_locked_joint_is_fixed_where_it_is_held(tree, data):
    tip = data.draw(st.sampled_from(leaves(tree)))
    held = {k: data.draw(angles) for k in range(len(tree.parts)) if data.draw(st.booleans())}
    free = [k for k in tree.path(tip) if k not in held]
    locked = {f"j{k}": q for k, q in held.items()}
    if not free:
        with pytest.raises(ValueError, match=r"no joint moves between the links 'base' and 'link"):
            read_urdf(tree_file(tree), tip=f"link{tip}", locked=locked)
        return
    arm = read_urdf(tree_file(tree), tip=f"link{tip}", locked=locked)
    whole = read_urdf(tree_file(tree, at=held), tip=f"link{tip}", locked=locked.keys())
    q, qd, z = (data.draw(vectors(arm.n)) for _ in range(3))
    size = 100 * np.max(np.abs(whole.M(q))) + 1000
    assert_close(arm.M(q), whole.M(q))
    assert_close(arm.rnea(q, qd, z), whole.rnea(q, qd, z), size)


@a_few
@given(between(-3, 3), between(-3, 3))
def test_a_mimic_beside_the_chain_stands_where_its_leader_puts_it(left, q2):
    text = arm_with_fingers()
    arm = read_urdf(text, tip="link2", locked={"left": left})
    other = read_urdf(
        arm_with_fingers(""), tip="link2", locked={"left": left, "right": 0.1 - 2 * left}
    )
    assert arm == other
    # Their y: the axis of both fingers.
    assert_close(arm.links[1].com[1], (left + 0.1 - 2 * left) / 3)
    assert_close(arm.M([0, q2]), other.M([0, q2]))


def test_a_mimic_in_the_chain_moves_only_with_another():
    text = arm_with_fingers()
    with pytest.raises(
        ValueError, match=r"^joint 'right': mimics 'left', and does not move by itself"
    ):
        read_urdf(text, tip="finger2")
    for options in ({}, {"tip": "finger1"}):
        with pytest.raises(ValueError, match=r"^joint 'right': mimics 'left', which moves.*locked"):
            read_urdf(text, **options)
    assert read_urdf(text, tip="finger2", locked=["right"]).n == 2
    assert read_urdf(text, tip="finger1", locked=["right"]).viscous == (0, 0, 0.4)
    assert read_urdf(text, locked=["left"]).n == 2


def test_mimics_of_mimics():
    follow = '<mimic joint="right" multiplier="3"/>'
    text = arm_with_fingers().replace(
        "</robot>",
        link("finger3", FINGER) + joint("third", "link2", "finger3", FINGER, follow) + "</robot>",
    )
    arm = read_urdf(text, tip="link2", locked={"left": 1.0})
    assert_close(arm.links[1].com[1], (1 - 1.9 - 5.7) / 4)


@pytest.mark.parametrize(
    ("mimic", "says"),
    [
        ("<mimic/>", "joint 'right': mimic names no joint"),
        ('<mimic joint="lift"/>', "joint 'right': mimics 'lift', but there is no joint 'lift'; near"),
        ('<mimic joint="right"/>', "the joints 'right' mimic each other"),
        ('<mimic joint="left" offset="a"/>', "joint 'right': mimic offset = 'a': needs a finite number"),
    ],
)  # fmt: skip
def test_a_bad_mimic_is_named(mimic, says):
    with pytest.raises(ValueError, match=f"^{says}"):
        read_urdf(arm_with_fingers(mimic), tip="link2")


def test_a_base_further_out_keeps_the_gravity_of_the_root():
    """The waist is turned by the file and by `locked`; both arms hang down all the same."""
    text = humanoid()
    whole = read_urdf(text, tip="left hand")
    arm = read_urdf(text, base="torso", tip="left hand", locked={"waist": 0.4})
    assert (whole.n, arm.n) == (3, 2)
    q = np.array([0.3, -0.8])
    down = rotation(TORSO.axis, 0.4).T @ [0, 0, -9.81]
    assert_close(arm.gravity, down)
    assert_close(arm.g_vec(q), whole.g_vec([0.4, *q])[1:])
    assert_close(arm.M(q), whole.M([0.4, *q])[1:, 1:])
    lunar = read_urdf(text, gravity=(0, 0, -1.62), base="torso", tip="left hand")
    assert_close(lunar.gravity, [0, 0, -1.62])


def test_without_a_tip_a_tree_is_refused_with_its_tips():
    with pytest.raises(
        ValueError, match="branch: needs one joint after the other; tip picks"
    ) as told:
        read_urdf(humanoid())
    for name in ("left hand", "right hand", "left foot", "right foot", "head"):
        assert repr(name) in str(told.value)
    assert (
        read_urdf(
            humanoid(), locked=["neck", "left hip", "right hip", "right shoulder", "right elbow"]
        ).n
        == 3
    )


def test_joints_of_other_kinds_may_stand_still_beside_the_chain():
    text = chain_file(HAND).replace(
        "</robot>",
        "".join(link(kind, HAND[0]) + joint(kind, "link1", kind, Part(kind)) for kind in KINDS)
        + "</robot>",
    )
    arm = read_urdf(text, tip="link2")
    assert (arm.n, arm.links[0].mass) == (2, 3)
    assert read_urdf(text, locked=KINDS) == arm
    with pytest.raises(ValueError, match=r"^joint 'floating': is of type 'floating'.*locked holds"):
        read_urdf(text)
    with pytest.raises(ValueError, match=r"^locked\['planar'\] = 1: this joint is planar.*at 0"):
        read_urdf(text, locked={"planar": 1})


KINDS = ("floating", "planar")


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"tip": "left hend"}, "tip: there is no link 'left hend'; near it: 'left hand'"),
        ({"base": "pelvi"}, "base: there is no link 'pelvi'; near it: 'pelvis'"),
        ({"base": 3}, "base: there is no link 3; near it: 'head'"),
        ({"base": "xyz"}, "base: there is no link 'xyz'; near it: 'head', 'left arm'"),
        ({"locked": ["weist"]}, "locked: there is no joint 'weist'; near it: 'waist'"),
        ({"locked": "waist"}, "locked = 'waist': needs names of joints, or a mapping"),
        ({"locked": None}, "locked = None: needs names"),
        ({"locked": {"waist": np.nan}}, r"locked\['waist'\] = nan: needs one finite number, in rad"),
        ({"locked": {"waist": "0"}}, r"locked\['waist'\] = '0'"),
        ({"base": "left arm", "tip": "head"}, "tip = 'head': the link 'left arm' does not carry it"),
        ({"base": "head", "tip": "head"}, "the text: no joint moves between the links 'head' and"),
        ({"gravity": (0, 1)}, r"gravity: got shape \(2,\)"),
        ({"gravity": None}, "gravity = None"),
    ],
)  # fmt: skip
def test_bad_arguments_are_named(options, says):
    with pytest.raises(ValueError, match=f"^{says}"):
        read_urdf(humanoid(), **options)


@a_few
@given(parts(("revolute", "prismatic")))
def test_friction_and_motors_of_held_joints_are_left_out(part):
    text = robot('<link name="base"/>', link("a", part), joint("j", "base", "a", part))
    side = link("b", part) + joint("k", "base", "b", part) + "</robot>"
    assert read_urdf(text.replace("</robot>", side), tip="a") == read_urdf(text)
