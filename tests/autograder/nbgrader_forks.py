"""The commands of nbgrader and of the kit, in forks of one process that has loaded nbgrader, which alone
takes two seconds.

A fork runs the main function of the installed command, found by the command's name, in the folder, with
the arguments and the environment that the command would be started with.
"""

import atexit
import json
import os
import subprocess
import sys
import tempfile
import threading
from functools import cache
from pathlib import Path

PROGRAMS = ("nbgrader", "autograder")


def installed(folder: Path, program: str, *arguments: str, **environment: str) -> tuple[int, str]:
    """The exit status of a command of one of the PROGRAMS, and what it printed on stdout and stderr."""
    server = _server()
    with tempfile.NamedTemporaryFile("r", encoding="utf-8", errors="replace") as log:
        request = {
            "arguments": [program, *arguments],
            "folder": str(folder),
            "environment": dict(os.environ) | environment,
            "log": log.name,
        }
        server.stdin.write(json.dumps(request) + "\n")
        server.stdin.flush()
        status = int(server.stdout.readline())
        return status, log.read()


@cache
def _server() -> subprocess.Popen:
    server = subprocess.Popen(
        [sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    atexit.register(server.stdin.close)
    return server


def serve() -> None:
    from importlib.metadata import entry_points

    scripts = entry_points(group="console_scripts")
    mains = {program: scripts[program].load() for program in PROGRAMS}

    import autograder.nbgrader_glue.preprocessors  # noqa: F401  what the course's settings name

    for line in sys.stdin:
        request = json.loads(line)
        process = os.fork()
        if process == 0:
            _run(mains[request["arguments"][0]], **request)
        _, status = os.waitpid(process, 0)
        print(os.waitstatus_to_exitcode(status), flush=True)


def _run(main, arguments, folder, environment, log) -> None:
    to = os.open(log, os.O_WRONLY | os.O_APPEND)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    for stream in (1, 2):
        os.dup2(to, stream)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = arguments
    _exit(main)


def _exit(main) -> None:
    """End as Python does after `main`, but do not take the modules apart: that takes longer than most
    commands.
    """
    try:
        code = main()
    except SystemExit as ended:
        code = ended.code
    except BaseException:
        sys.excepthook(*sys.exc_info())
        code = 1
    if not isinstance(code, int | None):
        print(code, file=sys.stderr)
        code = 1
    threading._shutdown()  # type: ignore[attr-defined]  # waits for threads
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code or 0)


if __name__ == "__main__":
    serve()
