"""The room takes what JupyterLab's kernel takes; what cannot work there is left out, and no more."""

import base64
import json
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

from autograder.judging.verdict import State
from autograder.notebook.grade import stream
from autograder.problems import CHECKS
from autograder.protocol import PATIENCE, Call
from autograder.sandbox.inside.left_out import (
    INPUT,
    INSTALLS,
    NO_KERNEL,
    NOBODY,
    NOT_FIRST,
    UNKNOWN,
)
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.sandbox.rooms import failed, printed
from tests.submissions.p3_pendulum import RIGHT

KERNELS_MAGICS = """
import json
from ipykernel.kernelapp import IPKernelApp
from ipykernel.zmqshell import ZMQInteractiveShell
shell = ZMQInteractiveShell()
for extension in IPKernelApp().default_extensions:
    shell.extension_manager.load_extension(extension)
print(json.dumps({kind: sorted(magics) for kind, magics in shell.magics_manager.lsmagic().items()}))
"""
# Lines that say more than a name, where the name alone would only be refused.
MORE_LINES = """
%alias_magic t timeit
%cd /tmp
%config InlineBackend.figure_formats = ['svg', 'retina']
%config InteractiveShell.ast_node_interactivity = "all"
%env MODE=1
%gui qt
%load_ext autoreload
%load_ext line_profiler
%lprun -f M M(1, 2)
%matplotlib --list
%pip install pandas
%precision 3
%prun -q sum(range(9))
%pinfo print
%qtconsole --style default
%reset -f
%run other.py
%store -r data
%store line
%time sum(range(9))
%time undefined_name
%timeit -n1 -r1 sum(range(9))
%writefile M.py
%xmode Plain
!pip install pandas
!{sys.executable} -m pip install pandas
!conda install pandas -y
!no-such-program
!ls
!sleep 60 &
found = !ls
found = %conda list
print?
get_ipython().system("pip install pandas")
get_ipython().run_line_magic("matplotlib", "inline")
get_ipython().run_line_magic("no_such_magic", "")
for _ in range(2): get_ipython().run_line_magic("no_such_magic", "")
exit()
quit
breakpoint()
import pdb; pdb.set_trace()
""".strip().splitlines()
BACKENDS = """
%matplotlib
%matplotlib inline
%matplotlib agg
%matplotlib ipympl
%matplotlib notebook
%matplotlib qt
%matplotlib svg
%matplotlib tk
%matplotlib widget
%pylab
%pylab inline
%pylab tk
%gui tk
%config InlineBackend.figure_format = 'svg'
%config InlineBackend.print_figure_kwargs = {'format': 'svg'}
from matplotlib_inline.backend_inline import set_matplotlib_formats; set_matplotlib_formats('jpeg')
get_ipython().run_line_magic("matplotlib", "inline")
get_ipython().enable_matplotlib("qt")
import matplotlib; matplotlib.use("TkAgg")
import matplotlib; matplotlib.use("Agg", force=True)
import matplotlib; matplotlib.use("Qt4Agg")
import matplotlib; matplotlib.rcParams["backend"] = "QtAgg"
import matplotlib.pyplot as plt; plt.switch_backend("TkAgg")
import matplotlib.pyplot as plt; plt.switch_backend("module://ipympl.backend_nbagg")
import matplotlib.pyplot as plt; plt.rcParams.update({"backend": "webagg"})
import matplotlib.pyplot as plt; plt.ion()
import matplotlib.pyplot as plt; plt.rcdefaults()
""".strip().splitlines()
# They would time it millions of times, and load nbformat.
SLOW_WITH_ONE = ("timeit", "notebook")
# Without what takes its time to draw.
DRAWN_LATER = "fig, ax = plt.subplots(figsize=(1, 1))\nax.set_axis_off()\nline = ax.plot([0, 1])\n"
DRAWN = f"import matplotlib.pyplot as plt\n{DRAWN_LATER}plt.show()\n"


