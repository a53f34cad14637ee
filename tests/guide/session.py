"""Follows a page: its files are written, its commands run one after the other in one course."""

import os
import re
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from tests.autograder.nbgrader_forks import PROGRAMS, installed
from tests.guide.document import Command, Page
from tests.guide.not_run import REASONS

SECONDS = 120.0
ACCOUNT = "c.ExchangeCollect.check_owner = False  # here one account hands in for all students\n"

Others = Mapping[str, Callable[[Path], object]]


def follow(name: str, root: Path, others: Others, files: Mapping[str, str]) -> str:
    """Run a page's commands in the course `root`; what they printed.

    others: what other people have done before a command, by the command. files: where a block of a
    language is to be written; a further one is added at the file's end.
    """
    with (root / "nbgrader_config.py").open("a") as config:
        config.write(ACCOUNT)
    page, printed, last = Page(name), "", None
    for block in page.blocks:
        if block.language in files:
            path = root / files[block.language]
            path.parent.mkdir(mode=0o700, exist_ok=True)
            with path.open("a", encoding="utf-8") as file:
                file.write(block.text)
        elif block.language == "text" and last is not None:
            missing = [line for line in block.text.splitlines() if not _is_in(line, last)]
            assert not missing, f"{name}:{block.line}: not printed: {missing}\nbut:\n{last}"
        commands = [one for one in page.of(block) if one.text not in REASONS]
        if page.of(block):
            last = "".join(_run(root, one, others) for one in commands) if commands else None
            printed += last or ""
    return printed


def _run(root: Path, command: Command, others: Others) -> str:
    if command.text in others:
        others[command.text](root)
    program, *arguments = command.words
    if program in PROGRAMS and hasattr(os, "fork"):
        status, printed = installed(root, program, *arguments, JUPYTER_DATA_DIR=str(root / "data"))
    else:
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        ran = subprocess.run(
            ["bash", "-euc", command.text],
            cwd=root,
            capture_output=True,
            text=True,
            timeout=SECONDS,
            env=os.environ | {"PATH": path, "JUPYTER_DATA_DIR": str(root / "data")},
        )
        status, printed = ran.returncode, ran.stdout + ran.stderr
    assert status == command.status, f"{command.place}: {command.text}: {status}\n{printed}"
    return printed


def _is_in(line: str, printed: str) -> bool:
    """Whether a line was printed; "…" stands for anything, and one space for several."""
    parts = map(re.escape, " ".join(line.split()).split("…"))
    wanted = re.compile("[^\n]*".join(parts))
    return any(wanted.search(" ".join(one.split())) for one in printed.splitlines())
