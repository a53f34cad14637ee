"""Shows figures as pictures in the cell's outputs, whatever backend a notebook asks for."""

import os
import sys

INLINE = "module://matplotlib_inline.backend_inline"


def only_pictures():
    """Let matplotlib draw with its inline backend alone, and IPython show figures as PNG alone.

    A notebook may name any backend, such as one with windows that a student has at home; its figures
    are drawn all the same.
    """
    os.environ["MPLBACKEND"] = INLINE
    import matplotlib
    from IPython.core import pylabtools
    from matplotlib import rcsetup
    from matplotlib.backends.registry import backend_registry

    load, select = backend_registry.load_backend_module, pylabtools.select_figure_formats

    def inline(backend):
        return INLINE

    # setattr, as these are others' own functions.
    setattr(backend_registry, "load_backend_module", lambda backend: load(INLINE))  # noqa: B010
    setattr(rcsetup, "validate_backend", inline)  # noqa: B010
    matplotlib.RcParams.validate["backend"] = inline
    matplotlib.rcParams["backend"] = INLINE

    def select_png(shell, formats, **options):
        options.pop("format", None)  # of the file, whatever the output says that it is
        select(shell, {"png"}, **options)

    pylabtools.select_figure_formats = select_png


def show_rest():
    """Show the figures that a cell drew and did not show, as the kernel does at its end."""
    if "matplotlib.pyplot" in sys.modules:
        from matplotlib_inline.backend_inline import flush_figures

        flush_figures()
