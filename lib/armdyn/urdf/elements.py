"""What dynamics needs of a URDF file: its links' inertia, its joints, and their motors.

The standard library's expat reads the XML, without namespaces: published files use prefixes that
they do not declare, or a default namespace, and a reader of namespaces takes either amiss. What is
not listed here (shapes, limits, sensors, other programs' elements) may be as it likes.
"""

import os
from dataclasses import dataclass
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

import numpy as np
from scipy.spatial.transform import Rotation

MOVING = ("revolute", "continuous", "prismatic")
TYPES = (*MOVING, "fixed", "floating", "planar")


@dataclass(frozen=True)
class Mass:
    """A rigid part: mass (kg), centre of mass (3,), and inertia (3, 3) about that centre."""

    mass: float
    com: np.ndarray
    inertia: np.ndarray


@dataclass(frozen=True)
class Mimic:
    """q = multiplier × (q of the joint `leader`) + offset."""

    leader: str
    multiplier: float
    offset: float


@dataclass(frozen=True, eq=False)
class UrdfJoint:
    """origin: (4, 4), of the joint in the parent link's frame. axis: (3,), as long as in the file."""

    name: str
    type: str
    parent: str
    child: str
    origin: np.ndarray
    axis: np.ndarray
    damping: float
    friction: float
    mimic: Mimic | None


@dataclass(frozen=True)
class Robot:
    """source: the file's name. links: name → its Mass, or None for a link without inertia. joints:
    by name. armature: of each joint with a motor, kg·m² or kg."""

    source: str
    links: dict[str, Mass | None]
    joints: dict[str, UrdfJoint]
    armature: dict[str, float]


def robot_of(source) -> Robot:
    """The robot in a file (its path, or the file open for reading) or in a text.

    Raises FileNotFoundError where there is no such file, IsADirectoryError for a folder, and
    ValueError, naming the element, for what is not URDF.
    """
    text, where = _text(source)
    root = _root_element(text, where)
    if root.tag != "robot":
        raise ValueError(f"{where}: cannot be read as URDF: begins with <{root.tag}>, not <robot>")
    links = {name: _mass(name, link) for name, link in _named(root, "link").items()}
    joints = {name: _joint(name, joint) for name, joint in _named(root, "joint").items()}
    if not links:
        xacro = any(element.tag.startswith("xacro:") for element in root.iter())
        advice = ": expand its xacro macros first" if xacro else ""
        raise ValueError(f"{where}: cannot be read as URDF: has no links{advice}")
    return Robot(where, links, joints, _armatures(root))


def _text(source) -> tuple[bytes | str, str]:
    if hasattr(source, "read"):
        return source.read(), f"{getattr(source, 'name', 'the file')}"
    if isinstance(source, bytes) or (isinstance(source, str) and _bare(source).startswith("<")):
        return source, "the text"
    if not isinstance(source, str | os.PathLike):
        raise ValueError(f"source = {source!r}: needs a path, a URDF text or an open file")
    path = os.fspath(source)
    if os.path.isdir(path):
        raise IsADirectoryError(f"{path}: a folder; needs the URDF file in it")
    if not os.path.isfile(path):
        raise FileNotFoundError(f"{path}: no such file")
    with open(path, "rb") as file:
        return file.read(), str(path)


def _bare(text) -> str:
    """Without what may stand before the first element: white space, and a byte order mark."""
    return text.lstrip("\ufeff \t\r\n")


def _root_element(text, where) -> Element:
    builder = TreeBuilder()
    # A text has been decoded, whatever encoding its first line names.
    parser = expat.ParserCreate("utf-8" if isinstance(text, str) else None)
    parser.StartElementHandler = builder.start
    parser.EndElementHandler = builder.end
    encoded = _bare(text).encode() if isinstance(text, str) else text
    try:
        parser.Parse(encoded, True)
    except expat.ExpatError as error:
        raise ValueError(f"{where}: cannot be read as URDF: {error}") from error
    return builder.close()


def _named(root, kind) -> dict[str, Element]:
    named: dict[str, Element] = {}
    for position, element in enumerate(root.findall(kind), start=1):
        name = element.get("name")
        if not name:
            raise ValueError(f"{kind} number {position}: has no name")
        if name in named:
            raise ValueError(f"{kind} {name!r}: appears more than once")
        named[name] = element
    return named


