"""Loads what notebooks import, once, in a process whose forks become rooms."""

import gc
import io
import os


def load() -> None:
    """Load what notebooks import, and what is loaded with the first figure.

    RuntimeError if that started a thread.
    """
    import matplotlib.pyplot
    import numpy.linalg
    import protocol  # noqa: F401
    import sympy
    from matplotlib.figure import Figure
    from matplotlib_inline import backend_inline  # noqa: F401

    figure = Figure()
    figure.subplots().set(title="$q$", xlabel="t")
    figure.savefig(io.BytesIO())
    matplotlib.pyplot.switch_backend(os.environ["MPLBACKEND"])
    q = sympy.Symbol("q", real=True)
    matrix = sympy.simplify(sympy.Matrix([[1 - sympy.cos(q)]]).diff(q))  # these import on first use
    for modules in (None, "numpy"):  # a student's own, and the protocol's
        sympy.lambdify(q, matrix, modules)
    sympy.core.cache.clear_cache()
    # Each process draws this number, and dummy symbols sort by it.
    sympy.Dummy._base_dummy_index = 10_000_000
    numpy.linalg.solve([[1.0]], [1.0])
    if len(os.listdir("/proc/self/task")) > 1:
        raise RuntimeError("a thread was started; a fork of this process would lack it")
    gc.collect()
    gc.freeze()  # a collection in a room would copy every page it looks at
