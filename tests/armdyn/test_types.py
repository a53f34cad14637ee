"""What armdyn says of its types reaches its users, and is said of every public function."""

import ast
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LIBRARY = ROOT / "lib" / "armdyn"
# What users call, one file each; the rest serves these.
PUBLIC = [
    *("manipulator", "properties", "regressor", "energy_regressor", "base_parameters", "identify"),
    *("consistency", "equilibria", "linearisation", "spatial"),
    *("models/pendulum", "models/planar_2r", "models/planar_chain", "models/serial_chain"),
    *("models/link", "models/motor", "derive/energies", "derive/links", "derive/mechanisms"),
    *("derive/planar", "codegen/cpp", "codegen/java", "codegen/matlab", "codegen/wolfram"),
    *("plotting/ellipse", "plotting/landscape", "plotting/pose", "plotting/torques"),
]
PROGRAM = """
import numpy as np
from armdyn import Planar2R, Pendulum
from armdyn.linearisation import linearise

arm = Pendulum(1.0, 0.5, 0.3)
reveal_type(arm.M([0.1]))
arm.dynamics("hanging", {}, object())
"""


def functions(body: list, prefix: str = ""):
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from functions(node.body, f"{node.name}.")
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield f"{prefix}{node.name}", node


@pytest.mark.parametrize("name", PUBLIC)
def test_every_argument_has_a_type(name):
    tree = ast.parse((LIBRARY / f"{name}.py").read_text(encoding="utf-8"))
    untyped = [
        f"{function}({argument.arg})"
        for function, node in functions(tree.body)
        for argument in [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
        if argument.annotation is None and argument.arg not in ("self", "cls")
    ]
    untyped += [function for function, node in functions(tree.body) if node.returns is None]
    assert untyped == []


def test_a_users_type_checker_reads_them(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM, encoding="utf-8")
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--no-incremental", "program.py"],
        cwd=tmp_path,
        env={"MYPYPATH": str(ROOT / "lib"), "PATH": ""},
        capture_output=True,
        text=True,
    )
    said = checked.stdout
    assert "program.py:7: note: Revealed type is" in said, said + checked.stderr
    assert "ndarray" in said
    assert 'program.py:8: error: Argument 3 to "dynamics"' in said


def test_the_marker_is_installed():
    assert (LIBRARY / "py.typed").is_file()
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert "py.typed" in project["tool"]["setuptools"]["package-data"]["armdyn"]
