"""Run notebooks from top to bottom and store their outputs, as `make lessons` does.

    python tests/notebooks/store_outputs.py lessons/*.ipynb

What would only be true of this run (timing, widget states, versions) is not stored; how long it took
is printed, with the slowest cell. A notebook that raises is left as it was, and the error is shown.
"""

import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
IN_PLACE_OF_A_CONTROL = "The control appears here when this cell runs in JupyterLab."


def store_outputs(path: Path) -> dict[str, float]:
    """Run the notebook in its own folder; the seconds that each of its code cells took.

    Raises nbclient's CellExecutionError where a cell does.
    """
    notebook = nbformat.read(path, as_version=4)
    resources = {"metadata": {"path": str(path.parent)}}
    began, seconds = {}, {}

    def start(cell, cell_index):
        began[cell.id] = time.perf_counter()

    def end(cell, cell_index, execute_reply):
        seconds[cell.id] = time.perf_counter() - began[cell.id]

    NotebookClient(
        notebook,
        resources=resources,
        record_timing=False,
        on_cell_execute=start,
        on_cell_executed=end,
    ).execute()
    notebook.metadata.pop("widgets", None)
    notebook.metadata.language_info = {"name": "python"}
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            # A stored view has no kernel behind it: a sentence stands in its place.
            if output.get("data", {}).pop(WIDGET_VIEW, None):
                output.data["text/plain"] = IN_PLACE_OF_A_CONTROL
    path.write_text(nbformat.writes(notebook) + "\n", encoding="utf-8")
    return seconds


def main(paths: list[str]) -> None:
    for path in paths:
        seconds = store_outputs(Path(path))
        slowest = max(seconds, key=seconds.get)
        print(f"{path}: {sum(seconds.values()):.1f} s; {slowest} alone {seconds[slowest]:.1f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
