"""In a container that masks a part of /proc, as they all do, the missing walls are seen and said."""

import os
import subprocess
import sys

import pytest

ASK = "from autograder.sandbox.bubblewrap import has_bubblewrap; print(has_bubblewrap())"
# What the kernel looks at before it lets a user namespace mount a /proc: whether this one is whole.
MASKED = ("--dev-bind", "/dev/null", "/proc/cmdline")


def asked(needs, *options: str) -> subprocess.CompletedProcess:
    """What a grader says of the sandbox, as an ordinary user in namespaces like a container's."""
    container = (
        *(needs("bubblewrap"), "--unshare-user", "--unshare-pid", "--uid", "1000", "--gid", "1000"),
        *("--cap-drop", "ALL", "--dev-bind", "/", "/", "--proc", "/proc", *options),
    )
    command = [*container, sys.executable, "-c", ASK]
    return subprocess.run(command, capture_output=True, text=True, cwd=os.getcwd())


@pytest.mark.parametrize(("options", "walls"), [((), "True"), (MASKED, "False")])
def test_the_walls_are_tried_before_they_are_trusted(needs, options, walls):
    said = asked(needs, *options)
    assert said.stdout.strip() == walls, said.stderr
    assert ("In a container, it needs the flags of docs/class-server.md" in said.stderr) == (
        walls == "False"
    )
