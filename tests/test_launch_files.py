"""One click to a running course: what a Binder and a dev container run installs by the same pins."""

import json
import os
import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CONTAINER = json.loads((ROOT / ".devcontainer" / "devcontainer.json").read_text(encoding="utf-8"))


@pytest.mark.skipif(os.name == "nt", reason="a Binder runs Linux")
def test_a_binder_installs_by_the_pins_and_writes_the_problems(tmp_path):
    for program in ("python", "autograder"):
        stand_in = tmp_path / program
        stand_in.write_text(f'#!/bin/sh\necho "{program} $*" >>"{tmp_path}/done"\n')
        stand_in.chmod(0o755)
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    subprocess.run(
        [ROOT / ".binder" / "postBuild"], cwd=ROOT, env=os.environ | {"PATH": path}, check=True
    )
    install, problems = (tmp_path / "done").read_text().splitlines()
    assert install.startswith("python -m pip install")
    assert install.endswith("-c constraints.txt -e .[lab]")
    assert problems == "autograder problems"


def test_a_dev_container_does_what_a_binder_does_and_opens_the_course():
    assert CONTAINER["postCreateCommand"] == ".binder/postBuild"
    command = CONTAINER["postAttachCommand"]
    assert command.startswith("autograder lab --no-browser")
    (port,) = CONTAINER["forwardPorts"]
    assert f"--port={port}" in command


def test_both_have_a_python_that_the_course_runs_on():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    oldest = project["requires-python"].removeprefix(">=")
    binder = (ROOT / ".binder" / "runtime.txt").read_text(encoding="utf-8").strip()
    for version in (binder, CONTAINER["image"]):
        assert re.fullmatch(rf"python[-:]{re.escape(oldest)}", version)
