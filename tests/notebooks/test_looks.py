"""The problems' own cells that use the student's functions: whatever those do, Run All goes on.

Each problem is run from top to bottom in this process, with answers of its solution and wrong ones.
"""

import contextlib
import io
import re
import textwrap
from functools import cache
from pathlib import Path

import matplotlib.pyplot as plt
import nbformat
import numpy as np
import pytest

from autograder.problems import CHECKS
from autograder.protocol import Look, TimeLimitError
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from autograder.student import look
from autograder.student.cell import NotCorrectError

ROOT = Path(__file__).parents[2]
NAMES = sorted(path.stem for path in (ROOT / "solutions").glob("*/*.ipynb"))
# What students' functions do that give no numbers, and how the line names it.
UNUSABLE = "This cell cannot use what {name} returns: see the card of {id}."
WRONG = {
    "untouched": ("raise NotImplementedError", "Write {name} first, then run this cell again."),
    "a name of nothing": ("return cos(1.0)", "{name} raises NameError: see the card of {id}."),
    "an operator": ("return np.cos(np)", "{name} raises TypeError: see the card of {id}."),
    "leaving": ("raise SystemExit", "{name} raises SystemExit: see the card of {id}."),
    "printing": ("print('its value')", UNUSABLE),
    "a text": ("return 'a text'", UNUSABLE),
    "no shape": ("return [[1.0], [2.0, 3.0]]", UNUSABLE),
    "no function": ("", "The notebook does not define {name}: see the card of {id}."),
}
LINE = re.compile(
    r"Write (\w+) first, then run this cell again\."
    r"|(\w+) raises \w+: see the card of [\w-]+\."
    r"|The notebook does not define (\w+): see the card of [\w-]+\."
    r"|This cell cannot use what (\w+) returns: see the card of [\w-]+\."
)


@cache
def cells(problem: str) -> list[tuple[str, str, object]]:
    """(grade_id, source, compiled) of the code cells that students get, with the solution in them."""
    notebook = nbformat.read(ROOT / "solutions" / problem / f"{problem}.ipynb", as_version=4)
    found = []
    for cell in notebook.cells:
        if cell.cell_type == "code":
            source = re.sub(r"### BEGIN HIDDEN TESTS.*?### END HIDDEN TESTS", "", cell.source,
                            flags=re.DOTALL)  # fmt: skip
            name = cell.metadata.nbgrader.grade_id
            found.append((name, source, compile(source, f"{problem}:{name}", "exec")))
    return found


@cache
def ids(problem: str) -> list[str]:
    return [name for name, _, _ in cells(problem) if name in CHECKS]


def looked_at(source: str) -> list[str]:
    """The ids that a cell looks at."""
    called = re.search(r"^with look_at\((.*?)\)", source, re.MULTILINE)
    return re.findall(r'"([\w-]+)"', called[1]) if called else []


@pytest.fixture
def run(monkeypatch):
    """Runs a problem from top to bottom; gives what each cell printed, and the checks that ran."""
    monkeypatch.setattr(plt, "show", lambda: plt.close("all"))  # as the inline backend does
    monkeypatch.setattr(look, "SECONDS", 60.0)

    def go(problem: str, wrong: dict[str, str], checking) -> dict[str, str]:
        namespace = {"__name__": "__main__"}
        printed = {}
        for name, _, compiled in cells(problem):
            with contextlib.redirect_stdout(io.StringIO()) as out:
                if name.startswith("answer-") and name.removeprefix("answer-") in wrong:
                    exec(wrong[name.removeprefix("answer-")], namespace)
                elif name in CHECKS:
                    checking(name, namespace)
                else:
                    exec(compiled, namespace)
            printed[name] = out.getvalue()
            assert plt.get_fignums() == [], f"{name} leaves a figure open"
        return printed

    yield go
    plt.close("all")


def unchecked(name: str, namespace: dict) -> None:
    """Print that the check ran; what it says is the business of its own tests."""
    print(f"{name} ran")


def checked(name: str, namespace: dict) -> None:
    """The check's cell as it stands: an error goes no further there, as it is tagged."""
    with contextlib.suppress(NotCorrectError):
        exec(f"check({name!r})", namespace)


