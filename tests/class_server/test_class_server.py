"""A class server by docs/class-server.md, from the first account to a student's feedback.

The tests are one term and build on each other. Ada and the instructor use a browser; Bob's requests are
made by hand.
"""

import json
import os
import re
import shlex
import shutil
import tempfile
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import expect, sync_playwright

from tests.autograder.bundle import references
from tests.autograder.postgresql import running
from tests.browser.conftest import CHROMIUM, PATIENCE
from tests.browser.test_assignment_list import AssignmentList
from tests.class_server import trespass
from tests.class_server.document import PAGE
from tests.class_server.server import OURS, PASSWORD, ClassServer, Person, remove_accounts
from tests.submissions import p3_pendulum

P3, P4 = "p3-pendulum", "p4-gravity"
PLACE = os.environ.get("ARMDYN_CLASS_SERVER", "")
GRADER = "grader-armdyn"


@pytest.fixture(scope="module")
def server(needs):
    """The machine of the page, with its hub running and p3 released."""
    if os.name != "posix" or os.geteuid() != 0:
        pytest.skip("run the tests as root to set up the class server of docs/class-server.md")
    if not PLACE:
        pytest.skip(
            "set ARMDYN_CLASS_SERVER to the folder of section 1 of docs/class-server.md to run its test"
        )
    needs("bubblewrap")
    programs = Path(needs("postgresql")).resolve().parent
    remove_accounts()
    folder = Path(tempfile.mkdtemp(prefix="class-server-"))
    folder.chmod(0o755)
    server = ClassServer(Path(PLACE), folder)
    try:
        with running(programs, "postgres", "peer") as socket:
            socket.chmod(0o711)
            server.environment["PGHOST"] = str(socket)
            for section, number in ((2, 0), (3, 0), (3, 1), (4, 0), (4, 1), (5, 0)):
                server.run(section, number)
            server.set_passwords("ada", "bob", "ines")
            server.start(5, 1, f"--Spawner.environment=PGHOST={socket}")
            server.run(6, 0)
            yield server
    finally:
        server.stop()
        shutil.rmtree(folder)


@pytest.fixture(scope="module")
def postgresql(server):
    """The gradebook is in a server that knows by the account who asks."""
    server.run(7, 0)
    server.run(7, 1)


@pytest.fixture(scope="module")
def browser(needs):
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=needs("chromium"), headless=True, args=CHROMIUM
        )
        expect.set_options(timeout=PATIENCE)
        yield browser
        browser.close()


def logged_in(browser, server, name: str):
    """A browser of that person's own, after the hub's login."""
    page = browser.new_context(viewport={"width": 1366, "height": 768}).new_page()
    page.set_default_timeout(PATIENCE)
    page.goto(f"http://{server.address}/hub/login")
    page.locator("input[name=username]").fill(OURS[name])
    page.locator("input[name=password]").fill(PASSWORD)
    page.locator("input[name=password]").press("Enter")
    return page


@pytest.fixture(scope="module")
def ada(browser, server):
    page = logged_in(browser, server, "ada")
    expect(page.locator(".jp-DirListing-itemName", has_text="lessons")).to_be_visible()
    return page


@pytest.fixture(scope="module")
def bob(server):
    bob = Person(server, "bob")
    bob.start()
    return bob


def work_of(server, name: str) -> Path:
    return server.home(name) / "armdyn" / P3 / f"{P3}.ipynb"


def solve(server, name: str, answers) -> None:
    """Write a student's answers into the fetched notebook, which stays the student's."""
    path = work_of(server, name)
    nbformat.write(answers(nbformat.read(path, as_version=4)), path)


def menu_of(page) -> list[str]:
    page.locator(".lm-MenuBar-item", has_text="Nbgrader").click()
    expect(page.locator(".lm-Menu-itemLabel")).not_to_have_count(0)
    names = page.locator(".lm-Menu-itemLabel").all_text_contents()
    page.keyboard.press("Escape")
    return [name for name in names if name]


def submitted_folder(server, name: str, course: str = "armdyn") -> Path:
    inbound = server.folder / "exchange" / course / "inbound"
    (found,) = inbound.glob(f"{OURS[name]}+*")
    return found


