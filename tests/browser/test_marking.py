"""`autograder mark` in a real browser: proofs are marked by the rubric, and by two people."""

import json
import re
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
import sqlalchemy
from nbgrader.api import Gradebook
from playwright.sync_api import expect

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.autograder.proofs.models import models
from tests.browser.conftest import PATIENCE
from tests.browser.test_pages import BEYOND, LOST
from tests.submissions.answers import answered, cell_of

AUTOGRADER = Path(sys.executable).with_name("autograder")
CELL = "p3-derivation"
HOSTILE = (
    "# Proof of Ada Lovelace\n\n$K=\\tfrac12 I\\dot q^2$ <script>document.title = 'run'</script>"
    "<img src=x onerror=\"document.title='run'\">\n\n![ada's page](page.svg)"
)
# As a hand does where the server is slow.
TWICE = """key => { for (const _ of [1, 2])
  document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true })); }"""
PROOFS = {"ada": HOSTILE, "bob": "I am sure.", "cem": "By *Newton*."}
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="40"><path d="M0 0h9"/></svg>'


@pytest.fixture(scope="module")
def taught(tmp_path_factory):
    """A course with three proofs to be read, one of them with lines that hold, and an empty one."""
    root = courses.new_course(tmp_path_factory.mktemp("marked") / "course")
    lines = f"def pendulum_lines():\n    return {models()['p3-L']!r}"
    for student, text in (PROOFS | {"nil": None}).items():
        notebook = answered(courses.release(root), **({"p3-L": lines} if student == "ada" else {}))
        if text:
            cell_of(notebook, CELL).source = text
        courses.submit(root, student, notebook)
    (root / "course" / "submitted" / "ada" / P3 / "page.svg").write_text(DRAWING)
    (root / "course" / "class.csv").write_text("id,last_name,first_name\nada,Lovelace,Ada\n")
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(root)
        assert main(["grade", P3, "--jobs", "1"]) == 0
    return root


