"""armdyn's speed beside its peers', in one process: python -m tests.benchmarks.library [FILE].

Prints the section, and writes it to FILE if one is given. Each figure is a ratio of least times,
measured in turn. The agreement of the results is checked before anything is timed.
"""

import sys
import time
from pathlib import Path

import mujoco
import numba
import numpy as np
import pinocchio as pin
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from armdyn import Planar2R, SerialChain, codegen, derive
from tests.armdyn.robots import panda
from tests.benchmarks import limits, report
from tests.benchmarks.timing import Row, in_turn, table

ARM = {"l1": 1.0, "l2": 0.8, "lc1": 0.5, "lc2": 0.4, "m1": 3.0, "m2": 2.0, "I1": 0.25, "I2": 0.11}
STATES = 1_000_000
STEPS = 10_000  # of one arm; a thousand arms do a tenth of them
HOW = """\
Each figure is the least CPU time of one call, ours and the peer's taken in turn in one process. The
results are compared before they are timed.
"""
LOOPED = 20_000  # of the states, as many as a Python loop gets through in reasonable time


def pinocchio_2r():
    """The 2R in Pinocchio: gravity along −y, joints about z."""
    model = pin.Model()
    model.gravity.linear = np.array([0.0, -9.81, 0.0])
    at, place = 0, pin.SE3.Identity()
    for i in ("1", "2"):
        at = model.addJoint(at, pin.JointModelRZ(), place, f"joint{i}")
        com = np.array([ARM["lc" + i], 0.0, 0.0])
        inertia = np.diag([0.0, 0.0, ARM["I" + i]])
        model.appendBodyToJoint(at, pin.Inertia(ARM["m" + i], com, inertia), pin.SE3.Identity())
        place = pin.SE3(np.eye(3), np.array([ARM["l" + i], 0.0, 0.0]))
    return model, model.createData()


def one_state(ours: Planar2R, compiled) -> list[Row]:
    model, data = pinocchio_2r()
    q, qd, u = np.array([0.3, 0.4]), np.array([1.0, 2.0]), np.array([0.1, 0.2])
    numbers = (*q.tolist(), *qd.tolist(), *u.tolist())
    expected = pin.aba(model, data, q, qd, u)
    for found in (ours.dynamics(q, qd, u), compiled.dynamics(q, qd, u)):
        np.testing.assert_allclose(found, expected, rtol=1e-12)
    np.testing.assert_allclose(compiled.dynamics_floats(*numbers), expected, rtol=1e-12)
    rows = []
    for what, call, goal in (
        ("2R forward dynamics, one state: Planar2R, arrays", lambda: ours.dynamics(q, qd, u), 1.3),
        ("the same, generated C, arrays", lambda: compiled.dynamics(q, qd, u), 1.0),
        ("the same, generated C, floats", lambda: compiled.dynamics_floats(*numbers), 0.4),
    ):
        times = in_turn(call, lambda: pin.aba(model, data, q, qd, u), number=5000, rounds=40)
        rows.append(Row(what, times[0], "Pinocchio aba", times[1], goal))
    return rows


def many_states(generated, compiled) -> list[Row]:
    model, data = pinocchio_2r()
    rng = np.random.default_rng(0)
    q, qd, u = rng.uniform(-3, 3, size=(3, STATES, 2))

    looped_qdd = np.empty((LOOPED, 2))

    def loop():
        for k in range(LOOPED):
            looped_qdd[k] = pin.aba(model, data, q[k], qd[k], u[k])

    expected = [pin.aba(model, data, q[k], qd[k], u[k]) for k in range(100)]
    rows = []
    for name, call, goal in (
        ("NumPy", lambda: generated.dynamics(q, qd, u), 30),
        ("generated C", lambda: compiled.dynamics_many(q, qd, u), 150),
    ):
        np.testing.assert_allclose(call()[:100], expected, rtol=1e-10)
        ours, looped = in_turn(call, loop, rounds=8)
        peer = looped * STATES / LOOPED
        rows.append(Row(f"a million 2R states, {name}", ours, "looped aba", peer, 1 / goal))
    return rows


