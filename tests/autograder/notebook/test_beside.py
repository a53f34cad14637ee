"""Files beside a notebook: what cells find, in rooms of every kind, and what is said of others."""

import pytest

from autograder.notebook import beside
from autograder.notebook.beside import Beside, choose
from autograder.protocol import Fault, FaultKind, Reply
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.sandbox.rooms import EVERY_WAY, printed

FILES = {
    "mine.py": b"x = 'mine'",
    "package/__init__.py": b"",
    "package/part.py": b"x = 'part'",
    "my data/one.csv": b"1,2",
    "script.py": b"y = 'run'",
    # Names that the room itself, the protocol and Python have.
    "runner.py": b"x = 'not the room'",
    "numpy.py": b"raise SystemExit",
    "sympy.py": b"raise SystemExit",
    "test.py": b"x = 'not Python'",
}


@pytest.fixture(scope="module")
def furnished():
    """One room of each kind, with the files, started when a test asks for it."""
    rooms = {}
    yield lambda way: rooms.setdefault(way, Room(way, FILES)) if way not in rooms else rooms[way]
    for room in rooms.values():
        room.close()


@EVERY_WAY
@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        ("import mine; print(mine.x)", "mine"),
        ("from package.part import x; print(x)", "part"),
        ("print(open('my data/one.csv').read())", "1,2"),
        ("%run script.py\nprint(y)", "run"),
        ("import runner; print(runner.x)", "not the room"),
        ("import test; print(test.x)", "not Python"),
        ("import numpy, sympy; print(numpy.cos(0), sympy.cos(0))", "1.0 1"),
        ("from autograder import check; check('p3-M'); print('ok')", "ok"),
        ("open('late.py', 'w').write('z = 1')\nimport late; print(late.z)", "1"),
    ],
)
def test_cells_find_them(furnished, way, cell, expected):
    assert printed(furnished(way), cell) == expected


@EVERY_WAY
def test_without_any_a_module_that_a_cell_writes_is_found(room):
    room.run("%%writefile written.py\nx = 3")
    cell = "import written, os, shutil\nprint(written.x)\nos.remove('written.py')\n"
    assert printed(room, cell + "shutil.rmtree('__pycache__', ignore_errors=True)") == "3"


@pytest.mark.parametrize("way", [Way.UNWALLED, Way.UNWALLED_COLD])
def test_no_file_takes_the_place_of_the_rooms_own(way, furnished):
    """Without walls its own files are beside the student's."""
    room = furnished(way)
    listed = printed(room, "import os; print(*sorted(os.listdir()))")
    assert not {"protocol", "watch.py", "forks.py", "autograder.py"} & set(listed.split())


def written(folder, sizes):
    for name, size in sizes.items():
        (folder / name).write_bytes(b"x" * size)
    return {name: folder / name for name in sizes}


def test_the_smallest_come_first(tmp_path, monkeypatch):
    monkeypatch.setattr(beside, "MOST_BYTES", 30)
    files = written(tmp_path, {"a.jpg": 25, "b.csv": 10, "c.py": 4})
    chosen = choose(files)
    assert set(chosen.laid) == {"b.csv", "c.py"}
    assert set(chosen.left_out) == {"a.jpg"}
    monkeypatch.setattr(beside, "MOST_FILES", 1)
    assert set(choose(files).laid) == {"c.py"}


def test_a_students_pictures_and_texts_are_documents(tmp_path):
    files = written(tmp_path, {"a.JPG": 1, "b.csv": 1, "c.pdf": 1, "arm.svg": 1})
    assert choose(files, own={"a.JPG", "b.csv", "c.pdf"}).documents == ("a.JPG", "c.pdf")


@pytest.mark.parametrize("name", ["autograder.py", "protocol/calls.py", "armdyn/__init__.py"])
def test_what_would_stand_for_the_graders_own_is_left_out(tmp_path, name):
    path = tmp_path / "any"
    path.write_bytes(b"")
    chosen = choose({name: path})
    assert chosen.laid == {}
    assert chosen.left_out == {name: "the grader has a module of this name"}


BESIDE = Beside(
    {"data/run.csv": b"", "mine.py": b""},
    {"big.csv": "it is big", "pack/part.py": "it is a pack", "raw/deep.bin": "it is deep"},
)
WITHOUT = "was handed in, but the notebook is graded without it"


@pytest.mark.parametrize(
    ("error", "said"),
    [
        ("[Errno 2] No such file or directory: 'big.csv'", f"big.csv {WITHOUT}: it is big"),
        ("FileNotFoundError: big.csv not found.", f"big.csv {WITHOUT}: it is big"),
        ("[Errno 2] No such file or directory: './raw/deep.bin'",
         f"raw/deep.bin {WITHOUT}: it is deep"),
        ("ModuleNotFoundError: No module named 'pack.part'", f"pack/part.py {WITHOUT}: it is a pack"),
        ("File `'other.py'` not found.", "other.py was not handed in with the notebook"),
        ("FileNotFoundError: there is no file M.cpp. Run the cell with …",
         "M.cpp was not handed in with the notebook"),
        ("No such file or directory: 'D:\\\\ada\\\\run.csv'",
         r"data/run.csv was handed in, but the path D:\\ada\\run.csv does not lead "
         "to it from the notebook"),
        ("ModuleNotFoundError: No module named 'yours'",
         "no yours.py was handed in, and no package of this name is installed here"),
        ("ValueError: the key was not found.", ""),
        ("ZeroDivisionError: division by zero", ""),
    ],
)  # fmt: skip
def test_an_error_that_names_a_file_is_explained(error, said):
    assert BESIDE.explanation(error) == said
    reply = Reply(fault=Fault(FaultKind.RAISED, error, "line 1"))
    told = BESIDE.explained(reply)
    assert told.fault.message == (f"{error.rstrip('.')} ({said})" if said else error)
    assert (told.fault.kind, told.fault.line) == (FaultKind.RAISED, "line 1")


def test_a_reply_with_numbers_stays_as_it_is():
    reply = Reply(value=[1.0])
    assert BESIDE.explained(reply) is reply


def test_other_files_have_another_digest():
    several = [Beside(), Beside({"a": b"b"}), Beside({"a": b"c"}), Beside({"ab": b""}),
               Beside({}, {"a": "b"}), Beside(documents=("a",))]  # fmt: skip
    assert len({files.digest() for files in several}) == len(several)
    assert Beside({"a": b"", "b": b""}).digest() == Beside({"b": b"", "a": b""}).digest()
