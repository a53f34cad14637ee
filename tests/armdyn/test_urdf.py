import io
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from armdyn.urdf import read_urdf
from tests.armdyn.arms import assert_close, vectors
from tests.armdyn.urdf_files import Part, all_moving, arms_of_parts, chain_file, joint, link, robot

A, B = Part("revolute", damping=0.5, friction=0.2), Part("prismatic", axis=(1, 0, 0), mass=2.0)
BASE = '<link name="base"/>'
# The file of each example is written over that of the one before.
files = settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture
def read(tmp_path):
    def from_text(text, **options):
        path = tmp_path / "arm.urdf"
        path.write_text(text, encoding="utf-8")
        return read_urdf(path, **options)

    return from_text


@files
@given(arms_of_parts(), st.data())
def test_a_fixed_joint_is_one_that_is_held(read, parts, data):
    arm, whole = read(chain_file(parts)), all_moving(parts)
    moving = [k for k, part in enumerate(parts) if part.type != "fixed"]
    assert arm.n == len(moving)
    assert [b.name for b in arm.links] == [f"link{k + 1}" for k in moving]
    q, qd, z = (data.draw(vectors(arm.n)) for _ in range(3))
    full = np.zeros((3, len(parts)))
    full[:, moving] = q, qd, z
    size = 36 * np.max(np.abs(whole.M(full[0])))
    square = np.ix_(moving, moving)
    assert_close(arm.M(q), whole.M(full[0])[square])
    assert_close(arm.C(q, qd), whole.C(*full[:2])[square], size)
    np.testing.assert_array_equal(arm.f_vec(qd), whole.f_vec(full[1])[moving])
    assert_close(arm.rnea(q, qd, z), whole.rnea(*full)[moving], size)
    # What is fixed to the root stays where it is: its energy is not the arm's.
    still = [k for k in range(len(parts)) if k < moving[0]]
    _, origins = whole.link_placements(full[0])
    turns, _ = whole.link_placements(full[0])
    P = whole.potential_energy(full[0])
    P -= sum(9.81 * parts[k].mass * (origins[k] + turns[k] @ parts[k].com)[2] for k in still)
    assert_close(arm.potential_energy(q), P, size + 1000)


def test_gravity_is_given(read):
    arm = read(chain_file([A, B]), gravity=(0, -1.62, 0))
    assert arm.gravity == (0, -1.62, 0)
    assert read(chain_file([A, B])).gravity == (0, 0, -9.81)


def test_friction_is_read(read):
    arm = read(chain_file([A, B]))
    assert arm.viscous == (0.5, 0)
    assert arm.coulomb == (0.2, 0)


def test_a_link_may_have_no_mass_and_a_joint_no_origin_and_no_axis(read):
    parents = '<parent link="base"/><child link="a"/>'
    text = robot(BASE, '<link name="a"/>', link("b", B), joint("j2", "a", "b", B))
    arm = read(
        text.replace("</robot>", f'<joint name="j1" type="continuous">{parents}</joint></robot>')
    )
    assert arm.links[0].mass == 0
    assert arm.links[0].axis == (1, 0, 0)
    assert arm.links[0].rotation == ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def test_an_axis_of_another_length_is_a_direction(read):
    arm = read(chain_file([replace(A, axis=(0, 3, 4))]))
    np.testing.assert_allclose(arm.links[0].axis, (0, 0.6, 0.8))


def test_a_branch_of_fixed_parts_is_no_branch(read):
    still = Part("fixed", xyz=(1, 0, 0))
    text = robot(
        BASE,
        link("a", A),
        link("left", A),
        link("right", A),
        joint("j1", "base", "a", A),
        joint("j2", "a", "left", still),
        joint("j3", "a", "right", replace(still, xyz=(-1, 0, 0))),
    )
    arm = read(text)
    assert arm.links[0].mass == 3
    np.testing.assert_allclose(arm.links[0].com, np.zeros(3), atol=1e-15)
    np.testing.assert_allclose(np.diag(arm.links[0].inertia), [3, 5, 5])


