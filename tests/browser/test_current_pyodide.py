"""The core of the Pyodide that users get, as npm has it: it lacks NumPy, so what needs none is tried."""

import io
import json
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest

from tests.browser.conftest import ROOT

pytest.importorskip(
    "jupyterlite_pyodide_kernel",
    reason="needs jupyterlite_pyodide_kernel: pip install -c constraints.txt -e .[browser]",
)

from jupyterlite_pyodide_kernel import constants

from autograder.bundle.wheel import write_wheel
from docs.browser.pyodide import LOCK, Pyodide, Wheel

RUNNER = Path(__file__).with_name("run_core.mjs")
SECONDS = 240
SOURCES = ("autograder", "lib/armdyn", "docs/browser/in_kernel", "docs/browser/in_student_package")
# Without the packages' own __init__, which import NumPy.
PROGRAM = """
import importlib, json, pathlib, sys, time, types, warnings

import own

warnings.simplefilter("error")
refused = []
for path in sorted(pathlib.Path("/zip").rglob("*.py")):
    try:
        compile(path.read_bytes(), str(path), "exec", dont_inherit=True)
    except (SyntaxError, Warning) as error:
        refused.append(f"{path}: {error}")
for name in ("autograder", "autograder.protocol"):
    package = sys.modules[name] = types.ModuleType(name)
    package.__path__ = ["/zip/" + name.replace(".", "/")]
limits = importlib.import_module("autograder.protocol.limits")
def never():
    while True:
        try:
            while True:
                pass
        except Exception:
            pass
started = time.perf_counter()
try:
    with limits.time_limit(0.5):
        never()
except limits.TimeLimitError:
    stopped = time.perf_counter() - started
json.dumps({"version": sys.version, "own": own.VALUE, "refused": refused, "stopped": stopped})
"""


@pytest.fixture(scope="module")
def said(tmp_path_factory, needs):
    """What the program says in this Pyodide, with the lock file of a site that has Pyodide's address."""
    top = tmp_path_factory.mktemp("core")
    pack = [needs("npm"), "pack", "--silent", f"pyodide@{constants.PYODIDE_VERSION}"]
    subprocess.run(pack, cwd=top, check=True, capture_output=True, timeout=SECONDS)
    with tarfile.open(next(top.glob("*.tgz"))) as core:
        core.extractall(top, filter="data")
    core, site = top / "package", top / "site"
    wheel = write_wheel(top, "own", "1.0", "Name: own\n", "", {"own.py": b"VALUE = 'the site'"})
    own = Wheel("own", "1.0", wheel.name, wheel.read_bytes(), ("own",))
    Pyodide("https://pyodide.invalid/full", json.loads((core / LOCK).read_text())).write(
        site, [own], []
    )
    (top / "sources.zip").write_bytes(sources())
    (top / "program.py").write_text(PROGRAM)
    done = subprocess.run(
        [needs("nodejs"), RUNNER, core, site / LOCK, "own", top / "sources.zip", top / "program.py"],
        capture_output=True, text=True, timeout=SECONDS,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def sources() -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for folder in SOURCES:
            for path in sorted((ROOT / folder).rglob("*.py")):
                archive.write(path, path.relative_to((ROOT / folder).parent))
    return packed.getvalue()


def test_its_python_is_the_one_that_the_kernel_is_made_for(said):
    assert said["version"].startswith(f"{constants.PYODIDE_PYTHON_VERSION}.")


def test_the_courses_wheels_come_from_the_site(said):
    assert said["own"] == "the site"


def test_its_python_takes_every_file_without_a_warning(said):
    assert said["refused"] == []


def test_a_loop_that_never_ends_is_stopped_in_it(said):
    assert said["stopped"] < 20