@contextmanager
def marking(root, *arguments):
    """The address that the command says to open, and the list in which its last lines come."""
    said = []
    with subprocess.Popen(
        [AUTOGRADER, "mark", "--no-browser", *arguments],
        cwd=root,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        watch = threading.Timer(300, process.kill)
        watch.start()
        try:
            for line in process.stdout:
                said.append(line)
                if found := re.search(r"Open (\S+)", line):
                    yield found[1], said
                    break
            assert "Open" in "".join(said), said
            process.send_signal(signal.SIGINT)
            said += process.stdout
            assert process.wait(60) == 0, said
        finally:
            watch.cancel()
            process.kill()


@pytest.fixture
def tab(browser):
    """A page; `asked` has what it asked of others, and what went wrong."""
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    page = context.new_page()
    page.asked = []
    page.on("request", lambda one: page.asked.append(one.url)
            if not one.url.startswith(("http://127.0.0.1:", "data:")) else None)  # fmt: skip
    page.on("pageerror", lambda error: page.asked.append(str(error)))
    page.set_default_timeout(PATIENCE)
    yield page
    context.close()


def to(tab, text: str) -> None:
    """Go on to the answer with this text."""
    expect(tab.locator(".where")).to_contain_text("answer")
    for _ in range(4):
        if tab.locator(".answer").get_by_text(text).count():
            return
        go_on(tab)
    raise AssertionError(f"no answer says {text}")


def go_on(tab) -> None:
    """To the next answer: when it is there, and not as soon as this one is saved."""
    this = re.search(r"answer \d+ of", tab.locator(".where").inner_text())[0]
    tab.keyboard.press("n")
    expect(tab.locator(".where")).not_to_contain_text(this)


def rows(root) -> dict[str, tuple]:
    with Gradebook(courses.database(root)) as gradebook:
        found = {}
        for student in [*PROOFS, "nil"]:
            grade = gradebook.find_grade(CELL, P3, P3, student)
            comment = gradebook.find_comment(CELL, P3, P3, student)
            found[student] = grade.manual_score, grade.needs_manual_grade, comment.manual_comment
        return found


def test_three_proofs_are_marked_with_the_keyboard(taught, tab, tmp_path):
    with marking(taught, P3) as (address, said):
        tab.goto(address)
        expect(tab.locator(".where")).to_contain_text("answer 1 of 3 · 3 left to mark")
        assert "token" not in tab.url
        to(tab, "Proof of …")
        expect(tab.locator(".rubric li").nth(2)).to_contain_text("suggested by the lines")
        assert tab.locator(".answer math").count() > 0
        assert tab.locator(".model math").count() > 10
        assert tab.get_by_alt_text("…'s page").evaluate("e => e.naturalWidth") == 60
        for name in ("Ada", "Lovelace", "ada"):
            assert not re.search(rf"\b{name}\b", tab.locator("#page").inner_text())
        tab.screenshot(path=tmp_path / "marking.png", full_page=True)
        assert tab.evaluate(LOST) == 0
        assert tab.evaluate(BEYOND) == []
        for key in "135":
            tab.keyboard.press(key)
        tab.keyboard.press("c")
        tab.keyboard.type("Where is the *pivot*?")
        tab.keyboard.press("Escape")
        expect(tab.locator(".save")).to_contain_text("Save 3 of 5 points")
        go_on(tab)
        expect(tab.locator(".where")).to_contain_text("2 left to mark")

        to(tab, "I am sure.")
        tab.get_by_role("button", name="Where is the *pivot*?").click()
        tab.keyboard.press("0")
        saving = []
        tab.on("request", lambda one: saving.append(one) if "api/save" in one.url else None)
        tab.evaluate(TWICE, "s")
        expect(tab.get_by_role("status")).to_have_text("Saved: 0 of 5 points.")
        assert len(saving) == 1

        to(tab, "By Newton.")
        tab.get_by_label("Points for row 2").press_sequentially("0,5")
        tab.get_by_label("Points for row 4").fill("7")
        tab.locator(".save").click()
        expect(tab.get_by_role("status")).to_have_text("Row 4 takes 0 to 1 points.")
        tab.get_by_label("Points for row 4").fill("1")
        tab.locator(".save").click()
        expect(tab.locator(".where")).to_contain_text("all are marked")
        assert tab.title() != "run"
        assert tab.asked == []
    assert "All are marked." in said[-1]
    assert rows(taught) == {
        "ada": (3.0, False, "Where is the *pivot*?"),
        "bob": (0.0, False, "Where is the *pivot*?"),
        "cem": (1.5, False, None),
        "nil": (None, False, None),
    }
    assert not list((taught / "course" / "marking").glob("*.html"))


def test_the_returned_page_says_which_rows_were_met(taught, tab):
    courses.run(taught, "nbgrader", "generate_feedback", P3)
    folder = taught / "course" / "feedback"
    tab.goto((folder / "cem" / P3 / f"{P3}.html").as_uri())
    shown = [re.sub(r"\s+", " ", one) for one in tab.locator("ul.rubric li").all_inner_texts()]
    assert [one.split(" ")[0] for one in shown] == ["✗", "◐", "✗", "✓", "✗"]
    assert shown[1].startswith("◐ partly met 0.5 of 1")
    assert tab.locator("ul.rubric math").count() > 3
    assert '<ul class="rubric">' not in (folder / "nil" / P3 / f"{P3}.html").read_text()
    # Points from the formgrader are not explained by rows that somebody ticked before.
    with Gradebook(courses.database(taught)) as gradebook:
        gradebook.find_grade(CELL, P3, P3, "cem").manual_score = 4.0
        gradebook.db.commit()
    courses.run(taught, "nbgrader", "generate_feedback", P3)
    tab.reload()
    expect(tab.get_by_text("4 of 5").first).to_be_visible()
    assert tab.locator("ul.rubric").count() == 0


def test_a_second_marker_is_blind_and_the_first_one_chooses(taught, tab):
    before = rows(taught)
    with marking(taught, P3, "--second") as (address, _):
        tab.goto(address)
        expect(tab.locator(".where")).to_contain_text("3 left to mark")
        to(tab, "Proof of …")
        expect(tab.locator(".save")).to_contain_text("Save 0 of 5 points")
        assert not tab.get_by_text("Where is the *pivot*?").count()
        tab.keyboard.press("1")
        tab.keyboard.press("s")
        expect(tab.get_by_role("status")).to_have_text("Saved: 1 of 5 points.")
    assert rows(taught) == before
    with marking(taught, "--names") as (address, _):
        tab.goto("about:blank")
        tab.goto(address)
        tab.get_by_role("link", name="1 to decide").click()
        expect(tab.get_by_role("row").nth(1)).to_contain_text("Ada Lovelace")
        tab.get_by_role("button", name="these").click()
        expect(tab.get_by_role("status")).to_contain_text("Type the points")
        tab.get_by_role("button", name="second: 1").click()
        expect(tab.get_by_text("0 to decide")).to_be_visible()
        assert tab.evaluate(BEYOND) == []
    assert rows(taught)["ada"] == (1.0, False, "Where is the *pivot*?")
    kept = json.loads((taught / "course" / "marking" / f"{P3}.json").read_text())
    assert [kept[CELL]["ada"][by]["points"] for by in ("first", "second", "counts")] == [3, 1, 1]


def test_without_the_token_nothing_is_shown_and_a_locked_gradebook_is_waited_for(taught, tab):
    with marking(taught, P3) as (address, _):
        tab.goto(address.partition("#")[0])
        expect(tab.get_by_role("status")).to_contain_text(
            "Open the address that the terminal shows"
        )
        tab.goto("about:blank")
        tab.goto(address)
        to(tab, "I am sure.")
        engine = sqlalchemy.create_engine(courses.database(taught), poolclass=sqlalchemy.NullPool)
        with engine.connect() as other:
            other.exec_driver_sql("BEGIN EXCLUSIVE")
            tab.keyboard.press("2")
            tab.keyboard.press("s")
            time.sleep(6)  # SQLite itself gives up after five seconds
            assert tab.locator("#said").text_content() == ""
            tab.locator("#comment").fill("Typed while it waits.")
            other.exec_driver_sql("ROLLBACK")
        expect(tab.get_by_role("status")).to_have_text("Saved: 1 of 5 points.")
        assert rows(taught)["bob"][:2] == (1.0, False)
        expect(tab.locator(".rubric.touched")).to_be_visible()
        tab.locator(".save").click()
        expect(tab.locator(".rubric.touched")).to_have_count(0)
        assert rows(taught)["bob"] == (1.0, False, "Typed while it waits.")

        with Gradebook(courses.database(taught)) as gradebook:
            gradebook.find_grade(CELL, P3, P3, "bob").manual_score = 4.0
            gradebook.db.commit()
        tab.locator("#comment").fill("Mine.")
        tab.keyboard.press("Escape")
        tab.keyboard.press("n")
        expect(tab.get_by_role("status")).to_contain_text("somebody has marked it")
        tab.get_by_role("button", name="Open it again").click()
        expect(tab.get_by_role("status")).to_have_text(
            "This is what it has now. Your comment stands under “Said before”."
        )
        expect(tab.locator("#total")).to_have_value("4")
        tab.get_by_role("button", name="Mine.").click()
        tab.locator(".save").click()
        expect(tab.get_by_role("status")).to_have_text("Saved: 4 of 5 points.")
        tab.reload()
        expect(tab.locator(".answer").get_by_text("I am sure.")).to_be_visible()
    assert rows(taught)["bob"] == (4.0, False, "Typed while it waits.\n\nMine.")
