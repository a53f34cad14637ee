"""Honest submissions to p3-pendulum in further styles of Python, and saved by other programs.

All answers are right. FILES: for each, a function from the released notebook to the bytes that such a
program writes.
"""

import json

from nbformat.v4 import new_code_cell

from tests.submissions.honest import after, variant
from tests.submissions.p3_pendulum import RIGHT, right, right_but

GRAVITY = "pend.m * pend.g * pend.lc * np.sin(q)"


@variant
def dataclasses_and_protocols(release):
    """Hints of every kind, a frozen dataclass, a protocol and a named tuple."""
    return right_but(
        release,
        g_vec="""
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol
class HasMass(Protocol):
    m: float
    g: float
    lc: float
class Weight(NamedTuple):
    newtons: float
@dataclass(frozen=True, slots=True)
class Lever:
    length: float
    notes: list[str] = field(default_factory=list)
    def torque(self, weight: Weight, q: "np.ndarray | float") -> "np.ndarray":
        return weight.newtons * self.length * np.sin(q)
def g_vec(q: np.ndarray, pend: HasMass) -> np.ndarray:
    return Lever(pend.lc).torque(Weight(pend.m * pend.g), q)
""",
    )


@variant
def lambdas(release):
    """Every function a lambda."""
    return right_but(
        release,
        M="M = lambda q, pend: np.array([[pend.I]])",
        C="C = lambda q, qd, pend, *, zero=0.0: [[zero]]",
        g_vec=f"g_vec = lambda q, pend: {GRAVITY}",
        lagrangian="lagrangian = lambda q, qd, m, lc, I, g: I*qd**2/2 - m*g*lc*(1 - sp.cos(q))",
    )


@variant
def partials(release):
    """functools.partial of a general function, and a method bound to an object."""
    return right_but(
        release,
        g_vec=f"""
from functools import partial
def torque(sign, q, pend):
    return sign * {GRAVITY}
g_vec = partial(torque, 1.0)
""",
        M="""
class Arm:
    def inertia(self, q, pend):
        return [[pend.I]]
M = Arm().inertia
""",
    )


@variant
def decorated(release):
    """Decorators of its own: one that times, one that compiles as a jit would, np.vectorize."""
    return right_but(
        release,
        g_vec=f"""
import functools, time
def timed(function):
    @functools.wraps(function)
    def inner(*args, **kwargs):
        start = time.perf_counter()
        result = function(*args, **kwargs)
        inner.seconds = time.perf_counter() - start
        return result
    return inner
def jit(nopython=True):
    def compiled(function):
        names = dict(function.__globals__)
        exec("def fast(q, pend):\\n    return {GRAVITY}", names)
        return names["fast"]
    return compiled
@timed
@jit(nopython=True)
def g_vec(q, pend):
    return {GRAVITY}
""",
        inertia_about_pivot="""
@np.vectorize
def inertia_about_pivot(I_com, m, lc):
    return I_com + m * lc**2
""",
    )


@variant
def recursive(release):
    """Recursion, a generator and a global cache."""
    return right_but(
        release,
        g_vec="""
CACHE = {}
def sine(x, depth=12):
    return x if depth == 0 else 3 * sine(x / 3, depth - 1) - 4 * sine(x / 3, depth - 1) ** 3
def remembered(x):
    if x not in CACHE:
        CACHE[x] = sine(x)
    return CACHE[x]
def torques(q, pend):
    for angle in q:
        yield pend.m * pend.g * pend.lc * remembered(float(angle))
def g_vec(q, pend):
    return list(torques(q, pend))
""",
    )


@variant
def star_imports(release):
    """`from numpy import *` in an answer, which hides built-in names."""
    return right_but(
        release,
        g_vec="from numpy import *\n" + RIGHT["g_vec"].replace("np.", ""),
        small_angle_frequency="from math import *\ndef small_angle_frequency(pend):\n"
        "    return sqrt(pend.m * pend.g * pend.lc / pend.I)",
    )


@variant
def plots_in_the_answer(release):
    """Tries the answer out below it: prints, times and draws in the answer's own cell."""
    return right_but(
        release,
        g_vec=RIGHT["g_vec"]
        + """
angles = np.linspace(-3, 3, 50)
plt.plot(angles, [g_vec(np.array([a]), forearm)[0] for a in angles])
plt.title("$g(q)$")
plt.show()
%time g_vec(np.array([0.3]), forearm)
%timeit -n 1 -r 1 g_vec(np.array([0.3]), forearm)
g_vec(np.array([0.3]), forearm)
""",
    )


