"""Random arms, and what it is for the numbers of two programs to agree.

Two programs add the same terms in another order. What that rounds is a part of the terms' sizes, not
of their sum, which may be a small difference of large ones. So each entry is held to 1e-12 of the
sum of the sizes of its terms, and q̈ to what such errors of M q̈ + C q̇ + g + f = u bring about in it.
"""

import numpy as np
import sympy as sp

from armdyn import Planar2R
from armdyn.derive import planar_chain
from armdyn.ports import Terms
from armdyn.ports.calls import by_hand

TOLERANCE = 1e-12
PLANAR_2R, PLANAR_3R, RUBBING_2R = planar_chain(2), planar_chain(3, offsets=True), by_hand()
RANGES = {
    "l": (0.1, 2),
    "lc": (-1, 2),
    "ly": (-1, 1),
    "m": (0.1, 10),
    "I": (0.01, 2),
    "g": (0, 20),
    "viscous": (0, 3),
    "coulomb": (0, 3),
}


def random_values(rng, derivation) -> dict[str, float]:
    """A number for each parameter of a planar chain, in SI units."""
    names = [symbol.name for symbol in derivation.parameters]
    return {name: rng.uniform(*RANGES[name.rstrip("123")]) for name in names}


def random_arm(rng, friction: bool) -> Planar2R:
    viscous, coulomb = friction * rng.uniform(0, 3, (2, 2))
    return Planar2R(**random_values(rng, PLANAR_2R), viscous=tuple(viscous), coulomb=tuple(coulomb))


def random_states(rng, rows: int, n: int):
    """States (rows, 2n) and inputs (rows, n); in some a joint is at rest."""
    states, u = rng.uniform(-6, 6, (rows, 2 * n)), rng.uniform(-20, 20, (rows, n))
    states[: rows // 20, n] = 0
    return states, u


def closed_form(arms, states, u) -> Terms:
    """The terms by Planar2R, arm by arm."""
    rows = []
    for arm, x, ui in zip(arms, states, u, strict=True):
        q, qd = x[:2], x[2:]
        parts = arm.M(q), arm.C(q, qd), arm.g_vec(q), arm.f_vec(qd), arm.potential_energy(q)
        rows.append((*parts, arm.dynamics(q, qd, ui)))
    return Terms(*map(np.array, zip(*rows, strict=True)))


class Evaluated:
    """A derivation's M, C, g, f, P in NumPy at rows of parameters and states; their terms' sizes."""

    def __init__(self, derivation):
        d = self.derivation = derivation
        symbols = (*d.parameters, *d.q, *d.qd)
        entries = [*d.M, *d.C, *d.g_vec, *d.f_vec, d.P]
        self._entries = sp.lambdify(symbols, entries, "numpy", cse=True)
        self._sizes = sp.lambdify(symbols, [_size(entry) for entry in entries], "numpy", cse=True)

    def terms(self, values, states, u) -> Terms:
        M, C, g, f, P = self._split(self._entries, values, states)
        qd = states[:, self.derivation.n :]
        qdd = np.linalg.solve(M, (u - np.einsum("kij,kj->ki", C, qd) - g - f)[..., np.newaxis])
        return Terms(M, C, g, f, P, qdd[..., 0])

    def sizes(self, values, states):
        """(M, C, g, f, P), each entry the sum of the sizes of its terms."""
        return self._split(self._sizes, values, np.abs(states))

    def _split(self, function, values, states):
        n, names = self.derivation.n, [s.name for s in self.derivation.parameters]
        columns = [np.array([v[name] for v in values]) for name in names]
        found = np.stack(
            [np.broadcast_to(e, len(states)) for e in function(*columns, *states.T)], axis=-1
        )
        M, C, g, f, P = np.split(found, np.cumsum([n * n, n * n, n, n]), axis=-1)
        return M.reshape(-1, n, n), C.reshape(-1, n, n), g, f, P[:, 0]


def _size(entry):
    """The sum of the sizes of the entry's terms, as they are nested; 1 for a function's value."""
    if entry.is_Function:
        return sp.S.One
    if entry.is_Pow:
        return _size(entry.base) ** entry.exp
    return entry.func(*map(_size, entry.args)) if entry.args else sp.Abs(entry)


def assert_agreement(found: Terms, right: Terms, sizes, states, u):
    M, C, g, f, P = sizes
    qd = np.abs(states[:, g.shape[-1] :])
    torques = np.einsum("kij,kj->ki", M, np.abs(right.qdd)) + np.einsum("kij,kj->ki", C, qd)
    torques += g + f + np.abs(u)
    qdd = np.einsum("kij,kj->ki", np.abs(np.linalg.inv(right.M)), torques)
    bounds = {"M": M, "C": C, "g_vec": g, "f_vec": f, "potential_energy": P, "qdd": qdd}
    for name, size in bounds.items():
        error = np.abs(getattr(found, name) - getattr(right, name))
        assert error.shape == size.shape, name
        assert np.all(error <= TOLERANCE * size), name
