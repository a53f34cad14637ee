"""The arm as a block diagram: bdsim runs it as armdyn does, and what is drawn is what is wired."""

import sys
from itertools import pairwise

import bdsim
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.patches import Rectangle

from armdyn import Pendulum, Planar2R, PlanarChain, plotting
from armdyn.ports import block_diagram
from armdyn.simulate import simulate
from tests.armdyn.arms import between, planar_arms, vectors

ARM = Planar2R(1.0, 0.8, 0.5, 0.3, 2.0, 1.5, 0.2, 0.1, viscous=(0.4, 0.3))
THREE = PlanarChain((1, 0.8, 0.5), (0.5, 0.4, 0.2), (2, 1.5, 1), (0.2, 0.1, 0.05))
X0, U, T = [0.5, -0.3, 0.1, 0.2], [1.0, -2.0], np.linspace(0, 1, 11)


def feedback(t, x):
    n = len(x) // 2
    return 3 * np.sin(5 * t) - 4 * x[:n] - x[n:]


@settings(max_examples=8)  # each runs a simulation
@given(planar_arms(coulomb=st.just(0.0)), vectors(4, 2.0), vectors(2, 5.0), between(-2, 2))
def test_it_moves_as_the_arm_does(arm, x0, u, start):
    """Both take SciPy's steps with the same tolerances, so they differ by rounding alone."""
    t = start + np.linspace(0, 0.3, 7)
    found = block_diagram.simulate(arm, x0, u, t, rtol=1e-6)
    right = simulate(arm.state_derivative, x0, u, t, "RK45", rtol=1e-6)
    assert np.abs(found - right).max() <= 1e-9 * max(1, np.abs(right).max())


@pytest.mark.parametrize("method", ["RK45", "DOP853", "RK23"])
@pytest.mark.parametrize("u", [U, feedback], ids=["constant", "function"])
def test_methods_and_inputs(method, u):
    t = 2 + T / 2
    found = block_diagram.simulate(ARM, X0, u, t, method, rtol=1e-5, atol=1e-7)
    right = simulate(ARM.state_derivative, X0, u, t, method, rtol=1e-5, atol=1e-7)
    assert found == pytest.approx(right, rel=1e-11, abs=1e-12)


def test_lsoda_keeps_its_tolerances():
    """Its steps depend on the last bits of ẋ: it agrees to its tolerances, not to rounding."""
    found = block_diagram.simulate(ARM, X0, U, T, "LSODA", rtol=1e-10)
    right = simulate(ARM.state_derivative, X0, U, T, "DOP853", rtol=1e-12)
    assert found == pytest.approx(right, abs=1e-6)


@pytest.mark.parametrize("arm", [Pendulum(1.0, 0.5, 0.4, viscous=0.1), THREE], ids=["1", "3"])
def test_any_number_of_joints(arm):
    x0, t = np.linspace(0.5, -0.5, 2 * arm.n), [0.0, 0.1, 0.3]
    found = block_diagram.simulate(arm, x0, feedback, t, rtol=1e-6)
    right = simulate(arm.state_derivative, x0, feedback, t, "RK45", rtol=1e-6)
    assert found == pytest.approx(right, rel=1e-9)


def wires(diagram):
    """(from, output, to, input) of each wire."""
    return {
        (a.block.name, a.block.outport_name(a.port), b.block.name, b.block.inport_name(b.port))
        for a, b in ((wire.start, wire.end) for wire in diagram.wirelist)
    }


LOOP = {
    ("dynamics", "qdd", "velocity", "[0]"),
    ("velocity", "qd", "position", "[0]"),
    ("velocity", "qd", "dynamics", "qd"),
    ("position", "q", "dynamics", "q"),
    ("velocity", "qd", "scope", "qd"),
    ("position", "q", "scope", "q"),
    ("torque", "u", "dynamics", "u"),
}
FED = {
    ("time", "t", "torque", "t"),
    ("position", "q", "torque", "q"),
    ("velocity", "qd", "torque", "qd"),
}