TWO = (BASE, link("a", A), link("b", B))
ONE = joint("j1", "base", "a", A)
BAD = {
    "branch": ((*TWO, ONE, joint("j2", "base", "b", B)), "joints 'j1', 'j2' branch"),
    "branch later": (
        (*TWO, link("c", A), ONE, joint("j2", "a", "b", B), joint("j3", "a", "c", A)),
        "joints 'j2', 'j3' branch",
    ),
    "branch at a fixed part": (
        (*TWO, link("c", A), joint("j1", "base", "a", Part("fixed")), joint("j2", "base", "b", B),
         joint("j3", "a", "c", A)),
        "joints 'j[23]', 'j[23]' branch",
    ),
    "mimic": ((*TWO, ONE, joint("j2", "a", "b", B, '<mimic joint="j1"/>')), "'j2': mimics 'j1'"),
    "floating": (
        (BASE, link("a", A), joint("j1", "base", "a", Part("floating"))),
        "joint 'j1': is of type 'floating', needs revolute, continuous, prismatic or fixed; locked",
    ),
    "planar": ((BASE, link("a", A), joint("j1", "base", "a", Part("planar"))),
               "joint 'j1': is of type 'planar'"),
    "typo": ((*TWO, joint("j1", "base", "a", Part("hinge"))), "joint 'j1': is of type 'hinge'"),
    "no such link": ((*TWO, joint("j1", "base", "x", A)), "joint 'j1': there is no link 'x'"),
    "two roots": ((*TWO, ONE), r"\['base', 'b'\] have no parent joint"),
    "no root": ((link("a", A), link("b", B), joint("j1", "a", "b", A), joint("j2", "b", "a", B)),
                r"joints form a loop: needs one link without"),
    "apart": (
        (BASE, link("a", A), link("b", B), joint("j1", "a", "b", A), joint("j2", "b", "a", B)),
        "link 'a': no joints lead to it",
    ),
    "closed": ((*TWO, ONE, joint("j2", "a", "b", B), joint("j3", "base", "b", B)),
               "link 'b': has two parent joints, 'j2' and 'j3', a loop"),
    "link twice": ((*TWO, link("a", A), ONE, joint("j2", "a", "b", B)), "link 'a': appears more"),
    "joint twice": ((*TWO, ONE, joint("j1", "a", "b", B)), "joint 'j1': appears more than once"),
    "nothing moves": ((BASE, link("a", A), joint("j1", "base", "a", Part("fixed"))),
                      r"arm\.urdf: no joint moves"),
    "no links": ((), r"arm\.urdf: cannot be read as URDF: has no links"),
    "negative mass": ((BASE, link("a", replace(A, mass=-1.0)), ONE),
                      "link 'a': mass value = -1: needs a number that is not neg"),
    "no mass": ((BASE, link("a", A).replace("mass", "weight"), ONE), "link 'a': its inertial"),
    "impossible inertia": (
        (BASE, link("a", replace(A, principal=(1, 1, 3))), ONE),
        "link 'a': inertia = .*triangle",
    ),
    "zero axis": ((BASE, link("a", A), joint("j1", "base", "a", replace(A, axis=(0, 0, 0)))),
                  "joint 'j1': axis = 0 0 0, needs a direction"),
    "nan": ((BASE, link("a", replace(A, com=(np.nan, 0, 0))), ONE),
            "link 'a': inertial origin xyz = 'nan 0 0': needs 3 finite numbers"),
    "negative damping": (
        (BASE, link("a", A), joint("j1", "base", "a", replace(A, damping=-1.0))),
        "joint 'j1': damping = -1: needs a number that is not negative",
    ),
    "no number": ((BASE, link("a", A), ONE.replace('friction="0.2', 'friction="little')),
                  "joint 'j1': friction = 'little.*': needs a finite number"),
}  # fmt: skip


@pytest.mark.parametrize(("elements", "says"), BAD.values(), ids=BAD)
def test_what_is_not_one_chain_is_named(read, elements, says):
    with pytest.raises(ValueError, match=says):
        read(robot(*elements))


NOT_URDF = ["", "robot", "<robot/>", chain_file([A, B])[:-40], "<sdf><robot/></sdf>", "<robot>&x;"]


@pytest.mark.parametrize("text", NOT_URDF)
def test_what_is_not_urdf_is_refused(read, text):
    with pytest.raises(ValueError, match=r"arm\.urdf: cannot be read as URDF"):
        read(text)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"none\.urdf: no such file"):
        read_urdf(tmp_path / "none.urdf")


def test_a_text_and_an_open_file_are_taken_as_a_path_is(read, tmp_path):
    arm = read(chain_file([A, B]))
    assert read_urdf("\n" + chain_file([A, B])) == arm
    assert read_urdf("\ufeff" + chain_file([A, B])) == arm
    assert read_urdf(chain_file([A, B]).encode("utf-8-sig")) == arm
    assert read_urdf(io.StringIO(chain_file([A, B]))) == arm
    assert read_urdf(chain_file([A, B]).encode()) == arm
    assert read_urdf(str(tmp_path / "arm.urdf")) == arm
    for mode in ("r", "rb"):
        with open(tmp_path / "arm.urdf", mode) as file:
            assert read_urdf(file) == arm


def test_a_text_has_no_encoding_any_more():
    text = (
        chain_file([A]).replace("1.0", "1.0" + '" encoding="latin-1').replace("link1", "Glied 1ö")
    )
    assert read_urdf(text).links[0].name == "Glied 1ö"
    assert read_urdf(text.encode("latin-1")).links[0].name == "Glied 1ö"