@cache
def kernels_magics() -> dict[str, list[str]]:
    """The names of the line magics and of the cell magics that a kernel has."""
    command = [sys.executable, "-I", "-c", KERNELS_MAGICS]
    return json.loads(subprocess.run(command, capture_output=True, check=True).stdout)


BOTH = [Way.WARM, Way.UNWALLED]
WAYS = pytest.mark.parametrize("way", BOTH, indirect=True, ids=lambda way: way.name)


@pytest.fixture(scope="module", params=BOTH, ids=lambda way: way.name)
def own_room(request, needs):
    """A room for lines that change the shell for good."""
    if request.param.walled:
        needs("bubblewrap")
    with Room(request.param) as room:
        room.run("import numpy as np, sympy as sp, sys")
        yield room


def verdict(room):
    return CHECKS["p3-M"].run(room.ask, stream("seed", "p3-M"), 2)


def judged_below(room, line: str) -> list[dict]:
    """The outputs of the line, with a right answer below it in the cell: the answer must be right."""
    room.run("M = None")
    outputs = room.run(f"{line}\n{RIGHT['M'].strip()}")
    assert verdict(room).state is State.CORRECT, (line, outputs)
    assert not [out for out in outputs if out.get("stopped")], (line, outputs)
    return outputs


def pictures(outputs) -> list[bytes]:
    shown = [out["data"]["image/png"] for out in outputs if "image/png" in out.get("data", {})]
    return [base64.b64decode(picture) for picture in shown]


def left_out(outputs) -> list[str]:
    return [output["left_out"] for output in outputs if "left_out" in output]


def test_a_right_answer_is_right_below_each_line_magic_of_the_kernel(own_room):
    magics = kernels_magics()["line"]
    assert len(magics) > 90
    assert {"autosave", "clear", "connect_info", "matplotlib", "pylab", "store"} <= set(magics)
    for name in magics:
        judged_below(own_room, f"%{name}")
        if name not in SLOW_WITH_ONE:
            judged_below(own_room, f"%{name} 1")


def test_a_right_answer_is_right_below_each_cell_magic_of_the_kernel(own_room):
    magics = kernels_magics()["cell"]
    assert {"bash", "capture", "time", "writefile"} <= set(magics)
    for name in magics:
        own_room.run(f"%%{name} x\nprint(1)\n__code__")
        judged_below(own_room, "")
    own_room.run("%code_wrap --remove x")
    for name in ("time", "capture", "capture out", "no_such_magic", "debug", "cython -a"):
        own_room.run("M = None")
        own_room.run(f"%%{name}\n{RIGHT['M'].strip()}")
        assert verdict(own_room).state is State.CORRECT, name


@pytest.mark.parametrize("line", MORE_LINES)
def test_a_right_answer_is_right_below_any_line(own_room, line):
    judged_below(own_room, line)


@pytest.mark.parametrize("line", BACKENDS)
def test_figures_are_pictures_with_any_backend(own_room, line):
    outputs = judged_below(own_room, f"{line}\n{DRAWN}")
    (picture,) = pictures(outputs)
    assert picture.startswith(b"\x89PNG")
    assert "Warning" not in str(outputs)  # as of a second toolkit beside the first
    # The next cell's, too, without a word to show it.
    assert len(pictures(own_room.run(DRAWN_LATER))) == 1


