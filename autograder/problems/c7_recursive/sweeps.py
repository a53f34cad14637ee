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

    projected: onto the joint's axis, or else the third component. out, back: whether vectors are turned
    into the next link's axes and back; −1 turns them the wrong way. in_base: the entry of the chain that
    is used as if its axes were the base's. joint_at, arm_at: what is taken for the next joint's place,
    outwards and inwards: "offset", "com", or "before", which is the joint before it. unturned: the one
    vector that is handed on as it is: "omega", "alpha", "a", "f" or "t".
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
    projected: bool = True
    out: int = 1
    back: int = 1
    in_base: str = ""
    joint_at: str = "offset"
    arm_at: str = "offset"
    unturned: str = ""

    def __call__(self, q, qd, qdd, chain) -> np.ndarray:
        """Of one chain, or with a leading axis of as many as there are."""
        n = q.shape[-1]
        R = [rotation(chain.axis[..., k, :], q[..., k]) for k in range(n)]
        own = self._own(chain, R)
        a, down = -self.gravity * chain.gravity, chain.gravity
        omega, alpha = np.zeros_like(a), np.zeros_like(a)
        forces, torques = [], []
        for k in range(n):
            # Of the joint, still in the axes of the link before.
            r, out = _place(own, k, self.joint_at), _turned(_transposed(R[k]), self.out)
            a = a + self.joint_along * cross(alpha, r) + self.joint_centre * _inwards(omega, r)
            omega, alpha = self._handed("omega", out, omega), self._handed("alpha", out, alpha)
            a, down = self._handed("a", out, a), np.matvec(out, down)
            axis, c, m = own.axis[..., k, :], own.com[..., k, :], chain.m[..., k, np.newaxis]
            joint = axis * qd[..., k, np.newaxis]
            alpha = self.turn * alpha + self.twist * cross(omega, joint)
            alpha = alpha + self.own_turn * axis * qdd[..., k, np.newaxis]
            omega = self.spin * omega + joint
            of_centre = a + self.along * cross(alpha, c) + self.centre * _inwards(omega, c)
            F = m * of_centre - self.weight * m * down
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
                back = _turned(R[k + 1], self.back)
                f, t = self._handed("f", back, f), self._handed("t", back, t)
                r = _place(own, k + 1, self.arm_at)
                t = self.torque * t + self.arm * cross(r, f)
            f, t = forces[k] + self.force * f, torques[k] + t
            u[..., k] += np.vecdot(own.axis[..., k, :], t) if self.projected else t[..., 2]
        return u

    def for_calls(self, calls: list[Call]) -> list[np.ndarray]:
        """What it returns for each call: those with chains of one length at once."""
        found: list = [None] * len(calls)
        lengths = [len(call.args[0]) for call in calls]
        for n in set(lengths):
            places = [place for place, length in enumerate(lengths) if length == n]
            *states, chains = zip(*(calls[place].args for place in places), strict=True)
            names = vars(chains[0])
            together = {name: np.stack([getattr(c, name) for c in chains]) for name in names}
            q, qd, qdd = map(np.stack, states)
            values = self(q, qd, qdd, SimpleNamespace(**together))
            for place, value in zip(places, values, strict=True):
                found[place] = value
        return found

    def _handed(self, name: str, turn, v) -> np.ndarray:
        return v if name == self.unturned else np.matvec(turn, v)

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


def _inwards(omega, r) -> np.ndarray:
    return cross(omega, cross(omega, r))


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


def rnea(q, qd, qdd, chain) -> np.ndarray:
    """The torques, (n,), N·m: the right answer."""
    return RIGHT(q, qd, qdd, chain)


def changed(chain, **entries) -> SimpleNamespace:
    """The chain with other entries."""
    return SimpleNamespace(**vars(chain) | entries)


@dataclass(frozen=True)
class AlwaysDown(Sweeps):
    """Gravity of Earth along −z, also where there is none."""

    def __call__(self, q, qd, qdd, chain):
        down = np.full_like(chain.gravity, [0.0, 0.0, -9.81])
        return super().__call__(q, qd, qdd, changed(chain, gravity=down))


@dataclass(frozen=True)
class FirstLeftOut(Sweeps):
    """Nothing at the first joint."""

    def __call__(self, q, qd, qdd, chain):
        u = super().__call__(q, qd, qdd, chain)
        u[..., 0] = 0.0
        return u


@dataclass(frozen=True)
class LastLeftOut(Sweeps):
    """Nothing of the last link."""

    def __call__(self, q, qd, qdd, chain):
        left = {name: np.array(getattr(chain, name)) for name in ("m", "I", "viscous")}
        left["m"][..., -1] = left["viscous"][..., -1] = 0.0
        left["I"][..., -1, :, :] = 0.0
        return super().__call__(q, qd, qdd, changed(chain, **left))


@dataclass(frozen=True)
class Reversed(Sweeps):
    """The torques from the tip to the base."""

    def __call__(self, q, qd, qdd, chain):
        return super().__call__(q, qd, qdd, chain)[..., ::-1]


def random_chain(rng: np.random.Generator, n: int, gravity: bool) -> SimpleNamespace:
    """A chain of n links whose joints point anywhere, with inertias that a body can have."""
    down = -rng.uniform(4.0, 12.0) * _direction(rng) if gravity else np.zeros(3)
    com = np.array([rng.uniform(0.15, 0.4) * _direction(rng) for _ in range(n)])
    m = rng.uniform(1.0, 3.0, n)
    return SimpleNamespace(
        axis=np.array([_direction(rng) for _ in range(n)]),
        offset=np.array([rng.uniform(0.3, 0.7) * _direction(rng) for _ in range(n)]),
        m=m,
        com=com,
        I=np.array([_inertia(rng, mass * (c @ c)) for mass, c in zip(m, com, strict=True)]),
        viscous=rng.uniform(0.2, 1.0, n),
        gravity=down,
    )


def _direction(rng) -> np.ndarray:
    """A unit vector of which no component is small."""
    while True:
        v = rng.normal(size=3)
        v /= np.linalg.norm(v)
        if np.min(np.abs(v)) > 0.2:
            return v


def _inertia(rng, size: float) -> np.ndarray:
    """About the centre of mass: three different principal moments, none above the sum of the others."""
    spread = size * rng.permutation([0.3, 0.7, 1.2]) * rng.uniform(0.8, 1.2, 3)
    moments = np.sum(spread) - spread
    turn = rotation(_direction(rng), rng.uniform(0.5, 2.5))
    I = turn @ np.diag(moments) @ turn.T
    return (I + I.T) / 2
