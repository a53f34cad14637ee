"""JupyterLab as `make lab` starts it, in a copy of the course, and a real browser to look at it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import expect, sync_playwright

from armdyn.ports.toolchain import processes

ROOT = Path(__file__).parents[2]
AUTOGRADER = Path(sys.executable).with_name("autograder")
# Chromium's own calls home are shut off: a test asks nothing of the network.
CHROMIUM = (
    "--no-sandbox",  # as root, Chromium has none
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
PATIENCE = 120_000  # ms
END_SECONDS = 30.0
SELF = ("file:", "data:")


@pytest.fixture(scope="package")
def course(tmp_path_factory):
    """A student's copy of the course, in a path with a space and letters beyond ASCII."""
    root = tmp_path_factory.mktemp("browser") / "Räume und Momente"
    root.mkdir()
    for folder in ("lessons", "solutions"):
        shutil.copytree(ROOT / folder, root / folder)
    shutil.copy(ROOT / "nbgrader_config.py", root)
    subprocess.run([AUTOGRADER, "problems"], cwd=root, check=True, capture_output=True)
    return root


@pytest.fixture(scope="package")
def address(course):
    """What `autograder lab` says to open, while it runs."""
    log = course / "jupyter.log"
    # Not as whoever runs the tests has set JupyterLab: its theme, say.
    environment = os.environ | {"JUPYTERLAB_SETTINGS_DIR": str(course / ".venv" / "settings")}
    with (
        log.open("w") as errors,
        processes.start(
            # Through files: a port that is free when a kernel is given it may be another test's then.
            [AUTOGRADER, "lab", "--no-browser", "--port=0", "--KernelManager.transport=ipc"],
            cwd=course,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
        ) as server,
    ):
        try:
            said = (re.search(r"Open (\S+)", line) for line in server.stdout)
            found = next(filter(None, said), None)
            assert found, log.read_text()
            yield found.group(1)
        finally:
            server.terminate()
            processes.end(server, END_SECONDS)


@pytest.fixture(scope="package")
def browser(needs):
    """Chromium."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=needs("chromium"), headless=True, args=CHROMIUM
        )
        # Generous, for a machine that is busy with other things; what is there sooner is seen sooner.
        expect.set_options(timeout=PATIENCE)
        yield browser
        browser.close()


@pytest.fixture(scope="package")
def page(browser, address):
    """The address opened in Chromium, on a small laptop, as a student first sees it."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.set_default_timeout(PATIENCE)
    page.goto(address)
    return page


@pytest.fixture
def opened(page, address):
    """Opens a notebook, or none, beside no other: the layout of the first start stays as it is."""

    def open_alone(path: str = "") -> None:
        there = f"/lab/workspaces/other/tree/{path}" if path else "/lab/workspaces/other"
        page.goto(re.sub(r"/lab[^?]*", there, address) + "&reset")

    return open_alone


@pytest.fixture
def terminal(course):
    """What JupyterLab and its kernels have printed so far, beside the address."""
    return lambda: (course / "jupyter.log").read_text()


@pytest.fixture
def tab(browser, request):
    """A tab without a network; whether it runs scripts is the test's parameter."""
    context = browser.new_context(java_script_enabled=getattr(request, "param", True))
    context.route(re.compile(r"^(?!file:)"), lambda route: route.abort())
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE)
    tab.trouble = []
    tab.on("pageerror", lambda error: tab.trouble.append(str(error)))
    tab.on("request", lambda r: tab.trouble.append(r.url) if r.url[:5] not in SELF else None)
    yield tab
    context.close()


@pytest.fixture
def clock(tab):
    """The tab's clock, which goes on by `run_for(ms)` alone: nothing plays on while a test waits."""
    tab.clock.install(time=0)
    tab.clock.pause_at(1000)
    return tab.clock
