"""The mechanisms of problems once more, for others to derive: bodies in space, and chains of links.

Nothing is taken from a mechanism's energies. Where a body is follows from what the coordinates are 0
at, and how heavy it is from what the parameters are said to be.
"""

import math

import numpy as np
import sympy as sp

from armdyn import Link, SerialChain
from tests.peers.scene import Scene

DOWN = -sp.pi / 2


def pendulum(p) -> Scene:
    scene = Scene(("q",), p.g)
    rod = scene.N.orientnew("A", "Axis", (scene.q[0] + DOWN, scene.N.z))
    scene.body(scene.point(scene.origin, p.lc * rod.x), rod, p.m, (0, 0, p.I), scene.origin)
    return scene


def planar_arm(p, n=2, absolute=False, zero=sp.S.Zero, beside=False, slope=sp.S.Zero) -> Scene:
    scene = Scene(tuple(f"q{i + 1}" for i in range(n)), p.g, (-sp.sin(slope), sp.cos(slope), 0))
    base = frame = scene.N.orientnew("B", "Axis", (zero, scene.N.z))
    joint = scene.origin
    for i, q in enumerate(scene.q, 1):
        frame = (base if absolute else frame).orientnew(f"A{i}", "Axis", (q, scene.N.z))
        l, lc, m, I = (getattr(p, f"{name}{i}") for name in ("l", "lc", "m", "I"))
        aside = getattr(p, f"ly{i}") if beside else 0
        scene.body(scene.point(joint, lc * frame.x + aside * frame.y), frame, m, (0, 0, I))
        joint = scene.point(joint, l * frame.x)
    return scene


def cart_pole(p, spring=False) -> Scene:
    scene = Scene(("x", "theta"), p.g)
    x, theta = scene.q
    hinge = scene.point(scene.origin, x * scene.N.x)
    scene.particle(hinge, p.mc)
    pole = scene.N.orientnew("A", "Axis", (-theta, scene.N.z))
    scene.body(scene.point(hinge, p.lc * pole.y), pole, p.m, (0, 0, p.I))
    if spring:
        scene.springs.append((p.k * x**2 / 2, [(hinge, -p.k * x * scene.N.x)]))
    return scene


def turn_and_slide(p) -> Scene:
    scene = Scene(("q1", "q2"), p.g)
    q1, q2 = scene.q
    arm = scene.N.orientnew("A", "Axis", (q1, scene.N.z))
    scene.body(scene.point(scene.origin, p.lc1 * arm.x), arm, p.m1, (0, 0, p.I1))
    scene.body(scene.point(scene.origin, q2 * arm.x), arm, p.m2, (0, 0, p.I2))
    return scene


def furuta(p) -> Scene:
    """The pendulum swings about the arm, and is slender."""
    scene = Scene(("q1", "q2"), p.g, up=(0, 0, 1))
    q1, q2 = scene.q
    arm = scene.N.orientnew("A", "Axis", (q1, scene.N.z))
    pivot = scene.point(scene.origin, p.l1 * arm.x)
    rod = arm.orientnew("B", "Axis", (q2, arm.x))
    scene.body(scene.origin, arm, 0, (0, 0, p.J1))
    scene.body(scene.point(pivot, -p.lc2 * rod.z), rod, p.m2, (p.I2, p.I2, 0))
    return scene


def spherical_pendulum(p) -> Scene:
    scene = Scene(("theta", "phi"), p.g, up=(0, 0, 1))
    theta, phi = scene.q
    about = scene.N.orientnew("A", "Axis", (phi, scene.N.z))
    rod = about.orientnew("B", "Axis", (-theta, about.y))
    scene.particle(scene.point(scene.origin, -p.l * rod.z), p.m)
    return scene


def slider_crank(p) -> Scene:
    """A loop: the slider has a coordinate x of its own, and the rod keeps the distance to the pin."""

    def closing(q, qd, arm):
        pin = arm.r * np.cos(q[0]), arm.r * np.sin(q[0])
        x = pin[0] + np.sqrt(arm.l**2 - pin[1] ** 2)
        return (x,), (-x * pin[1] * qd[0] / (x - pin[0]),)

    scene = Scene(("q",), p.g, tied=("x",), closing=closing)
    q, x = scene.q
    crank = scene.N.orientnew("A", "Axis", (q, scene.N.z))
    scene.body(scene.point(scene.origin, p.lc * crank.x), crank, p.mc, (0, 0, p.J), scene.origin)
    slider = scene.point(scene.origin, x * scene.N.x)
    scene.particle(slider, p.m)
    rod = slider.pos_from(scene.origin) - p.r * crank.x
    scene.constraints.append(rod.dot(rod) - p.l**2)
    return scene