def function(id: str, body: str) -> str:
    return f"def {CHECKS[id].signature}:\n{textwrap.indent(body, '    ')}\n" if body else ""


@pytest.mark.parametrize("problem", NAMES)
def test_a_solution_needs_no_look(problem, run, monkeypatch):
    # nbval sees no line that is printed: here an error in a look is one.
    monkeypatch.setattr(Look, "__exit__", lambda self, *error: self._limit.close())
    printed = run(problem, {}, unchecked)
    looks = [name for name, source, _ in cells(problem) if looked_at(source)]
    assert looks
    assert all(
        printed[name] or "draw" in dict(c[:2] for c in cells(problem))[name] for name in looks
    )


@pytest.mark.parametrize("problem", NAMES)
def test_every_look_is_one(problem):
    """No cell of a problem uses a function of the student's outside a look."""
    functions = {CHECKS[id].name for id in ids(problem)}
    for name, source, _ in cells(problem):
        assert "NotImplementedError" not in source, name
        if name in CHECKS or name.startswith("answer-"):
            continue
        # What stands at the margin runs; the bodies of functions run when they are called.
        margin = "\n".join(line for line in source.splitlines() if re.match(r"[^\s#@]", line))
        used = functions & set(re.findall(r"\b(\w+)\(", margin)) - set(
            re.findall(r"^def (\w+)", source, re.MULTILINE)
        )
        assert not used, f"{name} calls {used} outside a look"


@pytest.mark.parametrize("kind", WRONG)
@pytest.mark.parametrize("problem", NAMES)
def test_whatever_all_functions_do_every_check_says_something(problem, kind, run):
    body, _ = WRONG[kind]
    wrong = {CHECKS[id].name: function(id, body) for id in ids(problem)}
    printed = run(problem, wrong, checked)
    for id in ids(problem):
        assert re.search(rf"(?m)^{id}: (not attempted|error in your code)$", printed[id])
    for name, source, _ in cells(problem):
        asked = looked_at(source)
        if asked:
            said = LINE.findall(printed[name])
            assert len(said) <= 1, printed[name]
            assert not said or "".join(said[0]) in {CHECKS[id].name for id in asked}


@pytest.mark.parametrize("id", [id for problem in NAMES for id in ids(problem)])
def test_the_function_that_is_at_fault_is_named(id, run):
    problem = next(problem for problem in NAMES if id in ids(problem))
    name = CHECKS[id].name
    expected = {"name": name, "id": id}
    for kind, (body, said) in WRONG.items():
        printed = run(problem, {name: function(id, body)}, unchecked)
        for cell, source, _ in cells(problem):
            lines = [line for line in printed[cell].splitlines() if LINE.fullmatch(line)]
            assert lines == ([said.format(**expected)] if id in looked_at(source) else []), kind


@pytest.fixture
def look_in(monkeypatch):
    """Runs a block under `look_at` in a notebook's namespace; gives what it printed."""

    def go(ids: str, functions: str, block: str) -> str:
        namespace = {"__name__": "__main__", "np": np, "plt": plt, "look_at": look.look_at}
        exec(functions, namespace)
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(f"with look_at({ids}):\n{textwrap.indent(block, '    ')}", namespace)
        return out.getvalue()

    yield go
    plt.close("all")


RIGHT_C = "def C(q, qd, pend):\n    return 0.0\n"
RIGHT_M = "def M(q, pend):\n    return pend.I\n"


def test_a_callee_is_named_and_not_its_caller(look_in):
    # rk4_step adds what f returned: the error is raised there, and f is to blame.
    functions = "def f(x, u, arm): pass\ndef rk4_step(f, x, u, dt):\n    return x + dt * f(x, u)"
    said = look_in("'p5-f', 'p5-rk4_step'", functions, "rk4_step(lambda x, u: f(x, u, 0), 1, 2, 3)")
    assert said == "This cell cannot use what f returns: see the card of p5-f.\n"


def test_a_function_of_the_students_own_is_named_by_the_one_that_called_it(look_in):
    functions = "def part():\n    raise NotImplementedError\ndef M(q, pend):\n    return part()"
    assert look_in("'p3-M'", functions, "M(0, 0)").startswith("Write M first, ")


