"""Draws a block diagram from its blocks and wires."""

from collections import defaultdict

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from armdyn.plotting.style import LINES, OKABE_ITO

WIDTH, GAP, PITCH, LANE, BRANCH = 1.3, 1.25, 0.5, 0.32, 0.55
SYMBOLS = {"integrator": r"$\int$", "function": r"$f\,(\cdot)$", "time": r"$t$"}
COLOURS = [OKABE_ITO[name] for name in LINES]
MATHTEXT = {"qd": r"\dot q", "qdd": r"\ddot q"}


def draw_block_diagram(ax: Axes, diagram) -> None:
    """Draw the diagram on `ax`: its blocks in the order in which signals pass, and its wires.

    diagram: a bdsim.BlockDiagram, such as `armdyn.ports.block_diagram.diagram` makes. Each output
    has its own colour, and its name beside it. A dot marks where its wire branches; wires that
    cross without a dot do not meet. Wires that lead back run below the blocks, and wires that pass
    a block run above it.
    """
    columns = _columns(diagram)
    places: dict = {}
    for column in sorted(set(columns.values())):
        _place(diagram, columns, column, places)
    for block, (x, y) in places.items():
        _draw_block(ax, block, x, y)
    _draw_wires(ax, diagram, columns, places)
    ax.set_aspect("equal")
    ax.axis("off")
    ax.autoscale_view()


def _columns(diagram) -> dict:
    """The column of each block: one more than the last that leads to it, loops left out."""
    following = defaultdict(list)
    for wire in diagram.wirelist:
        following[wire.start.block].append(wire.end.block)
    fed = {block for blocks in following.values() for block in blocks}
    finished: list = []
    open_ = set()
    back = set()  # the wires that close a loop

    def visit(block):
        open_.add(block)
        for after in following[block]:
            if after in open_:
                back.add((block, after))
            elif after not in finished:
                visit(after)
        open_.remove(block)
        finished.append(block)

    for block in sorted(diagram.blocklist, key=lambda block: block in fed):
        if block not in finished:
            visit(block)
    columns = dict.fromkeys(diagram.blocklist, 0)
    for block in reversed(finished):
        for after in following[block]:
            if (block, after) not in back:
                columns[after] = max(columns[after], columns[block] + 1)
    return columns


def _place(diagram, columns, column, places) -> None:
    """Place the blocks of a column so that the first wire from the column before it is straight."""
    lowest = np.inf
    for block in (b for b in diagram.blocklist if columns[b] == column):
        y = 0.0
        for wire in diagram.wirelist:
            if wire.end.block is block and columns[wire.start.block] == column - 1:
                source = wire.start.block
                level = places[source][1] + _offset(wire.start.port, source.nout)
                y = level - _offset(wire.end.port, block.nin)
                break
        y = min(y, lowest - _height(block) / 2 - 2 * LANE)
        places[block] = (column * (WIDTH + GAP), y)
        lowest = y - _height(block) / 2


def _offset(port, count) -> float:
    """The height of a port above the block's centre."""
    return PITCH * ((count - 1) / 2 - port)


def _height(block) -> float:
    return PITCH * (max(block.nin, block.nout, 1) + 1)


def _draw_block(ax, block, x, y) -> None:
    height = _height(block)
    corner = (x - WIDTH / 2, y - height / 2)
    ax.add_patch(Rectangle(corner, WIDTH, height, facecolor="white", edgecolor="black", zorder=3))
    ax.text(x, corner[1] - 0.08, block.name, ha="center", va="top", fontsize=9, zorder=4)
    named = block.nin > 1
    if block.type == "scope":
        s = np.linspace(0, 1, 60)
        ax.plot(x + 0.5 * s - 0.1, y + 0.25 * np.sin(9 * s) * (1 - s), "k-", linewidth=1, zorder=4)
        ax.plot([x - 0.1, x - 0.1, x + 0.45], [y + 0.3, y - 0.3, y - 0.3], "k-", lw=0.8, zorder=4)
    else:
        size = 16 if block.type == "integrator" else None
        ax.text(
            x + 0.12 * named, y, _symbol(block), ha="center", va="center", fontsize=size, zorder=4
        )
    if named:
        for port in range(block.nin):
            name = _name(block.inport_name(port))
            height = y + _offset(port, block.nin)
            ax.text(corner[0] + 0.08, height, name, va="center", fontsize=9, zorder=4)


def _symbol(block) -> str:
    if block.type == "constant":
        return "\n".join(f"{value:.4g}".replace("-", "−") for value in np.atleast_1d(block.value))
    return SYMBOLS.get(block.type, block.type)


def _name(port: str) -> str:
    return f"${MATHTEXT.get(port, port)}$"


def _draw_wires(ax, diagram, columns, places) -> None:
    top = max(y + _height(block) / 2 for block, (_, y) in places.items()) + LANE
    bottom = min(y - _height(block) / 2 for block, (_, y) in places.items()) - 2 * LANE
    lanes = {1: 0, -1: 0}
    outputs = list(dict.fromkeys((wire.start.block, wire.start.port) for wire in diagram.wirelist))
    trunks = defaultdict(list)  # the heights at which wires leave each output's vertical
    # The nearest first, so that a wire with a longer way runs outside of a shorter one.
    for wire in sorted(diagram.wirelist, key=lambda wire: abs(_span(wire, columns))):
        start, end, span = wire.start, wire.end, _span(wire, columns)
        place = outputs.index((start.block, start.port))
        colour = COLOURS[place % len(COLOURS)]
        x0, y0 = places[start.block]
        x1, y1 = places[end.block]
        x0, y0 = x0 + WIDTH / 2, y0 + _offset(start.port, start.block.nout)
        x1, y1 = x1 - WIDTH / 2, y1 + _offset(end.port, end.block.nin)
        branch = x0 + BRANCH
        if span == 1:
            points = [(x0, y0), (branch, y0), (branch, y1), (x1, y1)]
            trunks[start.block, start.port].append(y1)
        else:
            side = 1 if span > 1 else -1
            lane = top + lanes[1] * LANE if side > 0 else bottom - lanes[-1] * LANE
            lanes[side] += 1
            # Ports far from the lane are reached on the outside of those near to it.
            passed = end.port if side > 0 else end.block.nin - 1 - end.port
            down = x1 - 0.25 - 0.15 * passed
            points = [(x0, y0), (branch, y0), (branch, lane), (down, lane), (down, y1), (x1, y1)]
            trunks[start.block, start.port].append(lane)
        ax.plot(*zip(*points, strict=True), "-", color=colour, linewidth=1.4)
        ax.annotate(
            "",
            (x1, y1),
            (x1 - 0.01, y1),
            arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0},
        )
    for place, (block, port) in enumerate(outputs):
        colour = COLOURS[place % len(COLOURS)]
        x, y = places[block]
        x, y = x + WIDTH / 2, y + _offset(port, block.nout)
        ax.text(x + 0.08, y + 0.08, _name(block.outport_name(port)), color=colour, va="bottom")
        for level in _branches(y, trunks[block, port]):
            ax.plot(x + BRANCH, level, "o", color=colour, markersize=5)


def _branches(y, levels):
    """The heights at which a vertical from y branches, if wires leave it at these levels."""
    ends = {y, *levels}
    inner = ends - {min(ends), max(ends)}
    return inner | ({y} if levels.count(y) and len(ends) > 1 else set())


def _span(wire, columns) -> int:
    return columns[wire.end.block] - columns[wire.start.block]
