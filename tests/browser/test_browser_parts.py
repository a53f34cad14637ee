"""The parts of the browser's site that need no Pyodide to be seen."""

import hashlib
import io
import json
import re
import tarfile
import zipfile
from pathlib import Path

import nbformat
import pytest

from tests.browser.conftest import ROOT

pytest.importorskip(
    "jupyterlite_pyodide_kernel",
    reason="needs jupyterlite_pyodide_kernel: pip install -c constraints.txt -e .[browser]",
)

from docs.browser import bytecode, lite, needs, notes
from docs.browser.installed import NotPureError, wheel_of
from docs.browser.pyodide import LOCK, Pyodide, PyodideError, Wheel


def entry(name, *depends):
    return {"name": name, "file_name": f"{name}-1-py3-none-any.whl", "depends": list(depends)}


LOCKED = {"packages": {name: entry(name, *of) for name, *of in (("a_b", "c"), ("c",), ("d", "e"))}}
OWN = Wheel("own", "2", "own-2-py3-none-any.whl", b"own", ("own",), ("a-b",))


def files_of_library():
    return {
        path.relative_to(ROOT / "lib").as_posix(): path.read_bytes()
        for path in (ROOT / "lib" / "armdyn").rglob("*.py")
    }


def test_a_module_needs_what_it_may_import_later():
    found = needs.of_library(files_of_library())
    assert found["armdyn.parameters"] == []
    assert "sympy" in found["armdyn.derive"]
    assert "matplotlib" in found["armdyn.plotting"]
    assert "scipy" in found["armdyn.simulate"]
    assert "sympy" in found["armdyn.codegen"]


def test_the_front_page_has_what_jupyterlite_looks_for():
    """Its start-up reads the site's index.html and stops where the element is missing."""
    import jupyterlite_core

    archive = next((Path(jupyterlite_core.__file__).parent).glob("*.tgz"))
    with tarfile.open(archive) as files:
        utils = files.extractfile("package/config-utils.js").read().decode()
    (named,) = re.findall(r"JUPYTER_CONFIG_ID = '([^']+)'", utils)
    (config,) = re.findall(
        rf'<script id="{named}" type="application/json">(.+?)</script>', lite.FRONT
    )
    assert json.loads(config) == {}


def test_a_site_with_pyodides_address_has_its_own_wheels_beside_it(tmp_path):
    Pyodide("https://there/full", LOCKED).write(tmp_path, [OWN], ["a-b"])
    packages = json.loads((tmp_path / LOCK).read_text())["packages"]
    assert packages["a_b"]["file_name"] == "https://there/full/a_b-1-py3-none-any.whl"
    assert packages["own"]["file_name"] == OWN.file
    assert packages["own"]["sha256"] == hashlib.sha256(b"own").hexdigest()
    assert (tmp_path / OWN.file).read_bytes() == b"own"
    assert {path.name for path in tmp_path.iterdir()} == {LOCK, OWN.file}


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "pyodide"
    folder.mkdir()
    for name in ("pyodide.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide.asm.mjs"):
        (folder / name).write_text(name)
    for name in ("a_b", "c"):
        (folder / LOCKED["packages"][name]["file_name"]).write_text(name)
    (folder / LOCK).write_text(json.dumps(LOCKED))
    return folder


def test_a_site_with_its_own_pyodide_has_what_its_packages_need(folder, tmp_path):
    pyodide = Pyodide.in_folder(folder)
    assert pyodide.has("a-b")
    assert not pyodide.has("d")
    assert not pyodide.has("no such package")
    pyodide.write(tmp_path / "site", [OWN], ["a-b", "own"])
    packages = json.loads((tmp_path / "site" / LOCK).read_text())["packages"]
    assert set(packages) == {"a-b", "c", "own"}
    assert all((tmp_path / "site" / one["file_name"]).is_file() for one in packages.values())


