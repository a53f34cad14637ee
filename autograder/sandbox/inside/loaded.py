"""Loads what notebooks import, once, in a process whose forks become rooms."""

import gc
import io
import os
import sys


def load(shell) -> None:
    """Load what notebooks import, and what is loaded with the first figure, the first call of SymPy's
    `simplify` and the first error that the shell shows.

    RuntimeError if that started a thread.
    """
    import beside  # noqa: F401
    import matplotlib.pyplot
    import numpy.linalg
    import protocol  # noqa: F401
    import runner  # noqa: F401
    import sympy
    from matplotlib.figure import Figure
    from matplotlib_inline import backend_inline  # noqa: F401

    figure = Figure()
    figure.subplots().set(title="$q$", xlabel="t")
    figure.savefig(io.BytesIO())
    matplotlib.pyplot.switch_backend(os.environ["MPLBACKEND"])
    q = sympy.Symbol("q", real=True)
    # These import on first use; only of a sum or a product does SymPy ask whether it holds units.
    matrix = sympy.simplify(sympy.Matrix([[q - sympy.sin(q) * sympy.cos(q)]]).diff(q))
    for modules in (None, "numpy"):  # a student's own, and the protocol's
        sympy.lambdify(q, matrix, modules)
    sympy.core.cache.clear_cache()
    # Each process draws this number, and dummy symbols sort by it.
    sympy.Dummy._base_dummy_index = 10_000_000
    numpy.linalg.solve([[1.0]], [1.0])
    _show_error(shell)
    if len(os.listdir("/proc/self/task")) > 1:
        raise RuntimeError("a thread was started; a fork of this process would lack it")
    gc.collect()
    gc.freeze()  # a collection in a room would copy every page it looks at


def _show_error(shell) -> None:
    """Have a traceback laid out, for which Python looks up the file of every module once."""
    try:
        raise RuntimeError
    except RuntimeError:
        shell.InteractiveTB.structured_traceback(*sys.exc_info())
    shell.InteractiveTB.tb = None
