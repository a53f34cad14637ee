"""Derives a spatial chain by recursion from link to link, without a derivative.

With J̇ the rate of a point's Jacobian in the base's frame, M = ∫ JᵀJ dm and C = ∫ JᵀJ̇ dm, which is the
Christoffel C. Both integrals are taken over all points from a joint outwards at once: M from the
second moments Σ, first moments h and mass m of those points, and C from the moments of their
velocities ẋ besides, Q = ∫ x ẋᵀ dm and p = ∫ ẋ dm. These are carried inwards from link to link.

Sources: M. W. Walker, D. E. Orin (1982), Efficient dynamic computer simulation of robotic mechanisms,
for M; J. Y. S. Luh, M. W. Walker, R. P. C. Paul (1980), On-Line Computational Scheme for Mechanical
Manipulators, for C q̇ + g; S. Echeandia, P. M. Wensing (2021), Numerical Methods to Compute the
Coriolis Matrix and Christoffel Symbols for Rigid-Body Systems, for C by the same recursion.
"""

import numpy as np
import sympy as sp

from armdyn.derive.derivation import Derivation
from armdyn.derive.frames import frames
from armdyn.derive.recursion import Recursion
from armdyn.derive.terms import Terms
from armdyn.parameters import nonnegative

LARGEST_TOLERANCE = 0.01
INERTIAL = ("m", "mcx", "mcy", "mcz", "Jxx", "Jxy", "Jyy", "Jxz", "Jyz", "Jzz")


def serial_chain(chain, inertial_symbols: bool = False, tolerance: float = 1e-9) -> Derivation:
    """M, C (Christoffel), g, P and the friction of an `armdyn.SerialChain`, in q1…qn and qd1…qdn.

    The chain's numbers are numbers in the expressions. With `inertial_symbols`, the masses are symbols,
    so that a payload changes without another derivation: for link 1 m1, mcx1, mcy1, mcz1, Jxx1, Jxy1,
    Jyy1, Jxz1, Jyz1, Jzz1, in the order and meaning of `armdyn.regressor.parameters(chain)`.

    What is at most `tolerance` times the largest of its kind is taken for 0, and the cosine of an angle
    as near to 1 for 1: entries of rotations, distances beside the longest one (the first joint's place
    does not count), and moments of a link beside its others. 1e-9 clears what a file with ten digits
    leaves of a right angle; a file that writes 1.5708 needs 1e-5.

    The expressions share their parts. The code that `armdyn.codegen` makes of them is short; written
    out, they are a thousand times as long. So for six joints or more do not print or simplify them,
    or ask for their `free_symbols`. `bias` is C q̇ + g by the recursion of Newton and Euler.

    Raises ValueError, naming the argument, for a tolerance that is not a number from 0 to 0.01.
    """
    tolerance = nonnegative("tolerance", tolerance, "1")
    if tolerance > LARGEST_TOLERANCE:
        raise ValueError(f"tolerance = {tolerance}: needs a number from 0 to {LARGEST_TOLERANCE}")
    n = len(chain.links)
    q, qd = (sp.symbols(f"{name}1:{n + 1}", real=True) for name in ("q", "qd"))
    terms = Terms()
    if inertial_symbols:
        names = [f"{name}{k}" for k in range(1, n + 1) for name in INERTIAL]
        parameters = sp.symbols(names, real=True)
        # Of all links' parameters, in each link's J its own ten.
        masses = [_masses_of(np.eye(10, 10 * n, 10 * k)) for k in range(n)]
    else:
        parameters = []
        masses = [_masses(link)[..., np.newaxis] for link in chain.links]
    basis = [terms(symbol) for symbol in parameters] or [terms(1)]
    arm = Recursion(terms, basis, frames(chain.links, chain.gravity, masses, tolerance), q, qd)
    M = arm.inertia()
    for k, motor in enumerate(chain.armature):
        M[k][k] = M[k][k] + motor
    derived = Derivation(
        q,
        qd,
        tuple(parameters),
        _matrix(M),
        _matrix(arm.coriolis()),
        _matrix([arm.gravity_vector()]).T,
        arm.potential_energy().expression,
        bias=_matrix([arm.bias()]).T,
    )
    friction = [sp.Float(d) for d in chain.viscous], [sp.Float(k) for k in chain.coulomb]
    return derived.with_friction(*friction) if any(map(any, friction)) else derived


def _masses(link) -> np.ndarray:
    """∫ x xᵀ dm of the points x = [r; 1] of a link, (4, 4), in its own frame."""
    com, inertia = np.array(link.com), np.array(link.inertia)
    J = np.empty((4, 4))
    J[:3, :3] = np.trace(inertia) / 2 * np.eye(3) - inertia + link.mass * np.outer(com, com)
    J[:3, 3] = J[3, :3] = link.mass * com
    J[3, 3] = link.mass
    return J


def _masses_of(parameters) -> np.ndarray:
    """The same of m, m c and the inertia about the frame's origin, in the order of INERTIAL; (10, p)
    gives (4, 4, p)."""
    m, x, y, z, xx, xy, yy, xz, yz, zz = parameters
    half = 0.5 * (xx + yy + zz)
    return np.array(
        [
            [half - xx, -xy, -xz, x],
            [-xy, half - yy, -yz, y],
            [-xz, -yz, half - zz, z],
            [x, y, z, m],
        ]
    )


def _matrix(rows) -> sp.ImmutableMatrix:
    return sp.ImmutableMatrix([[term.expression for term in row] for row in rows])
