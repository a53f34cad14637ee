"""What every test runs under."""

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

# Debian package → the names its program may have, or a file of a package without a program.
PROGRAMS = {
    "bubblewrap": ("bwrap",),
    "chromium": ("chromium", "chromium-browser", "google-chrome"),
    "default-jdk-headless": ("javac",),
    "g++": ("g++",),
    "libeigen3-dev": ("/usr/include/eigen3/Eigen/Dense",),
    "libejml-java": ("/usr/share/java/ejml-simple.jar",),
    "octave": ("octave-cli",),
    "make": ("make",),
    "postgresql": ("initdb", *sorted(map(str, Path("/usr/lib/postgresql").glob("*/bin/initdb")))),
}

np.seterr(all="raise", under="ignore")  # underflow to zero is right for a decayed state

settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")


@pytest.fixture(scope="session")
def needs():
    """`needs("chromium")`: the path of that Debian package's program; skips where it is missing."""

    def locate(name: str) -> str | None:
        return name if name.startswith("/") and os.path.exists(name) else shutil.which(name)

    def path(package: str) -> str:
        found = next(filter(None, map(locate, PROGRAMS[package])), None)
        if found is None:
            pytest.skip(f"needs {package}: apt install {package}")
        return found

    return path


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    return _without_skips((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    return _without_skips((yield))


def _without_skips(report):
    """Under CI everything is installed, so that a skip is a failure."""
    if os.environ.get("CI") and report.skipped and not hasattr(report, "wasxfail"):
        *_, reason = report.longrepr
        report.outcome = "failed"
        report.longrepr = f"CI is set, where nothing may be skipped. {reason}"
    return report