@pytest.mark.parametrize(("u", "expected"), [(U, LOOP), (feedback, LOOP | FED)])
def test_it_is_a_function_block_and_two_integrators_in_a_loop(u, expected):
    diagram = block_diagram.diagram(ARM, X0, u)
    assert wires(diagram) == expected
    kinds = sorted(block.type for block in diagram.blocklist)
    assert kinds.count("integrator") == 2
    assert diagram.getstate0() == pytest.approx(X0)


def test_it_says_nothing_and_takes_no_options_of_the_command_line(capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["lesson", "--simtime=7", "--animation"])
    found = block_diagram.simulate(ARM, X0, U, T)
    assert found.shape == (len(T), 4)
    assert capsys.readouterr() == ("", "")


def test_without_bdsim_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "bdsim", None)
    with pytest.raises(ImportError, match=r"^.*bdsim: pip install 'armdyn\[ports\]'$"):
        block_diagram.simulate(ARM, X0, U, T)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"x0": [0, 0, 0]}, "x0: got shape"),
        ({"x0": [X0, X0]}, "x0: got shape"),
        ({"u": [1.0]}, "u: got shape"),
        ({"u": [U, U]}, "u: got shape"),
        ({"u": lambda t, x: np.zeros(3)}, "u: got shape"),
        ({"t": [0, 0]}, "t: got shape"),
        ({"t": [0.0]}, "t: got shape"),
        ({"t": [0.0, np.nan]}, "t: got shape"),
        ({"method": "rk4"}, "method = 'rk4'"),
        ({"rtol": 0}, "rtol"),
        ({"atol": -1}, "atol"),
    ],
)
def test_wrong_arguments_are_named(changed, message):
    arguments = {"x0": X0, "u": U, "t": T} | changed
    with pytest.raises(ValueError, match=message):
        block_diagram.simulate(ARM, **arguments)


@pytest.mark.parametrize("error", [ZeroDivisionError("mine"), np.linalg.LinAlgError("mine")])
def test_errors_on_the_way_come_as_they_were(error):
    def u(t, x):
        if t > 2.5:
            raise error
        return np.zeros(2)

    with pytest.raises(type(error), match="mine"):
        block_diagram.simulate(ARM, X0, u, 2 + T)


def test_a_singular_arm_is_named_at_once():
    points = Planar2R(1.0, 0.8, 0.0, 0.4, 2.0, 1.5, 0.0, 0.0)
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        block_diagram.simulate(points, [0, 0, 0, 0], U, T)


def test_states_that_run_away_are_not_returned():
    with pytest.raises(FloatingPointError):
        block_diagram.simulate(ARM, X0, lambda t, x: 1e6 * x[2:] ** 3, T)


def gains():
    """A diagram that is no arm: two sources, a block with two outputs, a loop of its own."""
    simulator = bdsim.BDSim(sysargs=False, toolboxes=False, graphics=False, quiet=True)
    blocks = simulator.blockdiagram("gains")
    first, second = (blocks.CONSTANT(k, name=f"c{k}") for k in (1, 2))
    both = blocks.FUNCTION([lambda a, b, c: a, lambda a, b, c: b], nin=3, nout=2, name="both")
    state = blocks.INTEGRATOR(x0=0.0, name="state")
    sink = blocks.SCOPE(nin=2, name="seen")
    blocks.connect(first, both[0])
    blocks.connect(second, both[1])
    blocks.connect(both[0], state)
    blocks.connect(both[1], sink[0])
    blocks.connect(state, both[2], sink[1])
    blocks.compile()
    return blocks


DIAGRAMS = {
    "constant": lambda: block_diagram.diagram(ARM, X0, U),
    "feedback": lambda: block_diagram.diagram(ARM, X0, feedback),
    "gains": gains,
}


