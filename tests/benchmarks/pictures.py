"""A control's picture beside a whole new figure: python -m tests.benchmarks.pictures [FILE].

Prints the section, and writes it to FILE if one is given.
"""

import itertools
import sys
from pathlib import Path

from armdyn import Planar2R, plotting
from tests.benchmarks import report
from tests.benchmarks.timing import Row, in_turn, table

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11)
HOW = """\
What the kernel does at each move of a slider of lesson 01: the torques, the drawing, the picture for the
notebook. Each figure is the least CPU time of one, both taken in turn in one process.
"""


def moves():
    """States of the arm, each beside the one before it, without end."""
    return itertools.cycle([([0.1 * k, 1.0], [1.0, 2.0], [3.0, -0.2 * k]) for k in range(20)])


def redrawn() -> Row:
    new, stays = moves(), moves()

    @plotting.live(plotting.torque_axes(joints=2, limit=80))
    def control(fig, q, qd, qdd):
        plotting.draw_torque_terms(fig, ARM, q, qd, qdd)
        return "The arm."

    def whole():
        figure = plotting.torque_terms(ARM, *next(new), limit=80)
        return plotting.Picture(figure, alt="The arm.")._repr_mimebundle_()

    ours, peer = in_turn(lambda: control(*next(stays))._repr_mimebundle_(), whole)
    return Row("a picture at a slider's move", ours, "a whole new figure", peer, 1 / 4)


def main(files: list[str]) -> None:
    section = f"{HOW}{report.machine()}.\n\n{table([redrawn()])}"
    print(section)
    for file in files:
        report.put(Path(file), "Pictures of a control", section, ("ours", "ratio"))


if __name__ == "__main__":
    main(sys.argv[1:])
