"""What every test runs under."""

import os
import shutil

import numpy as np
import pytest
from hypothesis import settings

# Debian package → the names its program may have.
PROGRAMS = {
    "bubblewrap": ("bwrap",),
    "chromium": ("chromium", "chromium-browser", "google-chrome"),
    "make": ("make",),
}

np.seterr(all="raise", under="ignore")  # underflow to zero is right for a decayed state

settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")


@pytest.fixture(scope="session")
def needs():
    """`needs("chromium")`: the path of that Debian package's program; skips where it is missing."""

    def path(package: str) -> str:
        found = next(filter(None, map(shutil.which, PROGRAMS[package])), None)
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
