"""Derives planar chains of n revolute links from sums over the links, without any derivative."""

import sympy as sp

from armdyn.derive.derivation import Derivation
from armdyn.derive.energies import from_energies


def planar_chain(n: int, offsets: bool = False) -> Derivation:
    """n revolute links in a vertical plane, x right, y up, gravity along −y; q_i is relative.

    Symbols: q1…qn, qd1…qdn; lengths l1…ln, distances lc1…lcn of the centres of mass along the link
    axes, with `offsets` ly1…lyn across them (to the left), masses m1…mn, inertias I1…In about the
    centres of mass, and g. P is zero where every centre of mass is as high as the base.
    Raises ValueError unless n is a positive integer.

    Written in absolute angles: with r_ki from joint i to the centre of mass of link k,
    M_ij = Σ_k (m_k r_ki·r_kj + I_k) and C_ij = Σ_k m_k r_ki·ṙ_kj, which is the Christoffel C. For
    the links from j outwards as one body, h_j = Σ_{k≥j} m_k r_kj and J_j its inertia about joint j;
    with d from joint i to joint j ≥ i,
    M_ij = J_j + d·h_j, C_ij = ½ J̇_j + d·ḣ_j, C_ji = ½ J̇_j + ḋ·h_j.
    M_ij so is the composite-rigid-body method of M. W. Walker, D. E. Orin (1982), Efficient dynamic
    computer simulation of robotic mechanisms.
    """
    if isinstance(n, bool) or not isinstance(n, int) or n < 1:
        raise ValueError(f"n = {n!r}: needs a positive integer, the number of links")
    q, qd, l, lc, m, I = (_numbered(name, n) for name in ("q", "qd", "l", "lc", "m", "I"))
    ly = _numbered("ly", n) if offsets else ()
    g = sp.Symbol("g", real=True)

    angle, turn = sp.S.Zero, sp.S.Zero
    along, along_rate, rates = [], [], []
    for i in range(n):
        angle, turn = angle + q[i], _sum(turn, qd[i])
        e = sp.cos(angle), sp.sin(angle)
        along.append(e)
        along_rate.append((-turn * e[1], turn * e[0]))
        rates.append(turn)

    # From the last link inwards: mass beyond joint j, first moment, its rate, inertia, ½ its rate.
    beyond = sp.S.Zero
    h: list[tuple] = [()] * n
    hd: list[tuple] = [()] * n
    J, Jd = [sp.S.Zero] * n, [sp.S.Zero] * n
    next_h: tuple = (sp.S.Zero, sp.S.Zero)
    next_hd: tuple = (sp.S.Zero, sp.S.Zero)
    next_J = next_Jd = sp.S.Zero
    for j in reversed(range(n)):
        e, ed = along[j], along_rate[j]
        moment = _sum(beyond * l[j], m[j] * lc[j])
        h_own, hd_own = _scaled(moment, e), _scaled(moment, ed)
        J_own = _sum(I[j], m[j] * lc[j] ** 2, beyond * l[j] ** 2)
        if offsets:
            # The normal (−s, c) is ė/ω; its own rate is −ω e.
            across = m[j] * ly[j]
            h_own = _sum(h_own[0], -across * e[1]), _sum(h_own[1], across * e[0])
            hd_own = (
                _sum(hd_own[0], -across * ed[1]),
                _sum(hd_own[1], across * ed[0]),
            )
            J_own = _sum(J_own, m[j] * ly[j] ** 2)
        if j < n - 1:
            J_own = _sum(J_own, 2 * l[j] * _dot(e, next_h))
            next_Jd = _sum(next_Jd, l[j] * _sum(_dot(e, next_hd), _dot(ed, next_h)))
        next_h = tuple(map(_sum, next_h, h_own))
        next_hd = tuple(map(_sum, next_hd, hd_own))
        next_J = _sum(next_J, J_own)
        beyond = _sum(beyond, m[j])
        h[j], hd[j], J[j], Jd[j] = next_h, next_hd, next_J, next_Jd

    M, C = sp.zeros(n, n), sp.zeros(n, n)
    for j in range(n):
        M[j, j], C[j, j] = J[j], Jd[j]
        d: tuple = (sp.S.Zero, sp.S.Zero)
        dd: tuple = (sp.S.Zero, sp.S.Zero)
        for i in reversed(range(j)):
            d = tuple(map(_sum, d, _scaled(l[i], along[i])))
            dd = tuple(map(_sum, dd, _scaled(l[i], along_rate[i])))
            M[i, j] = M[j, i] = _sum(J[j], _dot(d, h[j]))
            C[i, j] = _sum(Jd[j], _dot(d, hd[j]))
            C[j, i] = _sum(Jd[j], _dot(dd, h[j]))
    gravity = sp.ImmutableMatrix(n, 1, [g * h[j][0] for j in range(n)])
    P = g * h[0][1]
    parameters = (*l, *lc, *ly, *m, *I, g)
    return Derivation(q, qd, parameters, sp.ImmutableMatrix(M), sp.ImmutableMatrix(C), gravity, P)


def planar_2r() -> Derivation:
    """The 2R arm as textbooks write it, in cos q2 and sin q2, from its two energies.

    The symbols are those of planar_chain(2): the names of Planar2R's parameters.
    """
    q, qd, l, lc, m, I = (_numbered(name, 2) for name in ("q", "qd", "l", "lc", "m", "I"))
    g = sp.Symbol("g", real=True)
    (w1, w2), (l1, _) = (qd[0], qd[0] + qd[1]), l
    speed1 = lc[0] ** 2 * w1**2
    speed2 = l1**2 * w1**2 + lc[1] ** 2 * w2**2 + 2 * l1 * lc[1] * w1 * w2 * sp.cos(q[1])
    K = (m[0] * speed1 + m[1] * speed2 + I[0] * w1**2 + I[1] * w2**2) / 2
    P = g * (m[0] * lc[0] + m[1] * l1) * sp.sin(q[0]) + m[1] * g * lc[1] * sp.sin(q[0] + q[1])
    derived = from_energies(K.expand(), P, q, qd)
    return Derivation(q, qd, (*l, *lc, *m, *I, g), derived.M, derived.C, derived.g_vec, derived.P)


def _numbered(name, n):
    return sp.symbols(f"{name}1:{n + 1}", real=True)


def _sum(*terms):
    """Σ terms, kept as one node: SymPy would flatten a sum of sums, and what they share is lost."""
    kept = [term for term in terms if term != 0]
    return sp.Add(*kept, evaluate=False) if len(kept) > 1 else sum(kept, sp.S.Zero)


def _scaled(factor, vector):
    return tuple(factor * entry for entry in vector)


def _dot(a, b):
    return _sum(a[0] * b[0], a[1] * b[1])
