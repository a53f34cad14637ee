"""The rules of the house that no single module can see: who imports whom, and what is tracked."""

import ast
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ARMDYN = sorted((ROOT / "lib" / "armdyn").rglob("*.py"))
AUTOGRADER = sorted((ROOT / "autograder").rglob("*.py"))
SOLUTIONS = sorted((ROOT / "solutions").rglob("*.ipynb"))


def imports(source: str, package: str = "") -> set[str]:
    """Every module that the source names in an import, wherever in it; relative ones resolved."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1]
            base = ".".join([*(above if node.level else []), *filter(None, [node.module])])
            found.add(base)
            found.update(f"{base}.{alias.name}" for alias in node.names)
    return found


def module_imports(path: Path, top: Path) -> set[str]:
    return imports(path.read_text(encoding="utf-8"), ".".join(path.relative_to(top).parent.parts))


def names(modules: set[str], *packages: str) -> set[str]:
    """Those of the modules that are in, or are, one of the packages."""
    return {m for m in modules for p in packages if m == p or m.startswith(f"{p}.")}


def code(notebook: Path) -> str:
    """The notebook's code, without the lines that are IPython's and not Python's."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    source = "\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code")
    return "\n".join(
        line for line in source.splitlines() if not line.lstrip().startswith(("%", "!"))
    )


