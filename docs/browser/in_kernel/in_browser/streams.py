"""What is printed: the kernel's streams lack what a file has, and Matplotlib says too much."""

import logging


def mend() -> None:
    """Let stdout and stderr say that they are open, and Matplotlib list its fonts without a warning.

    In a browser it lists them for each kernel anew.
    """
    from pyodide_kernel.display import LiteStream

    LiteStream.closed = False
    logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
