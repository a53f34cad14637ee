"""As many processes as the container gives processors to, whatever the machine has."""

import os
import sys

import pytest

from autograder import processors
from autograder.cli import main

linux = pytest.mark.skipif(sys.platform != "linux", reason="control groups are Linux's")


@pytest.fixture
def group(tmp_path, monkeypatch):
    """A machine of eight processors, and what its control groups say."""
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(8)), raising=False)
    monkeypatch.setattr(processors, "CGROUPS", tmp_path / "cgroup")
    monkeypatch.setattr(processors, "OF_PROCESS", tmp_path / "of_process")

    def write(process: str, **files: str) -> None:
        (tmp_path / "of_process").write_text(process)
        for name, text in files.items():
            path = tmp_path / "cgroup" / name.replace("__", "/").replace("_max", ".max")
            path = path.with_name(path.name.replace("cpu_cfs", "cpu.cfs"))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)

    return write


@linux
@pytest.mark.parametrize(
    ("process", "files", "wanted"),
    [
        ("0::/\n", {"cpu_max": "200000 100000\n"}, 2),
        ("0::/\n", {"cpu_max": "150000 100000\n"}, 2),
        ("0::/\n", {"cpu_max": "10000 100000\n"}, 1),
        ("0::/\n", {"cpu_max": "max 100000\n"}, 8),
        ("0::/a/b\n", {"a__cpu_max": "300000 100000\n", "a__b__cpu_max": "max 100000\n"}, 3),
        ("0::/outside/of/it\n", {"cpu_max": "200000 100000\n"}, 2),
        (
            "4:cpu,cpuacct:/d\n",
            {"cpu__d__cpu_cfs_quota_us": "250000\n", "cpu__d__cpu_cfs_period_us": "100000\n"},
            3,
        ),
        (
            "4:cpu:/\n",
            {"cpu__cpu_cfs_quota_us": "-1\n", "cpu__cpu_cfs_period_us": "100000\n"},
            8,
        ),
        ("", {}, 8),
    ],
)
def test_the_share_of_the_container_counts(group, process, files, wanted):
    group(process, **files)
    assert processors.usable() == wanted


@linux
def test_the_affinity_counts(group, monkeypatch):
    group("")
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {5})
    assert processors.usable() == 1


@linux
def test_the_command_starts_as_many(group, monkeypatch, tmp_path):
    group("0::/\n", cpu_max="300000 100000\n")
    started = []

    def grade_all(root, assignment, open_recorder, jobs, *rest):
        started.append(jobs)
        return []

    monkeypatch.setattr("autograder.pipeline.run.grade_all", grade_all)
    monkeypatch.setattr("autograder.commands.grade.unknown", lambda root, assignment: "")
    main(["grade", "p3-pendulum"])
    assert started == [3]
