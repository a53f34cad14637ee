"""Vectors of three terms, and how a joint carries them from link to link.

Everything of a link is in the link's own frame of `derive.frames`: z is the joint's axis. A symmetric
second moment is a dictionary of its upper triangle.
"""

import numpy as np
import sympy as sp

from armdyn.derive.frames import Joint
from armdyn.derive.terms import Term, Terms

UPPER = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


class MovingLink:
    """A link's own masses, and vectors carried to it and back over its joint.

    basis: the inertial parameters, whose coefficients the joint has.
    """

    def __init__(self, terms: Terms, basis: list[Term], joint: Joint, q: sp.Symbol, qd: sp.Symbol):
        self.terms, self.revolute, self.qd = terms, joint.revolute, terms(qd)
        self.about_x = terms(joint.cos), terms(joint.sin)
        c, s = terms(np.cos(joint.offset)), terms(np.sin(joint.offset))
        if joint.revolute:
            angle = sp.Add(q, sp.Float(joint.offset)) if joint.offset else q
            c, s = terms(sp.cos(angle)), terms(sp.sin(angle))
        for _ in range(joint.quarters % 4):
            c, s = -s, c
        self.about_z = c, s
        self.position = [terms(x) for x in joint.position]
        if not joint.revolute:
            along = (0.0, -joint.sin, joint.cos)
            self.position = [x + a * terms(q) for x, a in zip(self.position, along, strict=True)]
        self.second = {at: dot(terms, joint.J[at], basis) for at in UPPER}
        self.first = [dot(terms, joint.J[i, 3], basis) for i in range(3)]
        self.mass = dot(terms, joint.J[3, 3], basis)

    def outwards(self, v):
        """A vector from the coordinates of the link before to this link's."""
        x, y, z = v
        c, s = self.about_x
        y, z = _turned(c, -s, y, z)
        c, s = self.about_z
        return [*_turned(c, -s, x, y), z]

    def inwards(self, v):
        """A vector from this link's coordinates to those of the link before."""
        x, y, z = v
        x, y = _turned(*self.about_z, x, y)
        return [x, *_turned(*self.about_x, y, z)]

    def second_inwards(self, S):
        """R S Rᵀ of a symmetric S."""
        xx, xy, yy = _turned_square(*self.about_z, S[0, 0], S[0, 1], S[1, 1])
        xz, yz = _turned(*self.about_z, S[0, 2], S[1, 2])
        yy, yz, zz = _turned_square(*self.about_x, yy, yz, S[2, 2])
        xy, xz = _turned(*self.about_x, xy, xz)
        return dict(zip(UPPER, (xx, xy, xz, yy, yz, zz), strict=True))

    def axis_part(self, angular, linear):
        """The joint's share of a velocity or a force: along z."""
        return angular[2] if self.revolute else linear[2]


def _turned(c, s, x, y):
    return c * x - s * y, s * x + c * y


def _turned_square(c, s, a, b, d):
    """[[a, b], [b, d]] turned, as (a, b, d)."""
    if s.is_zero or c.is_zero:
        return (a, b, d) if s.is_zero else (d, -b, a)
    u, w = c * a - s * b, c * b - s * d
    first = c * u - s * w
    return first, s * u + c * w, a + d - first


def plus(a, b):
    """a + b."""
    return [x + y for x, y in zip(a, b, strict=True)]


def cross(a, b):
    """a × b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(terms, a, b):
    """aᵀ b as one sum."""
    return terms.sum([terms(x) * y for x, y in zip(a, b, strict=True)])
