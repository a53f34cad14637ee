"""What a hostile submission is: an edit of the released notebook for points that are not earned.

Each is the released notebook with right answers, edited by one attack: what the right answers earn
stays earned, and `lost` names the checks where the attack must earn nothing. An attack that gets hold
of something it should not have prints or returns GOT. Where an attack gets further without
bubblewrap, `fallback` says how.
"""

import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell

from tests.submissions.answers import cell_of
from tests.submissions.p3_pendulum import POINTS, function, right_but

GOT = "got through the wall"
ROOT = Path(__file__).parents[2]
# A folder outside every room, to be written to.
OUTSIDE = Path(tempfile.gettempdir()) / f"zoo-{os.getpid()}"
WRONG = function("g_vec", "1 + 0 * q")
# Where a server listens on this machine while the zoo is graded: set by its test.
LISTENING = SimpleNamespace(port=1)


@dataclass(frozen=True)
class Attack:
    """One hostile submission.

    edit(release): the notebook. tries: what it is after. lost: the grade cells that must earn nothing;
    all others earn all. says: what a verdict, a note or a cell's output must say of it.
    fallback: what it gets without bubblewrap; "" where that stops it as well.
    """

    name: str
    edit: Callable[[NotebookNode], NotebookNode]
    tries: str
    lost: tuple[str, ...]
    says: str
    fallback: str

    @property
    def points(self) -> dict[str, float]:
        return {name: 0.0 if name in self.lost else most for name, most in POINTS.items()}


ATTACKS: dict[str, Attack] = {}


def attack(lost=("p3-g_vec",), says="p3-g_vec: incorrect", fallback=""):
    """Enter a function that edits the release; its docstring says what it tries."""

    def enter(edit):
        name = edit.__name__
        ATTACKS[name] = Attack(name, edit, edit.__doc__, tuple(lost), says, fallback)
        return edit

    return enter


def cheat(release, first="", **answers):
    """All right but g_vec, or but `answers`; the code `first` in a cell of its own before them all."""
    notebook = right_but(release, **(answers or {"g_vec": WRONG}))
    if first:
        after = notebook.cells.index(cell_of(notebook, "p3-setup"))
        notebook.cells.insert(after + 1, new_code_cell(first.strip()))
    return notebook


def last(release, source):
    """The attack in the last answer, wrong as well, so that all earlier points are earned."""
    wrong = function("small_angle_frequency", "-1.0")
    return cheat(release, small_angle_frequency=source.strip() + "\n" + wrong)


LAST = ("p3-small_angle_frequency",)


FORGE = """
import os
for descriptor in range(3, 64):
    try:
        os.write(descriptor, {!r})
    except OSError:
        pass
"""