def pinocchio_chain(chain: SerialChain):
    """A chain of joints about z in Pinocchio, whose fastest joints they are."""
    model = pin.Model()
    model.gravity.linear = np.array(chain.gravity)
    at = 0
    for k, link in enumerate(chain.links):
        place = pin.SE3(np.array(link.rotation), np.array(link.translation))
        at = model.addJoint(at, pin.JointModelRZ(), place, f"joint{k}")
        body = pin.Inertia(link.mass, np.array(link.com), np.array(link.inertia))
        model.appendBodyToJoint(at, body, pin.SE3.Identity())
    return model, model.createData()


def panda_states(compiled) -> list[Row]:
    """A published arm of seven joints, from its links to C."""
    model, data = pinocchio_chain(panda())
    q, qd, u = np.random.default_rng(2).uniform(-2, 2, size=(3, 1000, 7))
    expected = [pin.aba(model, data, *state) for state in zip(q, qd, u, strict=True)]
    np.testing.assert_allclose(compiled.dynamics_many(q, qd, u), expected, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(compiled.dynamics(q[0], qd[0], u[0]), expected[0], rtol=1e-10)

    def loop():
        for k in range(1000):
            pin.aba(model, data, q[k], qd[k], u[k])

    first = q[0], qd[0], u[0]
    one = in_turn(
        lambda: compiled.dynamics(*first), lambda: pin.aba(model, data, *first), 2000, rounds=40
    )
    many = in_turn(lambda: compiled.dynamics_many(q, qd, u), loop, number=3, rounds=20)
    what = "Panda forward dynamics, one state: generated C, arrays"
    return [
        Row(what, one[0], "Pinocchio aba", one[1], 1.0),
        Row("a thousand Panda states, generated C", many[0], "looped aba", many[1], 1 / 5),
    ]


def panda_written() -> str:
    """A sentence on how long a derivation, and source in the languages, take."""

    def derived_and_written():
        derivation = panda().derivation()
        for write in (codegen.cpp, codegen.java, codegen.matlab, codegen.wolfram):
            write(derivation)
        codegen.c_code.source(codegen.straight_line.forward_dynamics(derivation), 7)

    taken = seconds(derived_and_written)
    return f"The Panda from links to source in five languages: {taken:.1f} s (goal: 10 s).\n"


def lagranges_method(n: int):
    """SymPy's own route for the planar chain: LagrangesMethod, then lambdify."""
    q = dynamicsymbols(f"q1:{n + 1}")
    t, g = dynamicsymbols._t, sp.Symbol("g")
    l, lc, m, I = (sp.symbols(f"{name}1:{n + 1}") for name in ("l", "lc", "m", "I"))
    K, P, joint, angle = 0, 0, sp.Matrix([0, 0]), 0
    for i in range(n):
        angle += q[i]
        along = sp.Matrix([sp.cos(angle), sp.sin(angle)])
        com = joint + lc[i] * along
        velocity = com.diff(t)
        K += m[i] * velocity.dot(velocity) / 2 + I[i] * angle.diff(t) ** 2 / 2
        P += m[i] * g * com[1]
        joint = joint + l[i] * along
    method = LagrangesMethod(K - P, q)
    method.form_lagranges_equations()
    arguments = [*q, *(x.diff(t) for x in q), g, *l, *lc, *m, *I]
    return sp.lambdify(arguments, [method.mass_matrix, method.forcing], cse=True)


def ours_derived(n: int):
    """The same by armdyn: derivation, code, and the first call, which compiles it."""
    derivation = derive.planar_chain(n)
    values = {symbol.name: 9.81 if symbol.name == "g" else 1.0 for symbol in derivation.parameters}
    model = codegen.numpy_model(derivation, values)
    zero = np.zeros(n)
    model.M(zero), model.C(zero, zero), model.g_vec(zero)
    return model


def seconds(function, *arguments) -> float:
    """The time of one call, with nothing left over in SymPy's cache."""
    sp.core.cache.clear_cache()
    start = time.process_time()
    function(*arguments)
    return time.process_time() - start


def derivations() -> list[Row]:
    peer = "LagrangesMethod"
    six, four = seconds(lagranges_method, 6), seconds(lagranges_method, 4)
    return [
        Row("planar chain to a callable, n = 6", seconds(ours_derived, 6), peer, six, 1 / 15),
        Row("n = 10, beside that route's n = 4", seconds(ours_derived, 10), peer, four, 1.0),
    ]


MJCF = """
<mujoco>
  <option timestep="0.001" gravity="0 -9.81 0" integrator="RK4"><flag contact="disable"/></option>
  <worldbody><body><joint type="hinge" axis="0 0 1"/>
    <inertial pos="{lc1} 0 0" mass="{m1}" diaginertia="{I1} {I1} {I1}"/>
    <body pos="{l1} 0 0"><joint type="hinge" axis="0 0 1"/>
      <inertial pos="{lc2} 0 0" mass="{m2}" diaginertia="{I2} {I2} {I2}"/>
    </body></body></worldbody>
</mujoco>
"""


def simulations(arm: Planar2R, compiled) -> tuple[list[Row], str]:
    """The rows, and a sentence on the energy drift."""
    model = mujoco.MjModel.from_xml_string(MJCF.format(**ARM))
    data = mujoco.MjData(model)
    steps, dt, x0, u = STEPS, 1e-3, np.array([0.5, 0.3, 0.0, 0.0]), np.zeros(2)

    def stepped():
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = x0[:2], x0[2:]
        for _ in range(steps):
            mujoco.mj_step(model, data)

    def drift(x):
        return abs(float(arm.energy(x[:2], x[2:]) - arm.energy(x0[:2], x0[2:])))

    ours, theirs = in_turn(lambda: compiled.rk4(x0, u, dt, steps), stepped, rounds=5)
    end = compiled.rk4(x0, u, dt, steps, final=True)
    drifts = drift(end), drift(np.concatenate([data.qpos, data.qvel]))
    rows = [Row("10 s of the free 2R, RK4 at 1 ms", ours, "MuJoCo", theirs, 1 / 40)]
    drifted = f"Energy drift of the 10 s run: ours {drifts[0]:.4e} J, MuJoCo {drifts[1]:.4e} J.\n"

    arms = np.random.default_rng(1).uniform(-1, 1, size=(1000, 4))
    loop = numba_loop(arm)
    few = STEPS // 10
    np.testing.assert_allclose(
        compiled.rk4(arms, u, dt, 100, final=True), loop(arms, dt, 100), rtol=1e-9, atol=1e-11
    )
    ours, theirs = in_turn(
        lambda: compiled.rk4(arms, u, dt, few, final=True), lambda: loop(arms, dt, few), rounds=5
    )
    rows.append(Row("a thousand free arms, 1 s at 1 ms", ours, "the same in numba", theirs, 1 / 8))
    return rows, drifted


def numba_loop(arm: Planar2R):
    """The same loop, written out in Python and compiled by numba."""
    a = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
    b, k = arm.I2 + arm.m2 * arm.lc2**2, arm.m2 * arm.l1 * arm.lc2
    G1, G2 = (arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g, arm.m2 * arm.lc2 * arm.g

    # In plain floats: numba is fastest without temporary arrays.
    @numba.njit
    def acceleration(q1, q2, qd1, qd2):
        coupling, h = k * np.cos(q2), -k * np.sin(q2)
        g2 = G2 * np.cos(q1 + q2)
        rest1 = -h * qd2 * (2 * qd1 + qd2) - G1 * np.cos(q1) - g2
        rest2 = h * qd1 * qd1 - g2
        M12 = b + coupling
        det = a * b - coupling * coupling
        return (b * rest1 - M12 * rest2) / det, ((a + M12 + coupling) * rest2 - M12 * rest1) / det

    @numba.njit
    def run(x0, dt, steps):
        end = np.empty_like(x0)
        half = dt / 2
        for i in range(len(x0)):
            q1, q2, v1, v2 = x0[i, 0], x0[i, 1], x0[i, 2], x0[i, 3]
            for _ in range(steps):
                a1, a2 = acceleration(q1, q2, v1, v2)
                w1, w2 = v1 + half * a1, v2 + half * a2
                b1, b2 = acceleration(q1 + half * v1, q2 + half * v2, w1, w2)
                y1, y2 = v1 + half * b1, v2 + half * b2
                c1, c2 = acceleration(q1 + half * w1, q2 + half * w2, y1, y2)
                z1, z2 = v1 + dt * c1, v2 + dt * c2
                d1, d2 = acceleration(q1 + dt * y1, q2 + dt * y2, z1, z2)
                q1 += dt / 6 * (v1 + 2 * w1 + 2 * y1 + z1)
                q2 += dt / 6 * (v2 + 2 * w2 + 2 * y2 + z2)
                v1 += dt / 6 * (a1 + 2 * b1 + 2 * c1 + d1)
                v2 += dt / 6 * (a2 + 2 * b2 + 2 * c2 + d2)
            end[i, 0], end[i, 1], end[i, 2], end[i, 3] = q1, q2, v1, v2
        return end

    return run


def beside_limits(derivation, rows: list[Row]) -> str:
    """What generated C does in the time of its rows, beside what the machine can do."""
    evaluation, step = limits.evaluation_and_step(derivation)
    times = {row.what: row.ours for row in rows}
    states, arm, arms = (
        times[what]
        for what in (
            "a million 2R states, generated C",
            "10 s of the free 2R, RK4 at 1 ms",
            "a thousand free arms, 1 s at 1 ms",
        )
    )
    number = 8 * derivation.n  # bytes
    work = [
        limits.Work("one of a million 2R states", states / STATES, 4 * number, evaluation),
        limits.Work("one step of one arm, kept", arm / STEPS, 2 * number, step),
        limits.Work("one step of one of a thousand arms", arms / (100 * STEPS), 0, step),
    ]
    copy, peak = limits.copied_bytes(), limits.most_operations()
    return f"""\
Generated C beside the limits of the machine, for one thread, measured in this run: a copy in memory
reads and writes {copy / 1e9:.3g} GB/s; multiplying and adding in registers, {peak / 1e9:.3g} Gflop/s.
Bytes are those of q, q̇, u and q̈ in memory (a thousand arms stay in the cache). Operations are the
+, −, · and / in the C code, with those of sines and cosines.

{limits.table(work, copy, peak)}"""


def main(files: list[str]) -> None:
    arm = Planar2R(**ARM)
    derivation = derive.planar_2r()
    values = {symbol.name: getattr(arm, symbol.name) for symbol in derivation.parameters}
    generated = codegen.numpy_model(derivation, values)
    compiled = codegen.c_model(derivation, values)
    simulated, drifted = simulations(arm, compiled)
    rows = [
        *one_state(arm, compiled),
        *many_states(generated, compiled),
        *panda_states(codegen.c_model(panda().derivation(), {})),
        *derivations(),
        *simulated,
    ]
    six = derive.planar_chain(6)
    steps, matrices = sp.cse([six.M, six.C, six.g_vec])
    operations = sum(sp.count_ops(e) for _, e in steps) + sum(sp.count_ops(m) for m in matrices)
    counted = (
        f"Operations of M, C and g after cse, planar chain, n = 6: {operations} (goal: 700).\n"
    )
    text = (
        f"{HOW}{report.machine()}.\n\n{table(rows)}\n{drifted}{counted}{panda_written()}\n"
        f"{beside_limits(derivation, rows)}"
    )
    print(text)
    for file in files:
        report.put(Path(file), "The library", text, measured=("ours", "ratio"))


if __name__ == "__main__":
    main(sys.argv[1:])