def elastic_joint(p) -> Scene:
    scene = Scene(("q1", "q2"), p.g)
    q1, q2 = scene.q
    link = scene.N.orientnew("A", "Axis", (q1, scene.N.z))
    motor = scene.N.orientnew("B", "Axis", (q2, scene.N.z))
    scene.body(scene.point(scene.origin, p.lc * link.x), link, p.m, (0, 0, p.I), scene.origin)
    scene.body(scene.origin, motor, 0, (0, 0, p.J))
    torque = p.k * (q2 - q1) * scene.N.z
    scene.springs.append((p.k * (q1 - q2) ** 2 / 2, [(link, torque), (motor, -torque)]))
    return scene


SCENES = {
    "pendulum": pendulum,
    "planar-2r": planar_arm,
    "planar-2r-absolute": lambda p: planar_arm(p, absolute=True),
    "planar-2r-hanging": lambda p: planar_arm(p, zero=DOWN),
    "planar-2r-beside": lambda p: planar_arm(p, beside=True),
    "planar-2r-slope": lambda p: planar_arm(p, slope=sp.pi / 6),
    "cart-pole": cart_pole,
    "turn-and-slide": turn_and_slide,
    "planar-3r": lambda p: planar_arm(p, n=3),
    "spring-cart": lambda p: cart_pole(p, spring=True),
    "furuta": furuta,
    "spherical-pendulum": spherical_pendulum,
    "slider-crank": slider_crank,
    "elastic-joint": elastic_joint,
}


# Which way gravity pulls, by the axis of the base that points up or down.
Y_UP, X_DOWN, Z_UP = (0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0)
SLOPING = (math.sin(math.pi / 6), -math.cos(math.pi / 6), 0.0)


def turning(mass, com, spin=(0.0, 0.0, 0.0), **at) -> Link:
    return Link("revolute", mass, com, tuple(map(tuple, np.diag(spin))), **at)


def plate(I) -> tuple[float, float, float]:
    """Inertias of a body that turns about z alone: that about z counts."""
    return I / 2, I / 2, I


def pendulum_links(arm):
    return (turning(arm.m, (arm.lc, 0.0, 0.0), plate(arm.I - arm.m * arm.lc**2)),)


def planar_links(arm, n=2, beside=False):
    links, before = [], 0.0
    for i in range(1, n + 1):
        l, lc, m, I = (getattr(arm, f"{name}{i}") for name in ("l", "lc", "m", "I"))
        com = (lc, getattr(arm, f"ly{i}") if beside else 0.0, 0.0)
        links.append(turning(m, com, plate(I), translation=(before, 0.0, 0.0)))
        before = l
    return links


def cart_links(arm):
    """θ is positive clockwise, so the pole's joint turns about −z."""
    cart = Link("prismatic", arm.mc, axis=(1.0, 0.0, 0.0))
    return cart, turning(arm.m, (0.0, arm.lc, 0.0), plate(arm.I), axis=(0.0, 0.0, -1.0))


def sliding_links(arm):
    link = turning(arm.m1, (arm.lc1, 0.0, 0.0), plate(arm.I1))
    spin = tuple(map(tuple, np.diag(plate(arm.I2))))
    return link, Link("prismatic", arm.m2, inertia=spin, axis=(1.0, 0.0, 0.0))


def furuta_links(arm):
    rod = turning(
        arm.m2,
        (0.0, 0.0, -arm.lc2),
        (arm.I2, arm.I2, 0.0),
        axis=(1.0, 0.0, 0.0),
        translation=(arm.l1, 0.0, 0.0),
    )
    return turning(0.0, (0.0, 0.0, 0.0), plate(arm.J1)), rod


def spherical_links(arm):
    return (
        turning(0.0, (0.0, 0.0, 0.0)),
        turning(arm.m, (0.0, 0.0, -arm.l), axis=(0.0, -1.0, 0.0)),
    )


# Each with the direction of gravity; what is no open chain, or has a spring, is not among them.
LINKS = {
    "pendulum": (pendulum_links, X_DOWN),
    "planar-2r": (planar_links, Y_UP),
    "planar-2r-hanging": (planar_links, X_DOWN),
    "planar-2r-beside": (lambda arm: planar_links(arm, beside=True), Y_UP),
    "planar-2r-slope": (planar_links, SLOPING),
    "cart-pole": (cart_links, Y_UP),
    "turn-and-slide": (sliding_links, Y_UP),
    "planar-3r": (lambda arm: planar_links(arm, n=3), Y_UP),
    "furuta": (furuta_links, Z_UP),
    "spherical-pendulum": (spherical_links, Z_UP),
}


def chain(name: str, arm) -> SerialChain:
    links, gravity = LINKS[name]
    return SerialChain(tuple(links(arm)), gravity=tuple(arm.g * x for x in gravity))
