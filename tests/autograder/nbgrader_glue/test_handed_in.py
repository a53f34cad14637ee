"""Which notebook of a hand-in counts, and what is told of the rest; which files lie beside it."""

import copy
import json
import os
from contextlib import suppress

import pytest

from autograder.nbgrader_glue import handed_in
from autograder.nbgrader_glue.handed_in import UNREADABLE, beside, counted
from tests.autograder.course_problems import problem
from tests.submissions import p3_pendulum

P3 = "p3-pendulum"
NOTEBOOK = f"{P3}.ipynb"
SOURCE = problem(P3).source
IGNORE = [".ipynb_checkpoints", "*.pyc", "__pycache__", "feedback"]


def without_settings():
    notebook = copy.deepcopy(p3_pendulum.right(problem(P3).release))
    for cell in notebook.cells:
        cell.metadata = {}
    return notebook


NOTEBOOKS = {
    "right": lambda: p3_pendulum.right(problem(P3).release),
    "blank": lambda: problem(P3).release,
    "other": lambda: problem("p1-inertia").release,
    "bare": without_settings,
    "damaged": lambda: '{"cells": [',
    "no cells": lambda: {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": 3},
}


def hand_in(folder, kinds):
    for name, kind in kinds.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True, parents=True)
        made = NOTEBOOKS[kind]() if kind in NOTEBOOKS else kind
        path.write_text(made if isinstance(made, str) else json.dumps(made))
    return folder


BESIDE = f"lies beside {NOTEBOOK} and was not graded"


@pytest.mark.parametrize(
    ("kinds", "taken", "said"),
    [
        ({NOTEBOOK: "blank"}, NOTEBOOK, []),
        ({NOTEBOOK: "damaged"}, NOTEBOOK, []),
        ({NOTEBOOK: "right", "old.ipynb": "right"}, NOTEBOOK, [f"old.ipynb, with answers, {BESIDE}"]),
        ({NOTEBOOK: "blank", "new.ipynb": "bare"}, NOTEBOOK,
         [f"{NOTEBOOK} was graded but has no answers; new.ipynb beside it has some"]),
        ({NOTEBOOK: "right", "new.ipynb": "blank"}, NOTEBOOK,
         [f"new.ipynb, without answers, {BESIDE}"]),
        ({NOTEBOOK: "right", "p1.ipynb": "other", "x.ipynb": "damaged", "y.ipynb": "no cells"},
         NOTEBOOK, []),
        ({NOTEBOOK: "damaged", "new.ipynb": "right"}, NOTEBOOK, [f"new.ipynb, with answers, {BESIDE}"]),
        ({"my own.ipynb": "right", "p1.ipynb": "other"}, "my own.ipynb",
         [f"there is no {NOTEBOOK}; my own.ipynb was graded instead"]),
        ({"my own.ipynb": "blank"}, "my own.ipynb",
         [f"there is no {NOTEBOOK}; my own.ipynb was graded instead"]),
        ({"a.ipynb": "blank", "b.ipynb": "bare"}, "b.ipynb",
         [f"there is no {NOTEBOOK}; b.ipynb was graded instead",
          "a.ipynb, without answers, lies beside b.ipynb and was not graded"]),
    ],
)  # fmt: skip
def test_which_counts(tmp_path, kinds, taken, said):
    assert counted(hand_in(tmp_path, kinds), P3, SOURCE) == (tmp_path / taken, said)


@pytest.mark.parametrize(
    ("kinds", "said"),
    [
        ({}, ""),
        ({"timestamp.txt": "2025"}, ""),
        ({"p1.ipynb": "other", "x/p3-pendulum.ipynb": "right"}, ", only p1.ipynb, x/p3-pendulum.ipynb"),
        ({f"{n}.txt": "" for n in range(7)}, ", only 0.txt, 1.txt, 2.txt, 3.txt, 4.txt and 2 more"),
        ({"a.ipynb": "right", "b.ipynb": "right"},
         ", but there are a.ipynb and b.ipynb: ask the student which one counts, and rename it"),
        ({"a\nb.zip": ""}, r", only a\nb.zip"),
    ],
)  # fmt: skip
def test_where_none_counts_it_is_said_what_is_there(tmp_path, kinds, said):
    with pytest.raises(FileNotFoundError) as caught:
        counted(hand_in(tmp_path, kinds), P3, SOURCE)
    assert str(caught.value) == f"there is no {NOTEBOOK}{said}"


def test_a_hand_in_of_many_notebooks_holds_up_nobody(tmp_path, monkeypatch):
    folder = hand_in(tmp_path, {f"{n:03}.ipynb": "{}" for n in range(40)} | {NOTEBOOK: "right"})
    looked_at = []
    monkeypatch.setattr(
        handed_in, "_likeness", lambda path, source: looked_at.append(path) or UNREADABLE
    )
    assert counted(folder, P3, SOURCE) == (folder / NOTEBOOK, [])
    assert len(looked_at) == handed_in.MOST_LOOKED_AT + 1
    looked_at.clear()
    monkeypatch.setattr(handed_in, "MOST_BYTES", 5)
    counted(folder, P3, SOURCE)
    assert len(looked_at) == 2 + 1  # two bytes each, and the graded one


def test_files_beside_the_notebook(tmp_path):
    folder = hand_in(
        tmp_path / "theirs",
        {
            NOTEBOOK: "right",
            "run.py": "x",
            "sub/data.csv": "1",
            "photo.png": "p",
            "arm.svg": "theirs",
            "kept.csv": "theirs",
            "timestamp.txt": "2025",
            ".hidden": "",
            ".config/x.py": "",
            "__pycache__/run.pyc": "",
            "sub/other.ipynb": "{}",
        },
    )
    with suppress(OSError):  # not every file system takes it
        (folder / os.fsdecode(b"no text \xff.csv")).write_text("")
    source = hand_in(
        tmp_path / "ours", {"arm.svg": "ours", "kept.csv": "ours", "given.py": "y", NOTEBOOK: "{}"}
    )
    found = beside(folder, source, IGNORE, kept=["kept.csv"])
    assert found.laid == {
        "run.py": b"x",
        "sub/data.csv": b"1",
        "photo.png": b"p",
        "arm.svg": b"ours",
        "kept.csv": b"theirs",
        "given.py": b"y",
    }
    assert found.left_out == dict.fromkeys([NOTEBOOK, "sub/other.ipynb"], "it is a notebook")
    assert found.documents == ("photo.png",)
