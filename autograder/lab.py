"""Starts JupyterLab for a student or an instructor: `make lab` and `autograder lab`."""

import json
import logging
import os
import socket
import sys
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urljoin

from autograder.files import put_in_place

if TYPE_CHECKING:
    from jupyter_server.serverapp import ServerApp

FIRST_LESSON = "lessons/00-start-here.ipynb"
# A student's package brings its lessons and problems.
HANDED_OUT = Path(__file__).parent / "handed_out"
FIRST_PROBLEM = "problems/p3-pendulum/p3-pendulum.ipynb"
# The logs of the libraries under the server, which each write a part of one error.
OTHERS_LOGS = ("asyncio", "tornado.access", "tornado.application", "tornado.general")
# It needs an exchange.
ASSIGNMENT_LIST = "@jupyter/nbgrader:assignment-list"
INSTRUCTORS_EXTENSIONS = (
    "@jupyter/nbgrader:course-list",
    "@jupyter/nbgrader:create-assignment",
    "@jupyter/nbgrader:formgrader",
)
# `make browser` installs it for the pages that it makes, and here it finds no part of JupyterLite.
OF_BROWSERS = ("@jupyterlite/pyodide-kernel-extension",)


def lab(arguments: list[str]) -> int:
    """Serve JupyterLab from the course's folder until it is stopped; its exit status.

    With `--instructor`, it shows the whole course, and nbgrader's Formgrader and Create Assignment;
    without, what a student needs. The other `arguments` go to JupyterLab, and override what is set
    here. One line on stdout says which address to open; if the server cannot start, one line on
    stderr says what to do.
    """
    root = Path.cwd()
    if not (root / "lessons").is_dir():
        if not (HANDED_OUT / "lessons").is_dir():
            return _fail(
                f"there is no lessons/ in {root}; change to the course's folder and try again"
            )
        try:
            root = _written_out(root / "armdyn")
        except OSError as error:
            return _fail(f"the course cannot be written to {root / 'armdyn'}: {error}")
    try:
        port = _port(arguments)
    except ValueError as error:
        return _fail(str(error))
    if port and not _is_free(port):
        return _fail(
            f"port {port} is in use; stop the program that uses it, choose another port, or leave out "
            "--port to get a free one"
        )

    from jupyterlab.labapp import LabApp  # takes a second

    student = "--instructor" not in arguments
    arguments = [argument for argument in arguments if argument != "--instructor"]
    # JupyterLab's state lives beside the environment, so that this course and a student's other
    # projects do not open each other's notebooks.
    has_exchange = (root / "nbgrader_config.py").is_file()
    keeps = root / (".venv" if has_exchange else ".lab")
    state = keeps / ("lab" if student else "lab-of-instructor")
    _write_settings(state / "settings", student, has_exchange)
    opens = "/lab"
    first = [path for path in (FIRST_LESSON, FIRST_PROBLEM) if (root / path).exists()]
    if student and first and not any((state / "workspaces").glob("*")):
        _lay_out(state / "workspaces", first)
        opens = f"/lab/tree/{first[0]}?file-browser-path=/"

    settings = _settings(root, state, opens)
    if student:
        settings.append("--CourseContents.for_student=True")
    server = LabApp.initialize_server([*settings, *arguments])
    for log in (*map(logging.getLogger, OTHERS_LOGS), server.log):
        log.addFilter(_is_an_error)
    # The loop's first task is to listen, and this its next: before, nobody answers at the address.
    where = f"\n    Open {_address(server)}\n    Stop with Ctrl-C\n"
    server.io_loop.add_callback(print, where, flush=True)
    # Jupyter would print the address again, five times over.
    server.identity_provider.token_generated = False
    server.start()
    return 0


def _written_out(folder: Path) -> Path:
    """The course of a student's package, written into the folder; files that are there stay."""
    for path in sorted(HANDED_OUT.rglob("*")):
        target = folder / path.relative_to(HANDED_OUT)
        if path.is_file() and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            put_in_place(target, path.read_bytes())
    print(f"\n    Your course is in {folder}", flush=True)
    return folder


def _is_an_error(record: logging.LogRecord) -> bool:
    """False if a page was closed or loaded again in the browser while the server wrote to it."""
    from tornado.iostream import StreamClosedError
    from tornado.websocket import WebSocketClosedError

    closed = (StreamClosedError, WebSocketClosedError)
    return not (record.exc_info and isinstance(record.exc_info[1], closed))


