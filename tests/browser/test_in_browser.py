"""The course in the browser: its notebooks in its Python, and its pages without another host."""

import functools
import gzip
import http.server
import json
import os
import re
import subprocess
import sys
import threading
from pathlib import Path
from urllib.parse import unquote, urlsplit

import nbformat
import pytest
from playwright.sync_api import expect

from autograder.lms.file_names import copy_of
from tests.autograder.bundle import sitting
from tests.autograder.course_problems import NAMES, problem, without_plots
from tests.browser.conftest import PATIENCE, ROOT
from tests.browser.pyodide_folder import complete
from tests.browser.test_student import COSINE, Problem

RUNNER = Path(__file__).with_name("run_in_node.mjs")
LESSONS = sorted(path.stem for path in (ROOT / "lessons").glob("*.ipynb"))
SHORT = ("01", "03")  # a slider; LinAlgError
# Checks that only the grader makes, as the student's package has no equations.
LEFT = {"p1-inertia": 1, "p4-gravity": 1, "c8-control": 2}
# What a card says before it leads elsewhere.
VERDICT = re.compile(r"\A.*?(?=^  (Stuck\?|See |Lesson )|\Z)", re.DOTALL | re.MULTILINE)
# Below the diagnosis: what may be carried on, which only the grader says, and a call in as few digits as
# the machine has time to find.
BELOW = re.compile(r"^  (Your [^.]+ not\s+right\s+yet\s+either\.|Worst case: )", re.MULTILINE)
STATE = re.compile(
    r"\A[pc][1-8]-\w+: (correct|partly correct|incorrect|judged when you hand it in)$"
)
AT = "lab/index.html?path="
COMPRESSED = {".css", ".html", ".ipynb", ".js", ".json", ".mjs", ".svg", ".wasm"}
MOST_MB = 30  # before the first card


@pytest.fixture(scope="module")
def site(tmp_path_factory, needs) -> Path:
    """The site's folder, made by the command."""
    top = tmp_path_factory.mktemp("in the browser")
    pyodide = complete(top / "pyodide", needs)
    why = "needs jupyterlite_core: pip install -c constraints.txt -e .[browser]"
    pytest.importorskip("jupyterlite_core", reason=why)
    made = subprocess.run(
        [sys.executable, "-m", "docs.browser", top / "site"],
        cwd=ROOT, capture_output=True, text=True, env=os.environ | {"ARMDYN_PYODIDE": str(pyodide)},
    )  # fmt: skip
    assert (made.returncode, made.stderr) == (0, "")
    return top / "site"


def notebook(site, path):
    return nbformat.read(site / "files" / f"{path}.ipynb", as_version=4)


