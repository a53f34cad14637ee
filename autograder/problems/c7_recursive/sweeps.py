"""The two sweeps of Newton and Euler over a chain in space, right or with something changed.

A chain is a namespace: axis, offset and com (n, 3), m and viscous (n,), I (n, 3, 3), gravity (3,), as
the problem's notebook describes them.
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from autograder.protocol import Call

AFTER, BEFORE = [1, 2, 0], [2, 0, 1]


def cross(a, b) -> np.ndarray:
    """a × b, (..., 3); np.cross takes ten times as long for few vectors."""
    return a[..., AFTER] * b[..., BEFORE] - a[..., BEFORE] * b[..., AFTER]


def rotation(axis, angle) -> np.ndarray:
    """The matrix that turns a vector about a unit axis, (..., 3, 3): Rodrigues' formula.

    axis: (..., 3). angle: (...,), rad.
    """
    K = cross(np.eye(3), axis[..., np.newaxis, :])  # K v is the axis × v
    angle = np.asarray(angle)[..., np.newaxis, np.newaxis]
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)


@dataclass(frozen=True)
class Sweeps:
    """What rnea(q, qd, qdd, chain) returns, (n,), N·m.

    Each number is how often a part counts: 0 leaves it out, −1 turns its sign.

    gravity: the base's acceleration; weight: each link's weight, which that already holds. spin, turn:
    the angular velocity and acceleration of the link before; own_turn: the joint's own; twist: what the
    turning of its axis adds. joint_along, joint_centre: the joint's acceleration on the link before, by
    angular acceleration and by velocity; along, centre: the centre of mass's. euler, gyro: I α and
    ω × I ω. lever: a link's force about its joint. parallel: the inertia carried over to the joint.
    torque, force: what the next link hands down; arm: its force about this joint.

    part: of the moment that the motor gives: "axis", or "third" component, or "length". about_before: it
    is that about the joint before. out, back: whether vectors are turned into the next link's axes and
    back; −1 turns them the wrong way. back_by: the joint by whose angle they are turned back, "next" or
    "own". in_base: the entry of the chain that is used as if its axes were the base's. joint_at, arm_at:
    what is taken for the next joint's place, outwards and inwards: "offset", "com", or that of the joint
    "before" it. own_axes_out, own_axes_in: that place is used as if it were given in the axes of
    the next link itself. rates: whose angular velocity and acceleration carry the joint: those of the
    link "before", or its "own", or these as if their "axes" were that link's. twist_early: what the
    turning of the axis adds is formed with ω in the axes of the link before. from_centre: the next
    joint's acceleration starts from that of the centre of mass. joint_inwards, inwards: the acceleration
    towards the axis, of the joint and of the centre: "cross" is ω × (ω × r), "once" ω × r, "plane"
    −ω² r. lever_of_all: the centre of mass is the arm of the whole force. unturned, backward: the one
    vector that is handed on as it is, or turned the wrong way: "omega", "alpha", "a", "f", "t", "down".
    """

    gravity: float = 1.0
    weight: float = 0.0
    spin: float = 1.0
    turn: float = 1.0
    own_turn: float = 1.0
    twist: float = 1.0
    joint_along: float = 1.0
    joint_centre: float = 1.0
    along: float = 1.0
    centre: float = 1.0
    euler: float = 1.0
    gyro: float = 1.0
    lever: float = 1.0
    parallel: float = 0.0
    torque: float = 1.0
    force: float = 1.0
    arm: float = 1.0
    friction: float = 1.0
    part: str = "axis"
    about_before: bool = False
    out: int = 1
    back: int = 1
    back_by: str = "next"
    in_base: str = ""
    joint_at: str = "offset"
    arm_at: str = "offset"
    own_axes_out: bool = False
    own_axes_in: bool = False
    rates: str = "before"
    twist_early: bool = False
    from_centre: bool = False
    joint_inwards: str = "cross"
    inwards: str = "cross"
    lever_of_all: bool = False
    unturned: str = ""
    backward: str = ""

    def __call__(self, q, qd, qdd, chain) -> np.ndarray:
        """Of one chain, or with a leading axis of as many as there are."""
        n = q.shape[-1]
        R = [rotation(chain.axis[..., k, :], q[..., k]) for k in range(n)]
        own = self._own(chain, R)
        a, down = -self.gravity * chain.gravity, chain.gravity
        omega, alpha = np.zeros_like(a), np.zeros_like(a)
        forces, torques = [], []
        for k in range(n):
            r, out = _place(own, k, self.joint_at), _turned(_transposed(R[k]), self.out)
            if self.rates == "before" and not self.own_axes_out:
                a = a + self._from_joint(omega, alpha, r)  # in the axes of the link before
            early = omega
            omega, alpha = self._handed("omega", out, omega), self._handed("alpha", out, alpha)
            a, down = self._handed("a", out, a), self._handed("down", out, down)
            if self.rates == "before" and self.own_axes_out:
                a = a + self._from_joint(omega, alpha, r)
            axis, c, m = own.axis[..., k, :], own.com[..., k, :], chain.m[..., k, np.newaxis]
            joint = axis * qd[..., k, np.newaxis]
            turning = cross(early if self.twist_early else omega, joint)
            alpha = self.turn * alpha + self.twist * turning
            alpha = alpha + self.own_turn * axis * qdd[..., k, np.newaxis]
            omega = self.spin * omega + joint
            if self.rates == "own":
                turned = r if self.own_axes_out else np.matvec(out, r)
                a = a + self._from_joint(omega, alpha, turned)
            elif self.rates == "axes":
                a = a + np.matvec(out, self._from_joint(omega, alpha, r))
            towards = _inwards(omega, c, self.inwards)
            of_centre = a + self.along * cross(alpha, c) + self.centre * towards
            F = m * of_centre - self.weight * m * down
            if self.from_centre:
                a = of_centre
            I = own.I[..., k, :, :]
            if self.parallel:
                I = I + self.parallel * m[..., np.newaxis] * _of_point(c)
            gyro = cross(omega, np.matvec(I, omega))
            N = self.euler * np.matvec(I, alpha) + self.gyro * gyro
            forces.append(F)
            torques.append(N + self.lever * cross(c, F))
        u = self.friction * chain.viscous * qd
        f, t = np.zeros_like(a), np.zeros_like(a)
        for k in reversed(range(n)):
            if k + 1 < n:
                back = _turned(R[k + 1 if self.back_by == "next" else k], self.back)
                f, t = self._handed_down(f, t, back, _place(own, k + 1, self.arm_at))
                if self.lever_of_all:
                    t = t + cross(own.com[..., k, :], f)
            f, t = forces[k] + self.force * f, torques[k] + t
            felt = t
            if self.about_before:
                _, felt = self._handed_down(f, t, R[k], _place(own, k, self.arm_at))
            u[..., k] += self._given(own.axis[..., k, :], felt)
        return u

    def _from_joint(self, omega, alpha, r) -> np.ndarray:
        """What the turning adds to the acceleration of a joint at r on the link."""
        towards = _inwards(omega, r, self.joint_inwards)
        return self.joint_along * cross(alpha, r) + self.joint_centre * towards

    def _handed_down(self, f, t, back, r) -> tuple[np.ndarray, np.ndarray]:
        """The force, and the moment about the joint of the link before, from which the next is at r."""
        early = cross(r, f)
        f, t = self._handed("f", back, f), self._handed("t", back, t)
        moment = np.matvec(back, early) if self.own_axes_in else cross(r, f)
        return f, self.torque * t + self.arm * moment

    def _given(self, axis, t) -> np.ndarray:
        """The motor's part of the moment."""
        if self.part == "third":
            return t[..., 2]
        return np.vecdot(axis, t) if self.part == "axis" else np.linalg.norm(t, axis=-1)

    def for_calls(self, calls: list[Call]) -> list[np.ndarray]:
        """What it returns for each call, all at once: behind a short chain hang links without mass."""
        lengths = [len(call.args[0]) for call in calls]
        *states, chains = zip(*(call.args for call in calls), strict=True)
        n, of_links = max(lengths), [name for name in vars(chains[0]) if name != "gravity"]
        together = {name: _filled([vars(c)[name] for c in chains], n) for name in of_links}
        together["gravity"] = np.array([chain.gravity for chain in chains], dtype=float)
        q, qd, qdd = (_filled(part, n) for part in states)
        values = self(q, qd, qdd, SimpleNamespace(**together))
        return [value[:own] for value, own in zip(values, lengths, strict=True)]

    def _handed(self, name: str, turn, v) -> np.ndarray:
        if name == self.unturned:
            return v
        return np.matvec(_transposed(turn) if name == self.backward else turn, v)

    def _own(self, chain, R) -> SimpleNamespace:
        """The chain, or with one entry as it is where its axes are taken for the base's."""
        own = SimpleNamespace(**vars(chain))
        if not self.in_base:
            return own
        turned = [np.eye(3) + 0 * R[0]]  # from each link's axes to the base's
        for each in R:
            turned.append(turned[-1] @ each)
        values = getattr(chain, self.in_base)
        # The offset of a joint is in the axes of the link before.
        frames = np.stack(turned[:-1] if self.in_base == "offset" else turned[1:], axis=-3)
        back = _transposed(frames)
        turned_back = back @ values @ frames if self.in_base == "I" else np.matvec(back, values)
        setattr(own, self.in_base, turned_back)
        return own


