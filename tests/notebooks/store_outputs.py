"""Run notebooks from top to bottom and store their outputs, as `make lessons` does.

    python tests/notebooks/store_outputs.py lessons/*.ipynb

What would only be true of this run (timing, widget states, versions) is not stored. A notebook that
raises is left as it was, and the error is shown.
"""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
IN_PLACE_OF_A_CONTROL = "The control appears here when this cell runs in JupyterLab."


def store_outputs(path: Path) -> None:
    """Run the notebook in its own folder; raises nbclient's CellExecutionError where a cell does."""
    notebook = nbformat.read(path, as_version=4)
    resources = {"metadata": {"path": str(path.parent)}}
    NotebookClient(notebook, resources=resources, record_timing=False).execute()
    notebook.metadata.pop("widgets", None)
    notebook.metadata.language_info = {"name": "python"}
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            # A stored view has no kernel behind it: a sentence stands in its place.
            if output.get("data", {}).pop(WIDGET_VIEW, None):
                output.data["text/plain"] = IN_PLACE_OF_A_CONTROL
    path.write_text(nbformat.writes(notebook) + "\n", encoding="utf-8")


def main(paths: list[str]) -> None:
    for path in paths:
        print(path)
        store_outputs(Path(path))


if __name__ == "__main__":
    main(sys.argv[1:])
