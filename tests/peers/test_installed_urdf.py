"""URDF files that come with other packages: read as they are, and the robots that Pinocchio reads."""

from pathlib import Path

import numpy as np
import pytest

from armdyn.urdf import read_urdf
from armdyn.urdf.elements import robot_of
from armdyn.urdf.tree import WORLD, Tree
from tests.armdyn.arms import assert_close
from tests.peers.built import library, of_pinocchio

pin = library("pinocchio")
FOLDERS = {name: Path(library(name).__file__).parent for name in ("pydrake", "rtbdata")}
FILES = {
    f"{name}: {path.stem}": path
    for name, folder in FOLDERS.items()
    for path in sorted(folder.rglob("*.urdf"))
    # One file of rtbdata is a list of links without any XML.
    if path.read_bytes().lstrip().startswith(b"<")
}


def test_there_are_robots_among_them():
    assert len(FILES) > 15
    assert sum(bool(tips_of(path)) for path in FILES.values()) > 8


def tips_of(path) -> list[str]:
    tree = Tree(robot_of(path))
    return tree.tips(tree.root)


def in_pinocchio(path):
    """It knows no link `world` that the file does not declare, as Drake does."""
    text = path.read_text(encoding="utf-8")
    robot = robot_of(path)
    if WORLD in {joint.parent for joint in robot.joints.values()} - robot.links.keys():
        text = text.replace("</robot>", '<link name="world"/></robot>')
    return pin.buildModelFromXML(text)


@pytest.mark.filterwarnings("ignore:link .*inertia")
@pytest.mark.parametrize("path", FILES.values(), ids=FILES)
def test_each_chain_is_the_reduced_model_of_pinocchio(path):
    tips = tips_of(path)
    if not tips:
        with pytest.raises(ValueError, match="no joint moves"):
            read_urdf(path)
        return
    tree, whole = Tree(robot_of(path)), in_pinocchio(path)
    rest = pin.neutral(whole)
    for tip in tips:
        arm = read_urdf(path, tip=tip, inertia="warn")
        joints = [tree.carrier[link.name].name for link in arm.links]
        held = [k for k in range(1, whole.njoints) if whole.names[k] not in joints]
        model = pin.buildReducedModel(whole, held, rest)
        assert list(model.names)[1:] == joints
        still = pin.neutral(model)
        other = of_pinocchio(
            model, lambda q, model=model, still=still: pin.integrate(model, still, q)
        )
        q, qd = np.random.default_rng(0).uniform(-1, 1, size=(2, arm.n))
        M, weight = other.M(q), 10 * sum(link.mass for link in arm.links)
        assert_close(arm.M(q), M)
        assert_close(arm.C(q, qd), other.C(q, qd), 9 * np.max(np.abs(M)))
        assert_close(arm.g_vec(q), other.g_vec(q), weight)
        np.testing.assert_array_equal(arm.viscous, model.damping)
        np.testing.assert_array_equal(arm.coulomb, model.friction)