def tracked() -> list[Path]:
    """The files git tracks; outside a checkout, none."""
    listed = subprocess.run(
        [shutil.which("git"), "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True
    )
    return [ROOT / name for name in listed.stdout.decode().split("\0") if name]


def relative(paths):
    return [pytest.param(path, id=path.relative_to(ROOT).as_posix()) for path in paths]


@pytest.mark.parametrize(
    ("source", "package", "found"),
    [
        ("import a.b as c", "", {"a.b"}),
        ("from a import b", "", {"a", "a.b"}),
        ("from . import b", "a.c", {"a.c", "a.c.b"}),
        ("from .. import b", "a.c", {"a", "a.b"}),
        ("from ..d import b", "a.c", {"a.d", "a.d.b"}),
        ("def f():\n    import late", "", {"late"}),
    ],
)
def test_imports_are_found(source, package, found):
    assert imports(source, package) == found


@pytest.mark.parametrize("path", relative(ARMDYN))
def test_armdyn_stands_alone(path):
    found = module_imports(path, ROOT / "lib")
    assert not names(found, "IPython", "nbgrader", "autograder")
    if path.stem != "plotting" and "plotting" not in path.parts:
        assert not names(found, "matplotlib")


def test_models_and_derive_do_not_know_each_other():
    top = ROOT / "lib"
    for path in ARMDYN:
        area = path.relative_to(top / "armdyn").parts[0].removesuffix(".py")
        if area == "models":
            # `SerialChain.derivation()` is a door to `derive`, opened when it is called: a model in
            # numbers stays free of symbols.
            doors = {f"armdyn.derive{name}" for name in ("", ".serial_chain", ".Derivation")}
            known = names(module_imports(path, top), "armdyn.derive")
            assert known <= (doors if path.stem == "serial_chain" else set()), path
        if area == "derive":
            assert not names(module_imports(path, top), "armdyn.models"), path


def test_a_model_in_numbers_loads_no_symbols():
    script = "import sys, armdyn.models; print({'sympy', 'armdyn.derive'} & set(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "set()"


# What each room of the autograder may import of the project, itself apart. `judging` and `sandbox` could
# be lifted out with `protocol`, which with `sandbox/inside` knows nothing of the course.
MAY_IMPORT = {
    "digest": (),
    "files": (),
    "hints_seen": ("files",),
    "worked_answers": ("files",),
    "protocol": (),
    "roster": (),
    "term_calendar": ("roster",),
    "lms": ("protocol", "roster", "term_calendar"),
    "year": ("protocol", "roster", "term_calendar", "lms"),
    "lti": ("files", "protocol", "roster", "lms"),
    "sandbox/inside": (),
    "entering": (),
    "terminal": ("protocol",),
    "sandbox": ("protocol",),
    "judging": ("protocol",),
    "checks": ("protocol", "judging"),
    "mechanisms": (),
    "mutation": ("digest", "files", "protocol", "judging", "mechanisms"),
    "authoring": (
        *(
            "files",
            "protocol",
            "judging",
            "mechanisms",
            "mutation",
            "notebook",
            "pictures",
            "problems",
            "proofs",
        ),
    ),
    "proofs": ("protocol",),
    "problems": ("protocol", "judging", "mechanisms", "mutation"),
    "lesson_checks": ("protocol", "judging", "problems"),
    "stored": ("digest", "protocol", "judging"),
    "bundle": (
        *("digest", "files", "protocol", "judging", "stored", "problems", "lesson_checks"),
        *("notebook", "mechanisms", "nbgrader_glue", "lab"),
    ),
    "pictures": ("protocol", "judging", "mechanisms", "mutation", "problems"),
    "student": (
        *("hints_seen", "worked_answers", "protocol", "judging", "pictures", "problems", "proofs"),
        "lesson_checks",
    ),
    "notebook": ("digest", "terminal", "protocol", "sandbox", "judging", "problems", "proofs"),
    "marking": ("digest", "files", "notebook", "pipeline"),
    "report": ("terminal", "protocol", "judging", "problems", "proofs", "notebook"),
    "pipeline": (
        "busy",
        "digest",
        "files",
        "terminal",
        "protocol",
        "sandbox",
        "judging",
        "notebook",
    ),
    "nbgrader_glue": (
        "busy",
        "digest",
        "files",
        "hints_seen",
        "worked_answers",
        "terminal",
        "protocol",
        "sandbox",
        "problems",
        "notebook",
        "report",
        "marking",
        *("entering", "meant", "roster", "term_calendar", "lms", "lti.sent"),
    ),
    "commands": (
        *("arguments", "authoring", "bundle", "files", "lab", "lab_server", "lms", "lti"),
        *("marking", "meant", "mechanisms", "mutation", "nbgrader_glue", "pipeline", "processors"),
        *("report", "roster", "term_calendar", "terminal", "worked_answers", "year"),
    ),
    "arguments": ("worked_answers",),
    "lab": ("files",),
    "lab_server": ("nbgrader_glue",),
    "meant": (),
    "busy": (),
    "processors": (),
    "__init__": ("protocol", "student"),
    "cli": ("commands", "entering", "lab"),
}


def room(path: Path) -> str:
    """The part of the autograder that a file of it belongs to: a key of MAY_IMPORT."""
    parts = path.relative_to(ROOT / "autograder").with_suffix("").parts
    return "sandbox/inside" if parts[:2] == ("sandbox", "inside") else parts[0]


@pytest.mark.parametrize("path", relative(AUTOGRADER))
def test_rooms_of_the_autograder_depend_one_way(path):
    own, imported = room(path), module_imports(path, ROOT)
    allowed = {f"autograder.{name}" for name in (own, *MAY_IMPORT[own])}
    found = names(imported, "autograder") - {"autograder"}
    assert found - names(found, *allowed) == set()
    if own in ("protocol", "judging", "sandbox", "sandbox/inside"):
        # How a program is built and talked to is the same for a student's and for ours.
        programs = (
            ("armdyn.ports", "armdyn.codegen.build") if path.parent.name == "languages" else ()
        )
        armdyn = names(imported, "armdyn")
        assert armdyn - names(armdyn, *programs) == set()
        assert not names(imported, "nbformat", "nbgrader")


@pytest.mark.parametrize("path", relative(AUTOGRADER))
def test_one_package_knows_nbgrader(path):
    if room(path) != "nbgrader_glue":
        assert not names(module_imports(path, ROOT), "nbgrader")


@pytest.mark.parametrize("path", relative(SOLUTIONS))
def test_a_problem_holds_nothing_of_armdyn(path):
    assert not names(imports(code(path)), "armdyn")


def test_there_are_files_to_judge():
    assert len(ARMDYN) > 5
    assert len(AUTOGRADER) > 5
    assert SOLUTIONS


def test_no_registry_is_named():
    # Where packages come from is the machine's business: a mirror, a cache, a folder of wheels.
    registry = re.compile(
        r"(pypi|pythonhosted|npmjs|yarnpkg|jsdelivr|unpkg|anaconda|conda-forge)\.(org|com|io|net)"
        r"|--(extra-)?index-url|find-links",
        re.IGNORECASE,
    )
    this = Path(__file__)
    naming = [
        (path.relative_to(ROOT).as_posix(), found.group())
        for path in tracked()
        if path != this and path.is_file()
        for found in [registry.search(path.read_text(encoding="utf-8", errors="replace"))]
        if found
    ]
    assert naming == []


def test_nothing_of_students_is_tracked():
    assert not [p for p in tracked() if p.relative_to(ROOT).parts[0] in ("course", "problems")]


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md"])
def test_says_what_it_is(name):
    assert len((ROOT / name).read_text(encoding="utf-8")) > 500


def _pins():
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def test_constraints_pin_everything():
    pins = _pins()
    assert len(pins) > 100
    assert [pin for pin in pins if not re.fullmatch(r"[a-z0-9-]+==[0-9][\w.]*( ; .+)?", pin)] == []


def test_no_start_of_jupyter_or_nbgrader_builds_a_grammar():
    """jsonschema loads this package if it is there, which then takes 1.5 s."""
    assert [pin for pin in _pins() if pin.startswith("rfc3987-syntax==")] == []