def _mass(name, link) -> Mass | None:
    inertial = link.find("inertial")
    if inertial is None:
        return None
    where = f"link {name!r}: "
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    if mass is None or inertia is None:
        raise ValueError(f"{where}its inertial element needs a mass and an inertia")
    xx, yy, zz = (_number(f"{where}inertia ", inertia, f"i{ij}") for ij in ("xx", "yy", "zz"))
    xy, xz, yz = (_number(f"{where}inertia ", inertia, f"i{ij}", "0") for ij in ("xy", "xz", "yz"))
    at = _origin(f"{where}inertial ", inertial)
    R = at[:3, :3]
    about_com = R @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ R.T
    return Mass(_not_negative(f"{where}mass ", mass, "value"), at[:3, 3], about_com)


def _joint(name, joint) -> UrdfJoint:
    where = f"joint {name!r}: "
    kind = joint.get("type")
    if kind not in TYPES:
        raise ValueError(f"{where}is of type {kind!r}, needs {', '.join(MOVING)} or fixed")
    axis, mimic, dynamics = (joint.find(tag) for tag in ("axis", "mimic", "dynamics"))
    follows = None
    if mimic is not None:
        if not mimic.get("joint"):
            raise ValueError(f"{where}mimic names no joint")
        follows = Mimic(
            mimic.get("joint"),
            _number(f"{where}mimic ", mimic, "multiplier", "1"),
            _number(f"{where}mimic ", mimic, "offset", "0"),
        )
    return UrdfJoint(
        name,
        kind,
        parent=_end(where, joint, "parent"),
        child=_end(where, joint, "child"),
        origin=_origin(where, joint),
        axis=_vector(f"{where}axis ", axis, "xyz", "1 0 0"),
        damping=_not_negative(where, dynamics, "damping", "0"),
        friction=_not_negative(where, dynamics, "friction", "0"),
        mimic=follows,
    )


def _end(where, joint, end) -> str:
    element = joint.find(end)
    link = None if element is None else element.get("link")
    if not link:
        raise ValueError(f"{where}has no {end} link")
    return link


def _armatures(root) -> dict[str, float]:
    """Of the joints whose actuator says it in the elements of Drake: ratio² × rotor inertia."""
    armatures: dict[str, float] = {}
    for transmission in root.findall("transmission"):
        joint, actuator = transmission.find("joint"), transmission.find("actuator")
        if joint is None or actuator is None:
            continue
        name = joint.get("name", "")
        where = f"transmission of joint {name!r}: "
        rotor, ratio = (actuator.find(f"drake:{tag}") for tag in ("rotor_inertia", "gear_ratio"))
        inertia = _not_negative(f"{where}drake:rotor_inertia ", rotor, "value", "0")
        turns = _number(f"{where}drake:gear_ratio ", ratio, "value", "1")
        armatures[name] = armatures.get(name, 0.0) + turns**2 * inertia
    return armatures


def _origin(where, element) -> np.ndarray:
    origin = element.find("origin")
    placement = np.eye(4)
    rpy = _vector(f"{where}origin ", origin, "rpy", "0 0 0")
    placement[:3, :3] = Rotation.from_euler("xyz", rpy).as_matrix()
    placement[:3, 3] = _vector(f"{where}origin ", origin, "xyz", "0 0 0")
    return placement


def _vector(where, element, attribute, default) -> np.ndarray:
    return _numbers(where, element, attribute, 3, default)


def _number(where, element, attribute, default=None) -> float:
    return float(_numbers(where, element, attribute, 1, default)[0])


def _not_negative(where, element, attribute, default=None) -> float:
    number = _number(where, element, attribute, default)
    if number < 0:
        raise ValueError(f"{where}{attribute} = {number:g}: needs a number that is not negative")
    return number


def _numbers(where, element, attribute, count, default) -> np.ndarray:
    text = default if element is None else element.get(attribute, default)
    needs = f"{count} finite numbers" if count > 1 else "a finite number"
    if text is None:
        raise ValueError(f"{where}{attribute} is missing: needs {needs}")
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.array([])
    if len(numbers) != count or not np.isfinite(numbers).all():
        advice = "; expand its xacro macros first" if "${" in text else ""
        raise ValueError(f"{where}{attribute} = {text!r}: needs {needs}{advice}")
    return numbers
