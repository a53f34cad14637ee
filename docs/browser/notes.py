"""What the notebooks say of the browser, in a cell of its own below the title."""

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell

KEPT = (
    "**In the browser.** This page runs Python in your browser, and nothing is installed. Your work is "
    "kept in this browser on this computer only: with another browser, in a private window, or when its "
    "data are deleted, it is gone."
)
DOWNLOAD = (
    "So download the notebook after each session (*File → Download*). You hand in the "
    "downloaded file, where your instructor says. **Validate** and the Assignment List are not here."
)
INTERRUPT = "A cell that never ends cannot be interrupted: choose *Kernel → Restart Kernel*."
NO_FILES = "Answers in other languages (`from_file`) need a compiler, and a browser has none."
OF = {
    "p1-inertia": NO_FILES,
    "p2-energy-skew": NO_FILES,
    "08-from-symbols-to-fast-code": "A browser has no C compiler: cells that need one say so, and the "
    "printed times were measured elsewhere.",
    "09-four-languages": "A browser runs no C++, Java, MATLAB or Wolfram: cells that need them say so, "
    "and the printed results were computed elsewhere.",
}


def add(notebook: NotebookNode, name: str) -> None:
    """Put the note below the notebook's title.

    name: of the notebook, without its ending; a lesson's begins with its number.
    """
    said = [KEPT, INTERRUPT] if name[0].isdigit() else [KEPT, DOWNLOAD, INTERRUPT]
    said += [OF[name]] if name in OF else []
    cell = new_markdown_cell("> " + "\n> ".join(said), id="in-the-browser")
    notebook.cells.insert(1, cell)
