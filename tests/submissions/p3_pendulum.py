"""Submissions to p3-pendulum, made from the released notebook by editing it as a student would."""

import copy

from tests.submissions.answers import Answers, answered, blank, cell_of

RIGHT = Answers(
    {
        "lagrangian": """
def lagrangian(q, qd, m, lc, I, g):
    return I * qd**2 / 2 + m * g * lc * sp.cos(q)
""",
        "M": """
def M(q, pend):
    return [[pend.I]]
""",
        "C": """
def C(q, qd, pend):
    return 0
""",
        "g_vec": """
def g_vec(q, pend):
    return np.array([pend.m * pend.g * pend.lc * np.sin(q[0])])
""",
        "inertia_about_pivot": """
def inertia_about_pivot(I_com, m, lc):
    return I_com + m * lc * lc
""",
        "small_angle_frequency": """
def small_angle_frequency(pend):
    return (pend.m * pend.g * pend.lc / pend.I) ** 0.5
""",
    }
)
POINTS = {
    "p3-lagrangian": 3.0,
    "p3-M": 1.0,
    "p3-C": 1.0,
    "p3-g_vec": 2.0,
    "p3-inertia_about_pivot": 1.0,
    "p3-small_angle_frequency": 2.0,
}

function, right_but = RIGHT.function, RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "p3-derivation").source = "K = ½ I q̇², P = m g ℓc (1 − cos q), ..."
    return notebook


def wrong(release):
    """Six mistakes, one a cell."""
    return answered(
        release,
        lagrangian=function("lagrangian", "I * qd**2 + m * g * lc * sp.sin(q)"),
        M=function("M", "[[pend.I + pend.m * pend.lc**2]]"),
        C=function("C", "[[pend.m * pend.lc * qd[0]]]"),
        g_vec=function("g_vec", "pend.m * pend.g * pend.lc * np.cos(q)"),
        inertia_about_pivot=function("inertia_about_pivot", "I_com"),
        small_angle_frequency=function("small_angle_frequency", "np.sqrt(pend.g / pend.lc)"),
    )


def partly_right(release):
    """The Lagrangian half right, gravity with the cosine for the sine, the rest right."""
    return right_but(
        release,
        lagrangian=function("lagrangian", "I * qd**2 / 2 + m * g * lc * (1 - sp.cos(q))"),
        g_vec=function("g_vec", "pend.m * pend.g * pend.lc * np.cos(q)"),
    )


def crashing(release):
    """M ends Python when called, the cell of g_vec ends it when run, C raises."""
    return right_but(
        release,
        M="import os\n" + function("M", "os._exit(1)"),
        g_vec="import os\nos._exit(1)\n" + RIGHT["g_vec"],
        C=function("C", "pend.J * qd"),
    )


def mangled(release):
    """Copied, deleted, retyped and re-pointed cells, around answers that are right."""
    notebook = right_but(release)
    cells = notebook.cells
    cells.insert(0, copy.deepcopy(cell_of(notebook, "p3-M")))
    cells.insert(3, copy.deepcopy(cell_of(notebook, "answer-M")))
    cells[3].source = function("M", "0")
    cells.remove(cell_of(notebook, "p3-g_vec"))
    cell_of(notebook, "p3-C").metadata["nbgrader"]["points"] = 100
    retyped = cell_of(notebook, "p3-lagrangian")
    retyped.cell_type = "markdown"
    del retyped["outputs"], retyped["execution_count"]
    cell_of(notebook, "p3-inertia_about_pivot").source = "pass"
    # The answer's cell has lost its identity, but its code still runs.
    cell_of(notebook, "answer-small_angle_frequency").metadata.pop("nbgrader")
    return notebook


# Each fault in g_vec: what stands in the cell, and a sentence of the verdict. All other answers right.
BAD_ANSWERS = {
    "syntax_error": (
        "def g_vec(q, pend)\n    return 0",
        "the cell that should define it stopped with SyntaxError: expected ':', line 1",
    ),
    "missing": ("pass", "The notebook does not define g_vec."),
    "renamed": ("def g_vector(q, pend):\n    return 0 * q", "Did you mean g_vector?"),
    "returns_none": (
        "def g_vec(q, pend):\n    pend.m * pend.g * pend.lc * np.sin(q)",
        "g_vec(q, pend) returned None. Is the return statement missing?",
    ),
    "returns_string": (
        function("g_vec", "'m g lc sin q'"),
        "g_vec(q, pend) returned the text 'm g lc sin q'; it must return numbers.",
    ),
    "wrong_shape": (
        function("g_vec", "np.zeros(3)"),
        "g_vec(q, pend) returned 3 numbers of shape (3,); it must return one number.",
    ),
    "returns_nan": (
        function("g_vec", "q * np.nan"),
        "g_vec(q, pend) returned nan, which is not a finite number.",
    ),
    "never_returns": (
        "def g_vec(q, pend):\n    while True:\n        pass",
        "g_vec(q, pend) did not return within 2 s. Is there a loop that never ends?",
    ),
    "wrong_arguments": (
        "def g_vec(q):\n    return q",
        "g_vec(q, pend) raised TypeError: g_vec() takes 1 positional argument but 2 were given",
    ),
}


# A whole class, by what each has handed in.
CLASS = {made.__name__: made for made in (right, wrong, partly_right, blank, crashing, mangled)}