def ran(site, needs, tmp_path, notebooks) -> dict[str, list[list[dict]]]:
    """What each cell of each notebook gives, in one Python in Node. notebooks: by their paths."""
    tasks = [
        {
            "name": path,
            "folder": f"/work/{Path(path).parent}",
            "cells": [cell.source for cell in one.cells if cell.cell_type == "code"],
        }
        for path, one in notebooks.items()
    ]
    (tmp_path / "tasks.json").write_text(json.dumps(tasks))
    done = subprocess.run(
        [needs("nodejs"), RUNNER, site, tmp_path / "tasks.json", tmp_path / "replies.json"],
        capture_output=True, text=True, timeout=900,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    replies = json.loads((tmp_path / "replies.json").read_text())
    return {reply["name"]: reply["outputs"] for reply in replies}


def cards(outputs) -> list[str]:
    texts = [one["data"].get("text/plain", "") for of in outputs for one in of if "data" in one]
    return [text for text in texts if STATE.match(text.partition("\n")[0])]


def errors(outputs) -> list[str]:
    return [f"{one['error']}: {one['text']}" for of in outputs for one in of if "error" in one]


@pytest.fixture(scope="module")
def answered(site, needs, tmp_path_factory):
    """All problems with right answers, and with wrong ones."""
    notebooks = {}
    for name in NAMES:
        blank = notebook(site, f"problems/{name}/{name}")
        for kind in ("right", "wrong"):
            made = getattr(problem(name).submissions, kind)(blank)
            notebooks[f"problems/{name}/{kind}"] = without_plots(made)
    return notebooks, ran(site, needs, tmp_path_factory.mktemp("node"), notebooks)


@pytest.mark.parametrize("name", NAMES)
def test_right_answers_are_right(answered, name):
    outputs = answered[1][f"problems/{name}/right"]
    states = [STATE.match(card.partition("\n")[0])[1] for card in cards(outputs)]
    left = LEFT.get(name, 0)
    assert states.count("correct") == len(problem(name).submissions.POINTS) - left
    assert states.count("judged when you hand it in") == left
    assert errors(outputs) == []


@pytest.mark.parametrize("name", NAMES)
def test_wrong_answers_are_named(answered, name):
    found = [VERDICT.match(card)[0] for card in cards(answered[1][f"problems/{name}/wrong"])]
    states = [STATE.match(card)[1] if STATE.match(card) else "" for card in found]
    assert len(found) == len(problem(name).submissions.POINTS)
    assert "correct" not in states
    named = [card for card in found if re.search(r"\[ \] .*\n      \S", card)]
    assert len(named) >= len(found) - LEFT.get(name, 0)


def test_a_card_says_what_it_says_without_a_browser(answered, tmp_path):
    notebooks, given = answered
    wrong = notebooks["problems/p3-pendulum/wrong"]
    nbformat.write(wrong, tmp_path / "p3-pendulum.ipynb")
    here = subprocess.run(
        [sys.executable, sitting.__file__, tmp_path / "p3-pendulum.ipynb"],
        capture_output=True, text=True, check=True, env=os.environ | {"MPLBACKEND": "agg"},
    ).stdout  # fmt: skip
    found = cards(given["problems/p3-pendulum/wrong"])
    assert len(found) == 6
    said = [BELOW.split(VERDICT.match(card)[0])[0] for card in found]
    assert [text for text in said if text not in here] == []
    assert all(re.search(r"\[ \] .*\n      \S", text) for text in said)


@pytest.mark.parametrize(
    "start",
    [*SHORT, *(pytest.param(n[:2], marks=pytest.mark.long) for n in LESSONS if n[:2] not in SHORT)],
)
def test_a_lesson_runs_to_its_end(site, needs, tmp_path, start):
    (name,) = (name for name in LESSONS if name.startswith(start))
    (outputs,) = ran(
        site, needs, tmp_path, {f"lessons/{name}": notebook(site, f"lessons/{name}")}
    ).values()
    assert errors(outputs) == []
    assert [one["text"] for of in outputs for one in of if one.get("stream") == "stderr"] == []
    assert sum(bool(of) for of in outputs) > 5


SETUP = "import numpy as np\nfrom autograder import check, from_file, watch"
LATER = ("sympy", "scipy", "matplotlib")
COMPILED = """
from armdyn import codegen, derive
codegen.c_model(derive.planar_chain(1), dict(l1=1, lc1=1, m1=1, I1=1, g=1))
"""
# Of what a kernel and a problem's first cell import: what was not there, and what had to be compiled.
UNCOMPILED = """import sympy, pathlib
of = {"IPython", "autograder", "numpy", "prompt_toolkit", "sympy", "traitlets"}
specs = [module.__spec__ for name, module in sys.modules.items() if name.partition(".")[0] in of]
specs = [spec for spec in specs if spec and (spec.origin or "").endswith(".py")]
print(of - {spec.name for spec in specs})
print([spec.name for spec in specs if not pathlib.Path(spec.cached).exists()])"""
NEVER = "def M(q, pend):\n    while True: pass"


def test_what_a_browser_lacks(site, needs, tmp_path):
    cells = {
        "later": f"{SETUP}\nimport sys\nprint([name for name in {LATER} if name in sys.modules])",
        "uncompiled": UNCOMPILED,
        "singular": "np.linalg.inv(np.zeros((2, 2)))",
        "by another": "np.linalg.matrix_power(np.zeros((2, 2)), -1)",
        "indefinite": "np.linalg.cholesky([[1, 2], [2, 1]])",
        "nan": "np.isnan(np.linalg.inv(np.full((2, 2), np.nan))).all()",
        "fine": "np.linalg.eigvalsh(2 * np.eye(2)).tolist()",
        "never": f"{NEVER}\ncheck('p3-M')",
        "file": "M = from_file('M.cpp')\ncheck('p3-M')",
        "closed": "print(sys.stderr.closed)",
        "C": COMPILED,
    }
    one = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(c) for c in cells.values()])
    (outputs,) = ran(site, needs, tmp_path, {"problems/p3-pendulum/lacks": one}).values()
    said = dict(zip(cells, map(json.dumps, outputs), strict=True))
    assert '"[]' in said["later"]
    assert "".join(part["text"] for part in outputs[1]) == "set()\n[]\n"
    assert "Singular matrix" in said["singular"]
    assert "Singular matrix" in said["by another"]
    assert "Matrix is not positive definite" in said["indefinite"]
    assert "True" in said["nan"]
    assert "[2.0, 2.0]" in said["fine"]
    assert "did not return within 8 s. Is there a loop that never ends?" in said["never"]
    assert "a browser runs no answers in other languages" in said["file"]
    assert "False" in said["closed"]
    assert "A browser has none" in said["C"]