@pytest.mark.parametrize("missing", ["pyodide.mjs", "pyodide.asm.mjs", LOCK])
def test_a_folder_without_a_part_is_refused(folder, missing):
    (folder / missing).unlink()
    with pytest.raises(PyodideError, match=f"is no Pyodide: it has no {missing}"):
        Pyodide.in_folder(folder)


@pytest.fixture
def site(tmp_path):
    """Where a site has its packages: one of those that get bytecode, one of the others."""
    folder = tmp_path / "site"
    folder.mkdir()
    packages = {}
    for name in ("armdyn", "own"):
        file = f"{name}-1-py3-none-any.whl"
        with zipfile.ZipFile(folder / file, "w") as packed:
            packed.writestr(f"{name}/a.py", "")
        packages[name] = {"file_name": file, "sha256": "old"}
    (folder / LOCK).write_text(json.dumps({"packages": packages}))
    return folder


def test_bytecode_comes_beside_its_source(site, tmp_path):
    for name in ("armdyn", "own"):
        compiled = tmp_path / "made" / name / "__pycache__" / "a.cpython-312.pyc"
        compiled.parent.mkdir(parents=True)
        compiled.write_bytes(b"compiled")
    bytecode.put_in(site, tmp_path / "made")
    packages = json.loads((site / LOCK).read_text())["packages"]
    wheel = site / packages["armdyn"]["file_name"]
    with zipfile.ZipFile(wheel) as packed:
        assert packed.namelist() == ["armdyn/a.py", "armdyn/__pycache__/a.cpython-312.pyc"]
        assert packed.read("armdyn/__pycache__/a.cpython-312.pyc") == b"compiled"
    assert packages["armdyn"]["sha256"] == hashlib.sha256(wheel.read_bytes()).hexdigest()
    assert packages["own"]["sha256"] == "old"


NODES = {
    "": "Node, which would compile the packages, is not installed here",
    "#!/bin/sh\necho too old >&2; exit 1\n": "Python did not start in Node: too old",
}


@pytest.mark.parametrize("script", NODES)
def test_a_site_stays_as_it_is_where_node_compiles_nothing(site, tmp_path, monkeypatch, script):
    programs = tmp_path / "programs"
    programs.mkdir()
    if script:
        (programs / "node").write_text(script)
        (programs / "node").chmod(0o755)
    monkeypatch.setenv("PATH", str(programs))
    before = {path: path.read_bytes() for path in site.iterdir()}
    with pytest.raises(bytecode.BytecodeError, match=NODES[script]):
        bytecode.add(site, ["armdyn"])
    assert {path: path.read_bytes() for path in site.iterdir()} == before


def test_an_installed_package_becomes_a_wheel_without_its_tests():
    wheel = wheel_of("mpmath", "mpmath")
    with zipfile.ZipFile(io.BytesIO(wheel.data)) as packed:
        names = packed.namelist()
    assert "mpmath/__init__.py" in names
    assert f"mpmath-{wheel.version}.dist-info/RECORD" in names
    assert [name for name in names if "/tests/" in name or name.startswith("..")] == []


def test_a_package_that_is_compiled_is_refused():
    with pytest.raises(NotPureError, match="numpy is not pure Python"):
        wheel_of("numpy", "numpy")


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("p1-inertia", ("File → Download", "Validate", "from_file")),
        ("p3-pendulum", ("File → Download", "Validate")),
        ("cart-pole", ("File → Download", "Validate")),
        ("08-from-symbols-to-fast-code", ("kept in this browser", "no C compiler")),
    ],
)
def test_a_notebook_says_what_is_different_below_its_title(name, says):
    title = nbformat.v4.new_markdown_cell("# Title", id="title")
    notebook = nbformat.v4.new_notebook(cells=[title])
    notes.add(notebook, name)
    assert [cell.id for cell in notebook.cells] == ["title", "in-the-browser"]
    assert [word for word in says if word not in notebook.cells[1].source] == []
    nbformat.validate(notebook)