def test_a_student_fetches_validates_and_submits_in_the_browser(server, ada, tmp_path):
    assert menu_of(ada) == ["Assignment List"]
    listed = AssignmentList(ada)
    ada.locator("#course_list_dropdown").click()
    ada.locator("#course_list a", has_text="armdyn").click()
    listed.press("released", P3, "Fetch")
    expect(listed.row("fetched", P3)).to_have_count(1)
    solve(server, "ada", p3_pendulum.right)
    listed.row("fetched", P3).get_by_role("button", name=P3).click()
    listed.press("fetched", P3, "Validate")
    dialog = ada.locator(".jp-Dialog")
    expect(dialog).to_contain_text("Success")
    dialog.get_by_role("button", name="Ok").click()
    listed.press("fetched", P3, "Submit")
    expect(listed.row("submitted", P3)).to_have_count(1)
    ada.screenshot(path=tmp_path / "submitted.png")
    assert "news" not in ada.locator("body").inner_text()
    assert submitted_folder(server, "ada").owner() == OURS["ada"]


def test_another_does_so_by_the_servers_requests(server, bob):
    released = bob.get("assignments?course_id=armdyn").json()
    assert [a["assignment_id"] for a in released["value"]] == [P3]
    action = {"assignment_id": P3, "course_id": "armdyn"}
    assert bob.post("assignments/fetch", **action)["success"]
    solve(server, "bob", p3_pendulum.partly_right)
    validated = bob.post("assignments/validate", path=f"armdyn/{P3}/{P3}.ipynb")
    assert "p3-g_vec" in json.dumps(validated)
    assert bob.post("assignments/submit", **action)["success"]
    assert submitted_folder(server, "bob").owner() == OURS["bob"]


def tried(server, who: str, **paths: list[Path]) -> list[str]:
    """What that account got of these paths, which are all there."""
    given = {name: [] for name in ("read", "list", "write", "folders")}
    for name, found in paths.items():
        assert all(path.exists() for path in found)
        given[name] = list(map(str, found))
    probe = Path(trespass.__file__).read_text()
    command = ["python3", "-c", probe, json.dumps(given)]
    return json.loads(server.as_account(who, shlex.join(command)))


def test_a_student_is_told_what_is_wrong_and_may_ask_for_hints(server, bob):
    code = (
        "from autograder import check, hint; hint('p3-M'); M = lambda q, pend: 0.0; check('p3-M')"
    )
    said = server.as_account("bob", f"cd ~/armdyn/{P3}; python -c {shlex.quote(code)}", status=1)
    assert "Hint 1 of 3" in said
    assert "p3-M: incorrect" in said
    assert "version" not in said


def test_a_students_python_holds_no_answers(server, bob):
    """Neither a function that gives one, nor a way to the graders' packages."""
    looked = server.as_account(
        "bob", f"python -c {shlex.quote(Path(references.__file__).read_text())}"
    )
    found = json.loads(looked)
    assert found["tried"] > 500
    assert not found["right"]
    packages = next(server.graders_place.glob("lib/python3*/site-packages"))
    asked = "python -c 'import autograder.mutation'"
    for way in ("", f"PYTHONPATH={packages} "):
        said = server.as_account("bob", way + asked, status=1)
        assert "No module named 'autograder.mutation'" in said
    within = packages / "autograder" / "mutation"
    python = server.graders_place / "bin" / "python"
    given = {"read": [python, within / "checks.py"], "list": [within, server.graders_place]}
    assert tried(server, "bob", **given) == []
    assert len(tried(server, GRADER, **given)) == 4


