"""Derives two mechanisms that are no open chain of rigid links: elastic joints, and a slider-crank."""

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from armdyn.derive.derivation import Derivation, derivation_given, parameters_of
from armdyn.derive.energies import from_energies
from armdyn.derive.names import refuse_taken


def elastic_joints(
    rigid: Derivation,
    stiffness: Sequence[sp.Expr] | None = None,
    rotor_inertia: Sequence[sp.Expr] | None = None,
) -> Derivation:
    """The arm `rigid` with a torsional spring between each motor and its link: 2n coordinates.

    q: the link angles of `rigid`, then the motor angles theta1…thetan, seen behind the gears; their
    velocities are thetad1…thetadn. stiffness: n symbols or expressions, k1…kn where not given
    (N·m/rad). rotor_inertia: of each motor about its axis, times the square of the gear ratio, J1…Jn
    where not given (kg·m²). Motors push on the motor angles alone: u = (0, …, 0, u1, …, un).

        D(q) q̈ + C(q, q̇) q̇ + g(q) + f(q̇) + K (q − θ) = 0,
        J θ̈ − K (q − θ) = u,

    where a rotor's kinetic energy is that of its own spin alone (Spong's assumption, right for a
    large gear ratio). As K grows, this is the rigid arm with the inertia D + J.

    Give the rigid arm without armature: D is the inertia of the links, and J that of the motors. A
    derivation cannot know what its M is made of, so that motors in both D and J would count twice:
    of a SerialChain, take `replace(chain, armature=None).derivation()` and give its armature as
    rotor_inertia.

    Raises ValueError, naming the argument, for a `rigid` that is no Derivation, for another number of
    entries, for one that depends on q or q̇, and for a symbol of `rigid` with the name of a motor angle.

    Source: M. W. Spong (1987), Modeling and Control of Elastic Joint Robots, Journal of Dynamic
    Systems, Measurement, and Control 109(4).

    >>> from armdyn import derive
    >>> arm = derive.elastic_joints(derive.planar_chain(1))
    >>> [equation.lhs for equation in arm.equations((0, 0), (0, 0))][1]
    -k1*(q1 - theta1)
    """
    n = derivation_given("rigid", rigid).n
    theta, thetad = (sp.symbols(f"{name}1:{n + 1}", real=True) for name in ("theta", "thetad"))
    known = {*rigid.q, *rigid.qd, *rigid.parameters}
    given = {s.name: "a motor angle or its velocity" for s in (*theta, *thetad)}
    instead = "derive the rigid arm with another name"
    refuse_taken(given, known, "rigid", instead)
    parts = {}
    for name, value, letter in (
        ("stiffness", stiffness, "k"),
        ("rotor_inertia", rotor_inertia, "J"),
    ):
        entries = sp.symbols(f"{letter}1:{n + 1}", real=True) if value is None else value
        parts[name] = _constants(name, entries, rigid)
        if value is None:
            ours = {s.name: f"an entry of {name}" for s in entries}
            refuse_taken(ours, known, "rigid", f"give {name}")
        for i, entry in enumerate(parts[name]):
            refuse_taken(given, entry.free_symbols, f"{name}[{i}]", "give another symbol")
    k, J = parts.values()
    new = parameters_of((*k, *J), rigid.q, rigid.qd)
    pull = sp.Matrix([a * (q - motor) for a, q, motor in zip(k, rigid.q, theta, strict=True)])
    stored = [a * (q - motor) ** 2 / 2 for a, q, motor in zip(k, rigid.q, theta, strict=True)]
    return Derivation(
        q=(*rigid.q, *theta),
        qd=(*rigid.qd, *thetad),
        parameters=(*rigid.parameters, *(s for s in new if s not in known)),
        M=sp.diag(rigid.M, *J).as_immutable(),
        C=sp.diag(rigid.C, sp.zeros(n, n)).as_immutable(),
        g_vec=sp.Matrix([*(rigid.g_vec + pull), *(-pull)]).as_immutable(),
        P=rigid.P + sum(stored),
        f_vec=sp.Matrix([*rigid.f_vec, *[0] * n]).as_immutable(),
    )


def _constants(name, value, rigid) -> list[sp.Expr]:
    """n expressions that hold no coordinate; ValueError, naming the entry, for anything else."""
    try:
        entries = [sp.sympify(entry) for entry in value]
    except (TypeError, sp.SympifyError):
        raise ValueError(f"{name} = {value!r}: needs {rigid.n} symbols or expressions") from None
    if len(entries) != rigid.n:
        raise ValueError(f"{name}: got {len(entries)} entries, needs {rigid.n}, one per joint")
    for i, entry in enumerate(entries):
        if not isinstance(entry, sp.Expr) or entry.is_Matrix:
            raise ValueError(f"{name}[{i}] = {entry}: needs a symbol or an expression")
        if moving := entry.free_symbols & {*rigid.q, *rigid.qd}:
            raise ValueError(
                f"{name}[{i}] = {entry}: depends on {min(moving, key=str)}; needs a constant"
            )
    return entries


def slider_crank() -> Derivation:
    """A crank that drives a slider by a rod, in a vertical plane: one joint, and yet C is not 0.

    q1: the crank's angle from the line of the slider, which is the x axis through the crank's joint;
    y is up. Symbols: lengths l1 of the crank and l2 of the rod, distances lc1 and lc2 of their centres
    of mass, from the crank's joint and from the crank pin; masses m1, m2 and m3 of crank, rod and
    slider; inertias I1 and I2 about the centres of mass; and g. With l1 < l2 it turns all round. With
    l1 > l2 the rod does not reach the slider's line at every q1: numbers are NaN there, with NumPy's
    warning.

    M depends on q1, since the slider moves most for a turn of the crank halfway: C = ½ M′(q1) q̇1.

    Source: for the kinematics, J. E. Shigley, J. J. Uicker (1980), Theory of Machines and Mechanisms.

    >>> from armdyn import derive
    >>> crank = derive.slider_crank()
    >>> (crank.C[0] - crank.M[0].diff(crank.q[0]) * crank.qd[0] / 2).simplify()
    0
    """
    names = "q1 qd1 l1 l2 lc1 lc2 m1 m2 m3 I1 I2 g"
    q, qd, l1, l2, lc1, lc2, m1, m2, m3, I1, I2, g = symbols = sp.symbols(names, real=True)
    c, s = sp.cos(q), sp.sin(q)
    # The rod points down from the pin to the slider, at the angle whose sine is l1 sin q1 / l2.
    fall = l1 * s / l2
    reach = sp.sqrt(1 - fall**2)
    rod = sp.Matrix([l1 * c + lc2 * reach, l1 * s - lc2 * fall])
    slider = l1 * c + l2 * reach
    v2, v3, spin = rod.diff(q) * qd, slider.diff(q) * qd, l1 * c / (l2 * reach) * qd
    K = (m1 * lc1**2 + I1) * qd**2 + m2 * v2.dot(v2) + I2 * spin**2 + m3 * v3**2
    P = g * (m1 * lc1 * s + m2 * rod[1])
    return replace(from_energies(K / 2, P, [q], [qd]), parameters=symbols[2:])