@WAYS
@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("%pip install pandas", INSTALLS),
        ("!pip3 install pandas", INSTALLS),
        ("!cd .. && python -m pip install x", INSTALLS),
        ("%conda install pandas", INSTALLS),
        ("%%timeit M(1, 2)", NOT_FIRST),
        ("%no_such_magic 1", UNKNOWN),
        ("%qtconsole", NO_KERNEL),
        ("%debug", f"it asks for commands, and {NOBODY}"),
        ("%load_ext no_such_extension", "ModuleNotFoundError: No module named 'no_such_extension'"),
        ("%run no_such_file.py", "Exception: File `'no_such_file.py'` not found"),
        ("%matplotlib inline # figures", "unrecognized arguments"),
        ("%autosave often", None),
        ("!echo pip install", None),
        ("%clear", None),
    ],
)
def test_what_cannot_work_is_left_out_with_a_sentence(room, line, said):
    outputs = judged_below(room, f"\nx = 1\n{line}")
    if said is None:
        assert left_out(outputs) == []
        return
    (sentence,) = left_out(outputs)
    assert sentence.startswith(f"{line} was left out: {said}")
    (shown,) = outputs
    assert (shown["name"], shown["text"]) == ("stderr", f"{sentence}\n")


@WAYS
def test_below_an_unknown_cell_magic_what_is_python_runs(room):
    (shown, told) = room.run("%%no_such_magic -a\nprint('ran')")
    assert shown["text"] == "ran\n"
    assert left_out([told]) == [f"%%no_such_magic -a was left out: {UNKNOWN}"]
    assert left_out(room.run("%%no_such_magic\nfunction (x) { return 1 }"))
    assert failed(room, "%%no_such_magic\n1 / 0").startswith("ZeroDivisionError")


@WAYS
@pytest.mark.parametrize(
    ("source", "error", "at", "line", "stopped"),
    [
        ("x = 1\n\ny = undefined", "NameError", 3, "line 3: y = undefined", True),
        ("def f():\n    return 1 / 0\nf()", "ZeroDivisionError", 3, "line 2: return 1 / 0", True),
        ("x = 1\nif x", "SyntaxError", 0, "", True),
        ("%%time\nx = 1\ny = undefined", "NameError", 3, "line 3: y = undefined", True),
        ("%%capture\nx = 1\ny = undefined", "NameError", 3, "line 3: y = undefined", True),
        ("x = 1\n%time undefined\nx", "NameError", 0, "", False),
        ("await undefined()", "NameError", 1, "line 1: await undefined()", True),
        ("while True:\n    pass", "TimeoutError", 2, "line 2: pass", True),
    ],
)
def test_an_error_says_where_it_stopped_the_cell(room, source, error, at, line, stopped):
    *_, told = room.run(source, 0.3)
    if error != "TimeoutError":
        assert (told["at"], told["line"]) == (at, line)
    assert (told["ename"], told["stopped"]) == (error, stopped)


@WAYS
def test_an_error_that_is_shown_does_not_hide_the_one_that_stops_the_cell(room):
    *_, shown, stopping = room.run("%time undefined\n1 / 0")
    assert (shown["ename"], shown["stopped"]) == ("NameError", False)
    assert (stopping["ename"], stopping["stopped"]) == ("ZeroDivisionError", True)


