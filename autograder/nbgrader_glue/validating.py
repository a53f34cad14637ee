"""Validate, where nbgrader would say nothing that helps: of a notebook without its settings it says
"Success", and of one with a cell twice it shows the way through its own code.
"""

import json
import re
from collections import Counter
from pathlib import Path

from jupyter_server.utils import url_path_join
from nbgrader.server_extensions.validate_assignment.handlers import ValidateAssignmentHandler
from tornado.web import Application
from traitlets.config import Config

from autograder.nbgrader_glue.patience import VALIDATE_SECONDS

CALL = re.compile(r"""^check\(\s*["']([\w-]+)["']""", re.MULTILINE)
AGAIN = "Put your answers into the notebook as it was handed out, and validate that one."
NO_SETTINGS = (
    "The cells of this notebook have lost nbgrader's settings, as happens in other editors. So Validate "
    f"finds no check to look at. {AGAIN}"
)
TWICE = (
    "This notebook has {} more than once, as after a cell was split or copied, and Validate stops "
    "there. Put all of an answer into the first of these cells, and delete the others."
)
ENDED = (
    "Python itself stopped while this notebook ran, so that Validate has seen none of its checks. Does "
    "a cell call exit, or use up all memory?"
)
NO_KERNEL = (
    "This notebook asks for a kernel that is not installed here. Choose Python 3 under Kernel → Change "
    "Kernel…, save the notebook, and validate it again."
)
# Of the errors in which nbgrader's validation ends.
SAID = {"DeadKernelError": ENDED, "NoSuchKernel": NO_KERNEL}


class Handler(ValidateAssignmentHandler):
    """nbgrader's, which is asked only about a notebook that it can judge."""

    def load_config(self) -> Config:
        """nbgrader's settings; without a file of settings, as a student has none, cells get our time."""
        config: Config = super().load_config()
        if "timeout" not in config.Execute:
            config.Execute.timeout = VALIDATE_SECONDS
        return config

    def validate_notebook(self, path: str) -> dict[str, object]:
        """What JupyterLab shows: success, and as value the result, or why there is none."""
        root = Path(self.root_dir).resolve()
        target = (root / path).resolve()
        if target.is_relative_to(root) and (said := fault_of(target)):
            return {"success": False, "value": said}
        result: dict[str, object] = super().validate_notebook(path)
        if not result["success"]:
            for error, said in SAID.items():
                if error in str(result["value"]):
                    return {"success": False, "value": said}
        return result


def fault_of(path: Path) -> str:
    """Why nbgrader cannot judge this notebook, as a sentence; "" where it can, or says so itself."""
    try:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        ids = [(cell["metadata"].get("nbgrader") or {}).get("grade_id") for cell in cells]
        sources = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return ""
    twice = [str(id) for id, count in Counter(filter(None, ids)).items() if count > 1]
    if twice:
        return TWICE.format(" and ".join(f"the cell {id}" for id in twice))
    # One check may be called in a notebook to try things in; a problem has several.
    checks = {call[1] for source in sources if (call := CALL.search(source))}
    return NO_SETTINGS if len(checks) > 1 and not any(ids) else ""


def serve(application: Application, base_url: str) -> None:
    """Answer Validate's question in this server, before nbgrader does."""
    pattern = url_path_join(base_url, "/assignments/validate")
    application.add_handlers(".*$", [(pattern, Handler)])
