"""What u costs a planar arm: by the sum over all later links for each joint, and by two sweeps.

The functions are those of the notebook. They count whatever is added or multiplied in them.
"""

from dataclasses import dataclass
from types import SimpleNamespace


def outwards(c, s, w, a, arm):
    """For each link the place of its joint, its force and its moment."""
    px, py, ax, ay = 0.0, 0.0, 0.0, arm.g
    links = []
    for k in range(len(c)):
        bx = 0.0 - a[k] * s[k] - w[k] * w[k] * c[k]
        by = a[k] * c[k] - w[k] * w[k] * s[k]
        Fx, Fy = arm.m[k] * (ax + arm.lc[k] * bx), arm.m[k] * (ay + arm.lc[k] * by)
        links.append((px, py, Fx, Fy, arm.I[k] * a[k]))
        px, py = px + arm.l[k] * c[k], py + arm.l[k] * s[k]
        ax, ay = ax + arm.l[k] * bx, ay + arm.l[k] * by
    return links


def direct(c, s, w, a, arm):
    """u of every joint as a sum over all links that it carries."""
    links = outwards(c, s, w, a, arm)
    u = []
    for k in range(len(c)):
        total = 0.0
        for j in range(k, len(c)):
            x = links[j][0] + arm.lc[j] * c[j] - links[k][0]
            y = links[j][1] + arm.lc[j] * s[j] - links[k][1]
            total = total + links[j][4] + (x * links[j][3] - y * links[j][2])
        u.append(total)
    return u


def sweeps(c, s, w, a, arm):
    """u of every joint from that of the next one."""
    links = outwards(c, s, w, a, arm)
    u = [0.0] * len(c)
    fx, fy, torque = 0.0, 0.0, 0.0
    for k in reversed(range(len(c))):
        _, _, Fx, Fy, moment = links[k]
        own = arm.lc[k] * (c[k] * Fy - s[k] * Fx)
        torque = torque + moment + own + arm.l[k] * (c[k] * fy - s[k] * fx)
        fx, fy = fx + Fx, fy + Fy
        u[k] = torque
    return u


@dataclass(frozen=True)
class Counted:
    """Stands for a number. counts: of what is done with any of them, by "+", "-" and "*"."""

    counts: dict

    def _done(self, kind: str):
        self.counts[kind] += 1
        return self

    def __add__(self, other):
        return self._done("+")

    def __sub__(self, other):
        return self._done("-")

    def __mul__(self, other):
        return self._done("*")

    __radd__, __rsub__, __rmul__ = __add__, __sub__, __mul__


def operations(algorithm, n: int, number: type[Counted] = Counted) -> dict:
    """How often the algorithm adds, subtracts and multiplies for n links, as such numbers count it."""
    counts = {"+": 0, "-": 0, "*": 0}
    x = number(counts)
    arm = SimpleNamespace(g=x, **{name: n * [x] for name in ("l", "lc", "m", "I")})
    algorithm(*4 * [n * [x]], arm)
    return counts


def count(n: int) -> tuple[int, int]:
    """Operations for n links, directly and by sweeps: the right answer."""
    return sum(operations(direct, n).values()), sum(operations(sweeps, n).values())
