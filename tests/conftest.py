"""What every test runs under."""

import gc
import os
import re
import shutil
import sysconfig
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from tests import once

# Debian keeps PostgreSQL's server off PATH; its client is on it.
SERVERS = Path("/usr/lib/postgresql").glob("*/bin/initdb") if shutil.which("psql") else ()
# Debian package → the names its program may have, or a file of a package without a program.
PROGRAMS = {
    "bubblewrap": ("bwrap",),
    "chromium": ("chromium", "chromium-browser", "google-chrome"),
    "default-jdk-headless": ("javac",),
    "g++": ("g++",),
    "gcc": ("gcc", "cc"),
    "libeigen3-dev": ("/usr/include/eigen3/Eigen/Dense",),
    "libejml-java": ("/usr/share/java/ejml-simple.jar",),
    "octave": ("octave-cli",),
    "openssl": ("openssl",),
    "make": ("make",),
    "nodejs": ("node",),
    "npm": ("npm",),
    "podman": ("podman",),
    "postgresql": ("initdb", *sorted(map(str, SERVERS))),
    "python3-dev": (str(Path(sysconfig.get_path("include"), "Python.h")),),
}

FIRST = (
    "test_class_server.py",
    "test_student.py",
    "test_sessions.py",
    "test_rehearsal.py",
    "test_book.py",
    "test_wolfram.py",
    "test_verdicts.py",
    "test_corrections.py",
    "test_nbgrader.py",
    "test_kills.py",
    "test_hostile_files.py",
    "test_dask.py",
    "test_agreement.py",
    "test_mistakes.py",
    "test_right_answers.py",
    "test_hostile.py",
    "test_record.py",
    "test_carried_on.py",
    "test_honest.py",
    "test_from_file.py",
)

# In the reason of a skip that is none of CI's business: the test needs what the project may not contain.
OUTSIDE = "not part of the project"
# Nor is a test that makes accounts, where an ordinary user runs CI.
AS_ROOT = "run the tests as root"

np.seterr(all="raise", under="ignore")  # underflow to zero is right for a decayed state

# How long an example takes, and to draw it, is the machine's affair.
ANY_MACHINE = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("local", ANY_MACHINE)
settings.register_profile("ci", ANY_MACHINE, derandomize=True)
# The same examples in each run, as CI asks for in both of its runs.
settings.load_profile(os.environ.get("EXAMPLES") or ("ci" if os.environ.get("CI") else "local"))


@pytest.fixture(scope="session", autouse=True)
def shared(tmp_path_factory):
    """A home for what the processes of this run share."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(once, "folder", once.of_the_run(tmp_path_factory.getbasetemp()))
        yield


@pytest.fixture(autouse=True)
def environment():
    """Each test leaves the environment as it found it, also where what it runs does not.

    nbgrader leaves variables behind after an error, and a later test in this process would read them.
    """
    before = dict(os.environ)
    yield
    for name in os.environ.keys() - before.keys():
        del os.environ[name]
    os.environ.update(before)


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


@pytest.fixture(scope="session")
def compiler(needs):
    """A C compiler that makes modules for this Python; on Windows setuptools looks for it."""
    if os.name == "nt":
        return
    needs("gcc")
    needs("python3-dev")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    return _without_skips((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    return _without_skips((yield))


def _without_skips(report):
    """Under CI everything is installed, so that a skip is a failure, but for what is OUTSIDE."""
    if os.environ.get("CI") and report.skipped and not hasattr(report, "wasxfail"):
        *_, reason = report.longrepr
        if OUTSIDE in reason or AS_ROOT in reason:
            return report
        report.outcome = "failed"
        report.longrepr = f"CI is set, where nothing may be skipped. {reason}"
    return report


def pytest_collection_modifyitems(items):
    """The files that take longest come first, so that no process has one left when the others end."""
    items.sort(
        key=lambda item: FIRST.index(item.path.name) if item.path.name in FIRST else len(FIRST)
    )


@pytest.hookimpl(trylast=True)
def pytest_collection_finish():
    """A look at all that was collected takes half a second of some test's limit, wherever it comes."""
    gc.collect()
    gc.freeze()


def pytest_sessionfinish():
    gc.unfreeze()  # or nanobind tells at the end of all that was never taken away


@pytest.hookimpl(trylast=True)
def pytest_terminal_summary(terminalreporter):
    """Just above the last line: what to install for the tests that were skipped, each once."""
    skipped = [report.longrepr[-1] for report in terminalreporter.stats.get("skipped", ())]
    missing: dict[str, set[str]] = {}
    for reason in map(str, skipped):
        found = re.search(r"needs [^:]*: ((?:apt|pip) install .*?)(\S+)$", reason)
        command, package = found.groups() if found else ("", reason.removeprefix("Skipped: "))
        missing.setdefault(command, set()).add(package)
    if missing:
        terminalreporter.write_sep("-", f"{len(skipped)} skipped; to run them as well")
    for reason in sorted(missing.pop("", ())):
        terminalreporter.write_line(reason)
    for command, packages in sorted(missing.items()):
        terminalreporter.write_line(f"{command}{' '.join(sorted(packages))}")