def test_students_cannot_read_or_change_each_others_work(server):
    """Even one who knows each name, where a name is secret."""
    for who, whose in (("ada", "bob"), ("bob", "ada")):
        home, handed_in = server.home(whose), submitted_folder(server, whose)
        notebook = handed_in / f"{P3}.ipynb"
        cached = next((home / ".local/share/jupyter/nbgrader_cache").rglob("submission_secret.txt"))
        got = tried(
            server,
            who,
            read=[work_of(server, whose), notebook, handed_in / "submission_secret.txt", cached],
            list=[home, handed_in, handed_in.parent],
            write=[work_of(server, whose), notebook],
            folders=[home / "armdyn", handed_in],
        )
        assert got == []
        # The same attempts, by the one whose work it is: they find what they look for.
        own = tried(server, whose, read=[work_of(server, whose), notebook], write=[notebook])
        assert len(own) == 3


def test_nor_open_each_others_jupyterlab(server, bob, ada):
    for whose in ("ada", GRADER):
        for path in ("api/contents", "lab"):
            reply = bob.get(path, OURS[whose])
            assert not reply.ok, reply.url
    assert bob.hub("POST", f"users/{OURS[GRADER]}/server").status_code in (403, 404)


def listening(user: int) -> int:
    """On how many ports of this machine an account's programs listen."""
    found = 0
    for table in ("tcp", "tcp6"):
        for line in Path("/proc/net", table).read_text().splitlines()[1:]:
            _, _, _, state, _, _, _, owner, *_ = line.split()
            found += state == "0A" and int(owner) == user
    return found


def test_nor_listen_to_each_others_kernels(server, bob):
    """A kernel tells all who can reach it what it runs and prints; on ports, these are all accounts."""
    user = server.home("bob").stat().st_uid
    before = listening(user)
    bob.start_kernel()
    folder = server.home("bob") / ".local" / "share" / "jupyter" / "runtime"
    server.wait(lambda: list(folder.glob("kernel-*-ipc-*")))
    (described,) = folder.glob("kernel-*.json")
    assert json.loads(described.read_text())["transport"] == "ipc"
    # ipykernel takes the output of its own child processes at a port, and says nothing there.
    assert listening(user) <= before + 1
    sockets = [described, *folder.glob("kernel-*-ipc-*")]
    assert tried(server, "ada", read=[described], list=[folder], write=sockets) == []


def test_a_hand_in_under_anothers_name_is_not_collected(server, bob, postgresql):
    real = submitted_folder(server, "ada")
    forged = real.parent / f"{OURS['ada']}+{P3}+2999-01-01 00:00:00.000000 UTC+x"
    server.as_account("bob", f"mkdir '{forged}'; cp ~/armdyn/{P3}/{P3}.ipynb '{forged}'")
    graded = server.run(6, 1)
    assert f"it belongs to the account {OURS['bob']}" in graded
    shutil.rmtree(forged)
    lines = {
        name: next(line for line in graded.splitlines() if line.lstrip().startswith(OURS[name]))
        for name in ("ada", "bob")
    }
    whole = sum(p3_pendulum.POINTS.values())
    assert f"{whole:g}" in lines["ada"].split()
    assert f"{whole - 1.5 - 2:g}" in lines["bob"].split()


def test_students_cannot_read_solutions_seed_or_gradebook(server, postgresql):
    course = server.home(GRADER) / "armdyn"
    for who in ("ada", "bob"):
        got = tried(
            server,
            who,
            read=[
                course / "solutions" / P3 / f"{P3}.ipynb",
                course / "course" / "seed",
                course / "course" / "gradebook.db",
                course / "course" / "submitted" / OURS["ada"] / P3 / f"{P3}.ipynb",
                course / "course" / "feedback" / OURS["ada"] / P3 / f"{P3}.html",
                server.folder / "hub" / "cookie_secret",
                server.folder / "hub" / "jupyterhub.sqlite",
            ],
            list=[course, server.folder / "exchange" / "armdyn" / "feedback"],
            write=[server.folder / "exchange" / "armdyn" / "outbound" / P3 / f"{P3}.ipynb"],
            folders=[course, server.folder / "exchange" / "armdyn" / "outbound" / P3],
        )
        assert got == []
        refused = server.as_account(who, "psql armdyn -c 'select * from grade'", status=2)
        assert "does not exist" in refused
    rows = server.as_account(GRADER, "psql armdyn -At -c 'select count(*) from grade'")
    assert int(rows) > 10