def test_no_answer_is_in_the_site(site):
    from tests.notebooks.answer_lines import answer_lines, flat

    secret = answer_lines()
    texts = list((site / "files").rglob("*.ipynb"))
    shown = {path: flat(path.read_text(encoding="utf-8")) for path in texts}
    assert [(p.name, line) for p, text in shown.items() for line in secret if line in text] == []
    names = {path.name for path in site.rglob("*")}
    assert {"p3-pendulum.ipynb", "pendulum.svg", "01-canonical-form.ipynb"} <= names
    assert not names.intersection({"solutions", "course", "nbgrader_config.py", "tests"})


def sent_by_a_server(site: Path, url: str) -> int:
    """The bytes of a file of the site, compressed where servers do so."""
    path = site / unquote(urlsplit(url).path).lstrip("/")
    path = path / "index.html" if path.is_dir() else path
    data = path.read_bytes() if path.is_file() else b""
    return len(gzip.compress(data)) if path.suffix in COMPRESSED else len(data)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


@pytest.fixture(scope="module")
def served(site):
    handler = functools.partial(Quiet, directory=site)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture
def visitor(browser, served):
    """A page that reaches the site only; what it asked of others, and what it fetched."""
    context = browser.new_context(viewport={"width": 1366, "height": 900}, accept_downloads=True)
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    page.abroad, page.fetched = [], set()
    context.route(
        lambda url: not url.startswith((served, "data:", "blob:")),
        lambda route: (page.abroad.append(route.request.url), route.abort()),
    )

    context.on("requestfinished", lambda request: page.fetched.add(request.url))
    yield page
    context.close()


def opened(page, address: str, pictures, *title: str) -> Problem:
    """The notebook at this address, with a kernel that takes cells."""
    page.goto(address)
    expect(page.locator(".jp-Toolbar-kernelName")).to_contain_text("Python")
    expect(page.locator("#jp-main-statusbar")).to_contain_text("Idle")
    return Problem(page, pictures, *title)


def test_a_wrong_answer_gets_its_card_and_stays(visitor, site, served, tmp_path):
    page = visitor
    student = opened(page, f"{served}/{AT}problems/p3-pendulum/p3-pendulum.ipynb", tmp_path)
    expect(student.panel).to_contain_text("In the browser.")
    expect(student.panel.locator("img[alt*='rigid body']")).to_have_js_property("complete", True)
    student.run("from types import SimpleNamespace")
    student.run("def M(")
    expect(student.run('check("p3-M")')).to_contain_text("not attempted")
    sent = sum(sent_by_a_server(site, url) for url in page.fetched) / 1e6
    print(f"{sent:.1f} MB before the first card")
    assert sent < MOST_MB
    student.write("g_vec", COSINE)
    card = student.run('check("p3-g_vec")')
    expect(card).to_contain_text("the cosine of q where the sine belongs")
    student.picture("card")
    page.keyboard.press("Control+S")
    with page.expect_download() as download:
        page.locator(".lm-MenuBar-item", has_text="File").click()
        page.locator(".lm-Menu-item", has_text="Download").first.click()
    assert copy_of(download.value.suggested_filename, "p3-pendulum") == 0
    handed_in = nbformat.read(download.value.path(), as_version=4)
    assert any("np.cos(q)" in cell.source for cell in handed_in.cells)
    page.reload()
    expect(student.cell("def g_vec(")).to_contain_text("np.cos(q)")
    assert page.abroad == []


def test_a_lessons_slider_moves_its_picture(visitor, served, tmp_path):
    page = visitor
    where = f"{served}/{AT}lessons/01-canonical-form.ipynb"
    lesson = opened(page, where, tmp_path, "The canonical form of")
    lesson.run("import ipywidgets")
    lesson.run("arm = Planar2R(")
    lesson.run("@ipywidgets.interact(")
    control = lesson.cell("@ipywidgets.interact(")
    picture = control.locator(".jupyter-widgets img").first
    before = picture.get_attribute("alt")
    slider = control.locator(".noUi-handle").first
    slider.focus()
    page.keyboard.press("ArrowRight")
    expect(picture).not_to_have_attribute("alt", before)
    lesson.picture("slider")
    assert page.abroad == []
