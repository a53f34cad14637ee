"""Derives the equation of motion from links and joints: M = Σ JᵀIJ in symbols."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import sympy as sp

from armdyn.derive.derivation import Derivation, from_inertia, parameters_of
from armdyn.derive.names import refuse_shared, refuse_taken

JOINTS = ("revolute", "prismatic")


@dataclass(frozen=True)
class Link:
    """A rigid link and the joint that moves it, in symbols or numbers.

    The joint's frame lies in the frame of the link before it (or the base) at `position`, turned by
    `rotation`; the joint turns about, or slides along, `axis` in that frame. The link's own frame is
    the joint's, moved by q. `com` and `inertia` (about the centre of mass) are in the link's frame.
    Vectors may be given as tuples; they are kept as (3, 1) matrices.
    Raises ValueError, naming the argument, for another joint or shape, an inertia that is not
    symmetric, or a numeric axis that is not of length 1.
    """

    joint: str = field(metadata={"doc": "'revolute' or 'prismatic'"})
    mass: sp.Expr = field(metadata={"unit": "kg"})
    axis: sp.Matrix = (0, 0, 1)
    position: sp.Matrix = field(default=(0, 0, 0), metadata={"unit": "m"})
    rotation: sp.Matrix = field(default=None, metadata={"doc": "(3, 3), identity where not given"})
    com: sp.Matrix = field(default=(0, 0, 0), metadata={"unit": "m"})
    inertia: sp.Matrix = field(default=None, metadata={"unit": "kg·m²", "doc": "(3, 3), or zero"})

    def __post_init__(self):
        if self.joint not in JOINTS:
            raise ValueError(f"joint = {self.joint!r}: needs one of {', '.join(JOINTS)}")
        try:
            mass = sp.sympify(self.mass)
        except sp.SympifyError:
            mass = None
        if not isinstance(mass, sp.Expr) or mass.is_Matrix:
            raise ValueError(f"mass = {self.mass!r}: needs one number or SymPy expression, in kg")
        object.__setattr__(self, "mass", mass)
        for name in ("axis", "position", "com"):
            object.__setattr__(self, name, _matrix(name, getattr(self, name), (3, 1)))
        for name, default in (("rotation", sp.eye(3)), ("inertia", sp.zeros(3, 3))):
            given = getattr(self, name)
            matrix = _matrix(name, default if given is None else given, (3, 3))
            object.__setattr__(self, name, matrix)
        if self.inertia != self.inertia.T:
            raise ValueError(f"inertia = {self.inertia}: needs a symmetric (3, 3) matrix")
        length = self.axis.dot(self.axis)
        if not self.axis.free_symbols and abs(length - 1) > 1e-12:
            raise ValueError(f"axis = {tuple(self.axis)}: needs a vector of length 1")


def from_links(
    links: Sequence[Link],
    gravity: Sequence[sp.Expr] | None = None,
    q: Sequence[sp.Symbol] | None = None,
    qd: Sequence[sp.Symbol] | None = None,
) -> Derivation:
    """M = Σ JᵀIJ, C (Christoffel) and g = ∂P/∂q of a chain of links, each on the one before it.

    links: a sequence of `Link`. gravity: the gravitational acceleration in the base frame, (3,),
    m/s²; (0, 0, −g) with the symbol g where not given. P = −Σ m gravityᵀ p. q, qd: the symbols to
    use, q1…qn and qd1…qdn where not given.
    For a robot whose links are numbers, `serial_chain` is a thousand times faster: this is for lengths
    and masses in symbols, and short chains.
    Raises ValueError for no links, what is not a Link, or another number of symbols; and, naming the
    symbol, for two symbols of one name, or one of a link with the name of a coordinate or of gravity.

    Source: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to Robotic
    Manipulation, chapter 4.
    """
    links = list(links)
    if not links or not all(isinstance(link, Link) for link in links):
        raise ValueError(f"links = {links!r}: needs one or more Link")
    n = len(links)
    q = _symbols("q", q, n)
    qd = _symbols("qd", qd, n)
    down = sp.Matrix([0, 0, -sp.Symbol("g", real=True)]) if gravity is None else gravity
    down = _matrix("gravity", down, (3, 1))
    _refuse_names(links, gravity, down, q, qd)

    M, P = sp.zeros(n, n), sp.S.Zero
    height = sp.zeros(3, 1)  # of the link's origin, in the base frame
    R = sp.eye(3)
    spin, drift = sp.zeros(3, n), sp.zeros(3, n)  # ω and v of the link's origin, in its own frame
    for k, link in enumerate(links):
        turn = _turn(link.axis, q[k]) if link.joint == "revolute" else sp.eye(3)
        slide = link.axis * q[k] if link.joint == "prismatic" else sp.zeros(3, 1)
        step = link.position + link.rotation * slide
        height += R * step
        into = (link.rotation * turn).T
        drift = into * (drift + _crossed(spin, step))
        spin = into * spin
        R = R * into.T
        at_k = sp.zeros(1, n)
        at_k[k] = 1
        if link.joint == "revolute":
            spin += link.axis * at_k
        else:
            drift += link.axis * at_k
        velocity = drift + _crossed(spin, link.com)
        M += link.mass * velocity.T * velocity + spin.T * link.inertia * spin
        P -= link.mass * down.dot(height + R * link.com)
    described = [part for link in links for part in _described(link).values()]
    return from_inertia(M, P, q, qd, parameters_of((*described, down), q, qd))


def _described(link) -> dict:
    names = ("axis", "position", "rotation", "com", "inertia")
    return {"mass": link.mass, **{name: getattr(link, name) for name in names}}


def _refuse_names(links, gravity, down, q, qd):
    """ValueError where a link's symbol has the name of a coordinate, a velocity or gravity."""
    given = {
        s.name: f"a {role}" for role, s_s in (("coordinate", q), ("velocity", qd)) for s in s_s
    }
    if gravity is None:
        given["g"] = "the gravitational acceleration"
    instead = "give other symbols as q and qd, or an expression as gravity"
    used = [*q, *qd, *down.free_symbols]
    for k, link in enumerate(links):
        for name, part in _described(link).items():
            refuse_taken(given, part.free_symbols, f"links[{k}].{name}", instead)
            used += part.free_symbols
    refuse_taken(
        {name: role for name, role in given.items() if name != "g"},
        down.free_symbols,
        "gravity",
        instead,
    )
    refuse_shared(used, "links, gravity, q and qd")


def _turn(axis, angle):
    """Rodrigues: the rotation by an angle about a unit axis."""
    x, y, z = axis
    cross = sp.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    c, s = sp.cos(angle), sp.sin(angle)
    return c * sp.eye(3) + s * cross + (1 - c) * axis * axis.T


def _crossed(columns, arm):
    """ω × arm for each column ω."""
    crossed = [columns[:, i].cross(arm) for i in range(columns.cols)]
    return sp.Matrix.hstack(*crossed)


def _matrix(name, value, shape):
    try:
        matrix = sp.ImmutableMatrix(value)
    except (TypeError, ValueError):
        matrix = None
    if matrix is None or matrix.shape != shape:
        wanted = "(3,)" if shape == (3, 1) else "(3, 3)"
        raise ValueError(f"{name} = {value!r}: needs shape {wanted}")
    return matrix


def _symbols(name, given, n):
    symbols = sp.symbols(f"{name}1:{n + 1}", real=True) if given is None else tuple(given)
    if len(symbols) != n or not all(isinstance(s, sp.Symbol) for s in symbols):
        raise ValueError(f"{name} = {given!r}: needs {n} SymPy symbols, one per link")
    return symbols