@variant
def cell_magics(release):
    """`%%time` and `%%capture` above answers."""
    return right_but(
        release, M="%%time\n" + RIGHT["M"].strip(), C="%%capture said\n" + RIGHT["C"].strip()
    )


@variant
def asserts_of_its_own(release):
    """Tests its answers in cells of its own, with tolerances, and a doctest."""
    return after(
        right_but(release),
        "answer-g_vec",
        new_code_cell(
            "import doctest\nassert np.isclose(g_vec(np.zeros(1), forearm), 0)\n"
            "np.testing.assert_allclose(M(np.zeros(1), forearm), [[forearm.I]])\ndoctest.testmod()"
        ),
    )


@variant
def derived_with_mechanics(release):
    """Has SymPy's own mechanics derive g, and computes it by numbers: that is earned."""
    return right_but(
        release,
        g_vec="""
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols
_q = dynamicsymbols("q")
_m, _lc, _I, _g = sp.symbols("m lc I g")
_t = dynamicsymbols._t
_L = lagrangian(_q, _q.diff(_t), _m, _lc, _I, _g)
_motion = LagrangesMethod(_L, [_q])
_motion.form_lagranges_equations()
_torque = sp.lambdify((sp.Symbol("x"), _m, _lc, _g),
                      -_motion.forcing[0].subs(_q, sp.Symbol("x")))
def g_vec(q, pend):
    return _torque(q, pend.m, pend.lc, pend.g)
""",
    )


@variant
def differentiated_by_numbers(release):
    """Takes g from a potential energy by central differences."""
    return right_but(
        release,
        g_vec="""
def P(q, pend):
    return -pend.m * pend.g * pend.lc * np.cos(q)
def g_vec(q, pend):
    h = 1e-5
    return (P(q + h, pend) - P(q - h, pend)) / (2 * h)
""",
    )


@variant
def visual_studio_code(release):
    """Saved by VS Code: its metadata, ids of its own kind, languages per cell."""
    notebook = right_but(release)
    notebook.metadata = {
        "kernelspec": {"display_name": ".venv (3.12.3)", "language": "python", "name": "python3"},
        "language_info": {"name": "python", "version": "3.12.3", "file_extension": ".py"},
        "vscode": {"interpreter": {"hash": "31f2aee4e71d21fbe5cf8b01ff0e069b"}},
    }
    for index, cell in enumerate(notebook.cells):
        cell.metadata["vscode"] = {"languageId": "python"}
        cell.id = f"{index:08x}"
    return notebook


@variant
def colab(release):
    """Saved by Colab: its metadata, a form, a widget state, ids in the metadata, nbformat 4.0."""
    notebook = right_but(release)
    notebook.nbformat_minor = 0
    notebook.metadata = {
        "colab": {"provenance": [], "toc_visible": True, "collapsed_sections": ["x"]},
        "kernelspec": {"name": "python3", "display_name": "Python 3"},
        "language_info": {"name": "python"},
        "accelerator": "GPU",
        "widgets": {"application/vnd.jupyter.widget-state+json": {"a": {"model_name": "x"}}},
    }
    for cell in notebook.cells:
        cell.metadata["id"] = cell.pop("id")
        cell.metadata["outputId"] = "b0f0c7a5-1b1c-4e2d-d3e4-3f1f6e1c2a3b"
        cell.metadata["colab"] = {"base_uri": "https://localhost:8080/", "height": 300}
    form = 'mass = 1.8 #@param {type:"number"}\n!pip --version\n%pip --version'
    form = new_code_cell(form)
    del form["id"]
    return after(notebook, "p3-setup", form)


@variant
def windows_line_ends(release):
    """Line ends of Windows inside the cells, and tabs for indentation."""
    notebook = right_but(release, M=RIGHT["M"].replace("    ", "\t"))
    for cell in notebook.cells:
        cell.source = cell.source.replace("\n", "\r\n")
    return notebook


FILES = {}


def file(make):
    FILES[make.__name__] = make
    return make


@file
def lines_as_lists(release):
    """nbformat 4.4 as Jupyter wrote it: each line by itself, no ids, indented by one."""
    return json.dumps(_old(right(release)), indent=1).encode()


@file
def written_on_windows(release):
    """A file with line ends of Windows, letters escaped, and nothing at its end."""
    return json.dumps(right(release), indent=1).replace("\n", "\r\n").encode()


@file
def sorted_and_dense(release):
    """On one line, its keys sorted, as tools that compare notebooks leave it."""
    text = json.dumps(right(release), sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return text.encode() + b"\n\n"


def _old(notebook):
    notebook.nbformat_minor = 4
    for cell in notebook.cells:
        del cell["id"]
        cell.source = cell.source.splitlines(keepends=True)
    return notebook