@pytest.mark.parametrize(
    "written",
    [
        "M = lambda q, pend: cos(q)",
        "class Inertia:\n    def __call__(self, q, pend):\n        return cos(q)\nM = Inertia()",
        "import functools\n@functools.cache\ndef M(q, pend):\n    return cos(q)",
    ],
)
def test_however_a_function_is_written_it_is_named(look_in, written):
    assert look_in("'p3-M'", written, "M(0, 0)") == "M raises NameError: see the card of p3-M.\n"


def test_a_wrong_answer_that_ends_the_cell_is_named_before_a_right_one(look_in):
    functions = RIGHT_C + "def M(q, pend):\n    return [1.0, 2.0, 3.0]\n"
    said = look_in("'p3-C', 'p3-M'", functions, "np.reshape(M(0, 0), 1)")
    assert said == "This cell cannot use what M returns: see the card of p3-M.\n"


def test_right_answers_get_no_blame_where_the_cell_fails_all_the_same(look_in):
    said = look_in("'p3-M'", RIGHT_M, "M(0, None)")
    assert said == "M raises AttributeError: 'NoneType' object has no attribute 'I'\n"
    assert look_in("'p3-M'", RIGHT_M, "1 / 0") == (
        "This cell raises ZeroDivisionError: division by zero\n"
    )
    said = look_in("'p3-M'", RIGHT_M, "bool(np.ones(2))")
    assert said.startswith("This cell raises ValueError: The truth value of an array")
    assert "a.all(). A condition needs one True or False, and this one is an array" in said


def test_figures_of_a_failing_look_are_closed_and_no_others(look_in):
    plt.figure(7)
    block = "plt.figure(8)\nplt.plot([M(0, 0)])"
    look_in("'p3-M'", "def M(q, pend):\n    return cos(q)", block)
    assert plt.get_fignums() == [7]
    look_in("'p3-M'", "def M(q, pend):\n    return 1", block)
    assert plt.get_fignums() == [7, 8]


def test_an_interrupt_goes_through(look_in):
    with pytest.raises(KeyboardInterrupt):
        look_in("'p3-M'", RIGHT_M, "plt.figure()\nraise KeyboardInterrupt")
    assert plt.get_fignums() == []


def test_a_function_that_never_returns_is_stopped_and_named(look_in, monkeypatch):
    monkeypatch.setattr(look, "SECONDS", 0.2)
    endless = "import time\ndef M(q, pend):\n    while q == 0:\n        time.sleep(0.01)"
    assert look_in("'p3-M'", endless, "M(0, 0)") == (
        "M did not end within 0.2 s: see the card of p3-M.\n"
    )


def test_the_limit_of_a_whole_cell_is_not_the_looks(monkeypatch):
    with pytest.raises(TimeLimitError), Look(("p3-M",), {}):
        raise TimeLimitError(2.0, starved=False)


def test_an_unknown_id_is_refused(look_in):
    with pytest.raises(ValueError, match="did you mean 'p3-M'"):
        look_in("'p3-Mm'", RIGHT_M, "M(0, 0)")


FEEDBACK = """
from autograder import look_at
import matplotlib.pyplot as plt
def f(x): pass
def rk4_step(x): return x + f(x)
def M(): raise NotImplementedError
with look_at("p5-f", "p5-rk4_step"):
    plt.plot([rk4_step(1)])
with look_at("p5-f", "p5-rk4_step"):
    1 + f(1)
with look_at("p1-M"):
    M()
with look_at("p1-C"):
    C()
"""


def test_a_feedback_page_gets_the_line_too():
    with Room(Way.UNWALLED) as room:
        (printed,) = room.run(FEEDBACK)
    assert printed["text"].splitlines() == [
        "rk4_step raises TypeError: see the cards of p5-f and p5-rk4_step.",
        "This cell raises TypeError: unsupported operand type(s) for +: 'int' and 'NoneType':"
        " see the cards of p5-f and p5-rk4_step.",
        "Write M first, then run this cell again.",
        "The notebook does not define C: see the card of p1-C.",
    ]