@pytest.fixture(params=DIAGRAMS)
def drawn(request):
    """The diagram, its axes, and the box (left, bottom, right, top) of each block by its name."""
    diagram = DIAGRAMS[request.param]()
    _, ax = plotting.figure()
    plotting.draw_block_diagram(ax, diagram)
    boxes = {}
    for patch in ax.patches:
        if isinstance(patch, Rectangle):
            left, bottom = patch.get_xy()
            right, top = left + patch.get_width(), bottom + patch.get_height()
            (name,) = (
                text.get_text()
                for text in ax.texts
                if text.get_position()[0] == pytest.approx((left + right) / 2)
                and 0 < bottom - text.get_position()[1] < 0.2
            )
            boxes[name] = (left, bottom, right, top)
    return diagram, ax, boxes


def paths(ax, boxes):
    """The lines that run outside the boxes: the wires, without the dots and the scope's screen."""
    lines = [line.get_xydata() for line in ax.lines if len(line.get_xydata()) > 1]
    return [p for p in lines if not any(inside(box, p[0]) for box in boxes.values())]


def inside(box, point):
    left, bottom, right, top = box
    return left + 1e-9 < point[0] < right - 1e-9 and bottom + 1e-9 < point[1] < top - 1e-9


def port(diagram, boxes, block, k, count, right):
    """Where the k-th of `count` ports of the block's right or left side is, from the top."""
    box = boxes[block.name]
    spacing = (box[3] - box[1]) / (max(block.nin, block.nout, 1) + 1)
    middle = (box[1] + box[3]) / 2
    return box[2 if right else 0], middle + spacing * ((count - 1) / 2 - k)


def test_every_block_is_drawn_once_and_none_overlap(drawn):
    diagram, _, boxes = drawn
    assert sorted(boxes) == sorted(block.name for block in diagram.blocklist)
    sides = list(boxes.values())
    for i, a in enumerate(sides):
        for b in sides[:i]:
            assert a[2] < b[0] or b[2] < a[0] or a[3] < b[1] or b[3] < a[1]


def test_every_wire_is_drawn_from_its_output_to_its_input(drawn):
    diagram, ax, boxes = drawn
    ends = sorted((*path[0], *path[-1]) for path in paths(ax, boxes))
    expected = sorted(
        (
            *port(diagram, boxes, w.start.block, w.start.port, w.start.block.nout, right=True),
            *port(diagram, boxes, w.end.block, w.end.port, w.end.block.nin, right=False),
        )
        for w in diagram.wirelist
    )
    assert np.array(ends) == pytest.approx(np.array(expected))


def test_no_wire_runs_through_a_block(drawn):
    _, ax, boxes = drawn
    for path in paths(ax, boxes):
        steps = np.linspace(0, 1, 200)[:, np.newaxis]
        points = np.vstack([a + steps * (b - a) for a, b in pairwise(path)])
        assert not [p for p in points for box in boxes.values() if inside(box, p)]


def test_wires_of_different_outputs_share_no_stretch(drawn):
    """They cross, at most: laid over each other they could not be told apart."""
    _, ax, boxes = drawn
    stretches = []
    for path in paths(ax, boxes):
        for a, b in pairwise(path):
            if np.abs(a - b).max() > 1e-9:
                stretches.append((tuple(path[0]), a, b))
    for i, (source, a, b) in enumerate(stretches):
        for other, c, d in stretches[:i]:
            if source != other:
                along = int(a[0] == b[0])
                if c[1 - along] == d[1 - along] == a[1 - along] and c[along] != d[along]:
                    low = max(min(a[along], b[along]), min(c[along], d[along]))
                    high = min(max(a[along], b[along]), max(c[along], d[along]))
                    assert high - low <= 1e-9


def test_signals_are_named(drawn):
    diagram, ax, _ = drawn
    texts = [text.get_text() for text in ax.texts]
    names = {"qd": r"$\dot q$", "qdd": r"$\ddot q$"}
    for block in diagram.blocklist:
        for k in range(block.nout):
            name = block.outport_name(k)
            assert names.get(name, f"${name}$") in texts


def test_dots_mark_the_branches():
    _, ax = plotting.figure()
    plotting.draw_block_diagram(ax, block_diagram.diagram(ARM, X0, U))
    dots = [line for line in ax.lines if line.get_marker() == "o"]
    assert len(dots) == 2  # q̇ and q go to more than one block