def _write_settings(folder: Path, student: bool, has_exchange: bool) -> None:
    """Write JupyterLab's own settings: which of its parts are there, and what they ask for."""
    # Without this, it would first ask a student whether to fetch Jupyter's news.
    overrides = {
        "@jupyterlab/apputils-extension:notification": {"fetchNews": "false"},
        # Otherwise the height of cells that were not in view yet is guessed, and a card's link to a
        # section of a long lesson ends beside it.
        "@jupyterlab/notebook-extension:tracker": {"windowingMode": "defer"},
    }
    disabled = [*OF_BROWSERS, *(INSTRUCTORS_EXTENSIONS if student else ())]
    disabled += [] if has_exchange else [ASSIGNMENT_LIST]
    page = {"disabledExtensions": disabled}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "overrides.json").write_text(json.dumps(overrides), encoding="utf-8")
    (folder / "page_config.json").write_text(json.dumps(page), encoding="utf-8")


def _settings(root: Path, state: Path, opens: str) -> list[str]:
    """The arguments that start JupyterLab, quiet and without a request to any other host."""
    settings = [
        f"--ServerApp.root_dir={root}",
        "--ServerApp.jpserver_extensions={'autograder.lab_server': True}",
        f"--LabApp.default_url={opens}",
        f"--LabApp.workspaces_dir={state / 'workspaces'}",
        f"--LabApp.app_settings_dir={state / 'settings'}",
        "--LabApp.extension_manager=readonly",
        "--ServerApp.answer_yes=True",  # one Ctrl-C stops it
        "--Application.log_level=ERROR",
    ]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        settings.append("--allow-root")
    if not has_display():
        settings.append("--no-browser")
    return settings


def _address(server: "ServerApp") -> str:
    """What to open in a browser, with the token unless the user has set their own.

    A server that listens at every address names its machine. In a container nobody knows that name, so
    there `custom_display_url` says how the server is reached from outside.
    """
    at = server.custom_display_url or server.connection_url
    address = urljoin(f"{at.rstrip('/')}/", server.default_url.lstrip("/"))
    identity = server.identity_provider
    if identity.token and identity.token_generated:
        address += f"{'&' if '?' in address else '?'}token={identity.token}"
    return address


def has_display() -> bool:
    """Whether a browser can open a window here."""
    if not sys.platform.startswith("linux"):
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"))


def _port(arguments: list[str]) -> int | None:
    """The port that the arguments ask for; ValueError if it is not a port."""
    found = None
    for position, argument in enumerate(arguments):
        name, equals, value = argument.partition("=")
        if name in ("--port", "--ServerApp.port"):
            found = value if equals else "".join(arguments[position + 1 : position + 2])
    if found is None:
        return None
    if not found.isdecimal() or int(found) > 65535:
        raise ValueError(f"--port={found} is not a port; give a number from 1024 to 65535")
    return int(found)


def _is_free(port: int) -> bool:
    with socket.socket() as trial:
        # As the server does, so that a port it has just left counts as free.
        if os.name == "posix":
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            trial.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def _lay_out(workspaces: Path, notebooks: list[str]) -> None:
    """Write the layout of the first start: a tab a notebook, the first shown; the file browser."""
    from jupyterlab_server.workspaces_handler import WorkspacesManager

    widgets = [f"notebook:{path}" for path in notebooks]
    data: dict[str, dict] = {
        f"notebook:{path}": {"data": {"path": path, "factory": "Notebook"}} for path in notebooks
    }
    data["file-browser-filebrowser:cwd"] = {"path": ""}
    data["layout-restorer:data"] = {
        "main": {
            "dock": {"type": "tab-area", "currentIndex": 0, "widgets": widgets},
            "current": widgets[0],
        },
        "left": {"collapsed": False, "visible": True, "current": "filebrowser"},
        "right": {"collapsed": True, "visible": True},
    }
    layout = {"data": data, "metadata": {"id": "default"}}
    WorkspacesManager(str(workspaces)).save("default", json.dumps(layout))


def _fail(reason: str) -> int:
    print(f"autograder lab: {reason}", file=sys.stderr)
    return 1