@WAYS
class TestKernel:
    """What people use of a kernel in their cells."""

    def test_top_level_await(self, room):
        source = "import asyncio\nawait asyncio.sleep(0)\n"
        assert printed(room, f"{source}print(await asyncio.sleep(0, 5))") == "5"

    def test_a_task_goes_on_from_cell_to_cell(self, room):
        assert room.run("import asyncio\ntask = asyncio.create_task(asyncio.sleep(0.01, 7))") == []
        assert (
            printed(room, "print(await task, asyncio.get_running_loop().is_running())") == "7 True"
        )

    def test_an_await_without_end_costs_its_limit_and_no_later_cell(self, room):
        source = "import asyncio\nawait asyncio.sleep(0.8)\nwent_on = True"
        assert failed(room, source, 0.5 / PATIENCE).startswith("TimeoutError")
        later = "await asyncio.sleep(0.6)\nprint('went_on' in globals())"
        assert printed(room, later) == "False"

    def test_a_loop_that_a_call_closed_is_made_again(self, room):
        room.run("import asyncio\ndef f():\n    asyncio.get_event_loop().close()\n    return 1")
        assert room.ask([Call("f", ())])[0].value == 1
        assert printed(room, "print(await asyncio.sleep(0, 9))") == "9"

    def test_the_error_state_of_numpy_lasts(self, room):
        try:
            room.run("import numpy as np\nnp.seterr(divide='raise')")
            assert printed(room, "print(np.geterr()['divide'])") == "raise"
        finally:
            room.run("np.seterr(divide='warn')")

    def test_last_values_are_kept(self, room):
        (value,) = room.run("6 * 7")
        assert value["data"] == {"text/plain": "42"}
        assert printed(room, "print(_ + 1, Out[max(Out)], len(In) == len(_ih))") == "43 42 True"
        assert room.run("6 * 7;") == []

    def test_formulas_are_shown_as_formulas(self, room):
        (value,) = room.run("import sympy\nsympy.Symbol('q') ** 2")
        assert value["data"] == {"text/plain": "q**2", "text/latex": "$\\displaystyle q^{2}$"}

    def test_displays_are_updated_and_cleared(self, room):
        shown = room.run("h = display(1, display_id=True)\ndisplay(2)\nh.update(3)")
        assert [output["data"]["text/plain"] for output in shown] == ["3", "2"]
        clear = "from IPython.display import clear_output\nprint('old'); display(1)\n"
        (kept,) = room.run(f"{clear}clear_output()\nprint('new')")
        assert kept["text"] == "new\n"
        (kept,) = room.run(
            f"{clear}for k in range(100):\n    clear_output(wait=True)\n    display(k)"
        )
        assert kept["data"]["text/plain"] == "99"

    def test_widgets_are_made_and_their_functions_called(self, room):
        source = (
            "import ipywidgets\n"
            "calls = []\n"
            "ipywidgets.interact(lambda k: calls.append(k), k=3)\n"
            "with ipywidgets.Output(): pass\n"
        )
        room.run(source)
        assert printed(room, "print(calls)") == "[3]"

    def test_commands_of_the_shell(self, room):
        assert printed(room, "!echo hello\nprint(_exit_code)") == "hello\n0"
        assert printed(room, "word = 'a b'\nlines = !echo {word}; echo c\nprint(lines)") == (
            "['a b', 'c']"
        )
        assert printed(room, "%%bash\necho from bash") == "from bash"

    def test_a_value_can_be_stored(self, room):
        assert printed(room, "kept = 5\n%store kept") == "Stored 'kept' (int)"
        assert printed(room, "del kept\n%store -r kept\nprint(kept)") == "5"

    @pytest.mark.parametrize("ask", ["input('m = ')", "__import__('getpass').getpass()"])
    def test_what_asks_a_person_says_so(self, room, ask):
        assert failed(room, f"x = {ask}") == f"RuntimeError: {INPUT}"


@WAYS
def test_no_network_is_said_to_be_the_reason(room):
    if not room.way.walled:
        source = "import socket\ntry:\n    raise socket.gaierror(-3, 'no')\nexcept OSError as e:\n"
        source += "    raise RuntimeError('offline') from e"
    else:
        source = "import urllib.request\nurllib.request.urlopen('http://example.org')"
    assert failed(room, source).endswith("(the grader has no network)")


@WAYS
def test_a_line_that_is_left_out_is_cut_to_a_decent_length(room):
    again = "for _ in range(200):\n    get_ipython().run_line_magic('no_such_magic', 'x')"
    outputs = room.run(f"%no_such_magic {'x' * 10**5}\n{again}")
    said = left_out(outputs)
    assert len(said) == 50
    assert max(map(len, said)) <= 500


@WAYS
def test_calls_see_what_cells_set(room):
    room.run("import decimal\ndecimal.getcontext().prec = 5")
    room.run(f"{RIGHT['M'].strip()}\ndef digits(): return decimal.getcontext().prec")
    np.testing.assert_equal(room.ask([Call("digits", ())])[0].value, 5.0)
