"""In a container that masks a part of /proc, as they all do, the missing walls are seen and said."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.sandbox import bubblewrap, refusal

ROOT = Path(__file__).parents[3]
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
    assert ("bubblewrap does not work here" in said.stderr) == (walls == "False")
    assert ("Start it with --security-opt unmask=ALL" in said.stderr) == (walls == "False")


# As bubblewrap 0.12 says it in a plain container of Docker 20.10 and of Podman 4.3, then with one flag
# in Docker's, and on Ubuntu 24.04; the last is what it says to a user who has used up their namespaces.
@pytest.mark.parametrize(
    ("said", "helps"),
    [
        ("No permissions to create a new namespace, likely because …", "seccomp=unconfined"),
        ("No permissions to create new namespace, likely because …", "seccomp=unconfined"),
        ("Can't mount proc on /proc: Operation not permitted", "unmask=ALL"),
        ("Can't mount proc on /newroot/proc: Operation not permitted", "systempaths=unconfined"),
        ("Failed to make / slave: Permission denied", "apparmor=unconfined"),
        ("setting up uid map: Permission denied", "AppArmor"),
        ("loopback: Failed RTM_NEWADDR: Operation not permitted", "AppArmor"),
        (refusal.NOT_INSTALLED, "apt-get install bubblewrap"),
        ("Creating new namespace failed: … /proc/sys/user/max_*_namespaces exceeded", "flags"),
    ],
)
def test_each_refusal_has_its_remedy(said, helps):
    sentence = refusal.remedy(f"bwrap: {said}")
    assert helps in sentence
    assert refusal.PAGE in sentence


def test_the_page_that_is_named_has_the_flags():
    text = (ROOT / refusal.PAGE).read_text(encoding="utf-8")
    for flag in ("seccomp=unconfined", "systempaths=unconfined", "apparmor=unconfined"):
        assert f"--security-opt {flag}" in text


@pytest.mark.parametrize(("outside", "warned"), [("0", True), ("1000", False)])
def test_root_without_its_rights_is_warned_of(monkeypatch, caplog, tmp_path, outside, warned):
    """In a container root may be the machine's, whose processes nothing counts, or stand for a user."""
    numbers = tmp_path / "uid_map"
    numbers.write_text(f"         0 {outside:>10} 65536\n")
    monkeypatch.setattr(bubblewrap, "UID_MAP", numbers)
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr(bubblewrap, "python_folders", list)
    monkeypatch.setattr(bubblewrap, "_refused", lambda *options: "bwrap: no")
    assert not bubblewrap._root_can_step_down.__wrapped__()
    assert [r for r in caplog.messages if "leave out --user 0" in r] == caplog.messages
    assert bool(caplog.messages) == warned