def test_feedback_comes_back(server, ada, bob, tmp_path):
    action = {"assignment_id": P3, "course_id": "armdyn"}
    assert bob.post("assignments/fetch_feedback", **action)["success"]
    ada.locator("#refresh_assignments_list").click()
    listed = ada.locator("#submitted_assignments_list > .list_item", has_text=P3)
    expect(listed).to_contain_text("feedback available")
    listed.get_by_role("button", name="Fetch Feedback", exact=True).click()
    expect(listed.get_by_text("view feedback")).to_be_visible()
    ada.screenshot(path=tmp_path / "feedback.png")
    for name, says in (("ada", "p3-g_vec: correct"), ("bob", "p3-g_vec: incorrect")):
        (page,) = (work_of(server, name).parent / "feedback").rglob(f"{P3}.html")
        assert page.owner() == OURS[name]
        assert says in page.read_text()


def test_the_instructor_opens_the_formgrader_of_the_course(browser, server, postgresql, tmp_path):
    page = logged_in(browser, server, "ines")
    page.goto(f"http://{server.address}/hub/spawn/{OURS[GRADER]}")
    page.get_by_role("button", name="Authorize").click()
    expect(page.locator(".jp-DirListing-itemName", has_text="armdyn")).to_be_visible()
    assert "Formgrader" in menu_of(page)
    page.goto(f"http://{server.address}/user/{OURS[GRADER]}/formgrader/manage_submissions/{P3}")
    for name, score in (("ada", "10"), ("bob", "6.5")):
        row = page.locator("tr", has=page.get_by_text(OURS[name], exact=True))
        expect(row).to_contain_text(f"{score} / 15")
    page.screenshot(path=tmp_path / "formgrader.png")


def test_another_course_has_its_own_class(server, bob):
    server.run(8, 0)
    server.run(8, 1)
    bob.restart()
    action = {"assignment_id": P4, "course_id": "statics"}
    assert bob.post("assignments/fetch", **action)["success"]
    assert (server.home("bob") / "statics" / P4 / f"{P4}.ipynb").is_file()
    assert bob.post("assignments/submit", **action)["success"]
    handed_in = submitted_folder(server, "bob", "statics")
    outbound = server.folder / "exchange" / "statics" / "outbound"
    for who in ("ada", GRADER):
        got = tried(
            server,
            who,
            read=[handed_in / f"{P4}.ipynb", outbound / P4 / f"{P4}.ipynb"],
            list=[outbound, handed_in, server.home("grader-statics")],
            folders=[handed_in],
        )
        assert got == []
    assert len(tried(server, "grader-statics", read=[handed_in / f"{P4}.ipynb"])) == 1


def test_the_students_package_gets_a_problem_more(server, bob):
    ask = "python -c \"from autograder import hint; hint('p4-g_vec')\""
    assert "there is no check 'p4-g_vec'" in server.as_account("bob", ask, status=1)
    server.run(6, 2)
    server.run(6, 3)
    assert "Hint 1 of 3" in server.as_account("bob", ask)
    assert not (server.home(GRADER) / "package").exists()


def test_each_command_of_the_page_has_been_run(server):
    shown = {(section, n) for section, blocks in server.blocks.items() for n in range(len(blocks))}
    # Section 1 has been run before, by whoever set ARMDYN_CLASS_SERVER.
    assert shown - server.done == {(1, 0), (1, 1), (1, 2)}
    packages = server.blocks[1][0].script.split()
    assert packages[:3] == ["apt-get", "install", "--yes"]
    asked = (Path(__file__).parents[2] / ".ci" / "machine").read_text(encoding="utf-8")
    installed = {
        name for part in re.findall(r"packages\+?=\(([^)]*)\)", asked) for name in part.split()
    }
    assert set(packages[3:]) <= installed
    folder, start = server.blocks[5][1].script.splitlines()
    unit = re.search(r"^```ini\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)[1]
    assert f"WorkingDirectory={folder.removeprefix('cd ')}\n" in unit
    assert f"ExecStart=/opt/armdyn/bin/{start.partition('exec ')[2]}\n" in unit