@pytest.mark.parametrize("source", [None, 3, ["<robot/>"]])
def test_what_is_no_source_is_named(source):
    with pytest.raises(
        ValueError, match=r"^source = .*: needs a path, a URDF text or an open file"
    ):
        read_urdf(source)


HARMLESS = {
    "undeclared prefix": ("<link name", '<link drake:collision="off" name'),
    "undeclared element": ("</robot>", "<sensor:camera><xacro:if/></sensor:camera></robot>"),
    "default namespace": ("<robot", '<robot xmlns="http://www.ros.org"'),
    "unknown shape": (
        "</link>",
        "<collision><geometry><torus r='1'/></geometry></collision></link>",
    ),
    "empty visual": ("</link>", "<visual/></link>"),
    "a mesh that is not there": (
        "</link>",
        '<visual><geometry><mesh filename="package://x/y"/></geometry></visual></link>',
    ),
    "material without a colour": ("</link>", "<visual><material/></visual></link>"),
    "limits without numbers": ('lower="-1" upper="1" effort="1" velocity="1"', 'lower="a"'),
    "another program's joint": ("</robot>", '<gazebo><joint name="j1"/></gazebo></robot>'),
    "comment and doctype": ("<robot", "<!DOCTYPE robot><!-- an arm --><robot"),
}


@pytest.mark.parametrize(("old", "new"), HARMLESS.values(), ids=HARMLESS)
def test_what_dynamics_does_not_need_may_be_as_it_likes(old, new):
    text = chain_file([A, B])
    assert text.replace(old, new) != text
    assert read_urdf(text.replace(old, new)) == read_urdf(text)


def test_products_of_inertia_may_be_missing():
    text = chain_file([A])
    assert read_urdf(text.replace('ixy="0" ixz="0" iyz="0"', "")) == read_urdf(text)
    with pytest.raises(ValueError, match=r"^link 'link1': inertia iyy is missing: needs a finite"):
        read_urdf(text.replace("iyy", "Iyy"))


def test_a_robot_may_hang_on_a_world_without_a_link():
    stand = joint("stand", "world", "base", Part("fixed", xyz=(0, 0, 1)))
    arm = read_urdf(chain_file([A]).replace("</robot>", stand + "</robot>"))
    assert arm.links[0].translation == (0, 0, 1)


def test_unexpanded_xacro_is_called_so():
    with pytest.raises(ValueError, match="has no links: expand its xacro macros first"):
        read_urdf('<robot><xacro:macro name="arm"><link name="a"/></xacro:macro></robot>')
    text = chain_file([A]).replace('mass value="1"', 'mass value="${m}"')
    with pytest.raises(
        ValueError, match=r"^link 'link1': mass value = '\$\{m\}'.*expand its xacro"
    ):
        read_urdf(text)


def motor(name, *elements):
    return (
        f'<transmission type="SimpleTransmission"><joint name="{name}"/>'
        f'<actuator name="motor">{"".join(elements)}</actuator></transmission></robot>'
    )


ROTOR, GEAR = '<drake:rotor_inertia value="2e-3"/>', '<drake:gear_ratio value="-50"/>'


@pytest.mark.parametrize(
    ("elements", "armature"), [((ROTOR, GEAR), 5.0), ((ROTOR,), 2e-3), ((GEAR,), 0.0), ((), 0.0)]
)
def test_motors_of_drake_are_read(elements, armature):
    text = chain_file([A, B]).replace("</robot>", motor("j2", *elements))
    np.testing.assert_allclose(read_urdf(text).armature, (0, armature))


def test_a_bad_motor_is_named():
    text = chain_file([A]).replace("</robot>", motor("j1", ROTOR.replace("2e", "-2e")))
    with pytest.raises(
        ValueError, match=r"^transmission of joint 'j1': drake:rotor_inertia value = -"
    ):
        read_urdf(text)


@pytest.mark.parametrize("principal", [(1, 1, 3), (1, 1, -0.5)])
def test_an_impossible_inertia_is_read_with_a_warning(principal):
    text = chain_file([A, replace(A, principal=principal), A])
    with pytest.raises(ValueError, match=r"^link 'link2': inertia = .*inertia=\"warn\""):
        read_urdf(text)
    with pytest.warns(UserWarning, match=r"^link 'link2': inertia = .*(triangle|negative)") as told:
        arm = read_urdf(text, inertia="warn")
    assert len(told) == 1
    np.testing.assert_array_equal(np.diag(arm.links[1].inertia), principal)
    with pytest.raises(ValueError, match=r"^inertia = 'ignore': needs 'error' or 'warn'"):
        read_urdf(text, inertia="ignore")


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(IsADirectoryError, match="a folder; needs the URDF file in it"):
        read_urdf(tmp_path)