def _transposed(R) -> np.ndarray:
    return np.swapaxes(R, -1, -2)


def _turned(R, way: int) -> np.ndarray:
    return R if way == 1 else _transposed(R) if way == -1 else np.eye(3)


def _filled(values, n: int) -> np.ndarray:
    """Those of several chains, each with zeros up to n joints."""
    found = np.zeros((len(values), n, *np.shape(values[0])[1:]))
    for place, value in enumerate(values):
        found[place, : len(value)] = value
    return found


def _inwards(omega, r, form: str) -> np.ndarray:
    """The acceleration towards the axis, in the form that `Sweeps` names."""
    if form == "plane":
        return -np.vecdot(omega, omega)[..., np.newaxis] * r
    once = cross(omega, r)
    return once if form == "once" else cross(omega, once)


def _of_point(c) -> np.ndarray:
    """The inertia of a unit mass at c, (..., 3, 3)."""
    size = np.vecdot(c, c)[..., np.newaxis, np.newaxis]
    return size * np.eye(3) - c[..., :, np.newaxis] * c[..., np.newaxis, :]


def _place(chain, k: int, at: str) -> np.ndarray:
    """The joint k in the axes of the link before, or what is taken for that place."""
    if k == 0:  # nothing turns before the first joint
        return chain.offset[..., 0, :]
    places = chain.com if at == "com" else chain.offset
    return places[..., k if at == "offset" else k - 1, :]


RIGHT = Sweeps()


def changed(chain, **entries) -> SimpleNamespace:
    """The chain with other entries."""
    return SimpleNamespace(**vars(chain) | entries)
