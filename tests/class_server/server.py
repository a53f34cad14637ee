"""A class server, set up on this machine by the commands of docs/class-server.md, and taken down."""

import os
import re
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

import requests

from tests.class_server.document import sections

ROOT = Path(__file__).parents[2]
PATIENCE = 120.0  # s
PASSWORD = "correct horse battery staple"
ACCOUNTS = ("ada", "bob", "ines", "grader-armdyn", "grader-statics")
GROUPS = ("armdyn-class", "statics-class", "course-graders")
# Nobody of this machine has such a name.
OURS = {name: f"armdyn-test-{name.replace('armdyn-', '')}" for name in (*ACCOUNTS, *GROUPS)}


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


class ClassServer:
    """The page's machine. `place`: where section 1 has installed; `folder`: for what is in /srv."""

    def __init__(self, place: Path, folder: Path):
        self.place, self.folder = place, folder
        self.graders_place = place.with_name(f"{place.name}-graders")
        self.address = f"127.0.0.1:{free_port()}"
        self.blocks = sections()
        self.done: set[tuple[int, int]] = set()
        self.environment = {"LANG": "C.UTF-8"}
        self.hub: subprocess.Popen | None = None

    def here(self, text: str) -> str:
        """A text of the page with the names of this machine."""
        for there, ours in {
            "/opt/armdyn": str(self.place),
            "/srv/armdyn": str(self.folder),
            "127.0.0.1:8000": self.address,
        }.items():
            text = text.replace(there, ours)
        names = "|".join(map(re.escape, sorted(OURS, key=len, reverse=True)))
        return re.sub(rf"(?<![\w-])({names})(?![\w-])", lambda found: OURS[found[1]], text)

    def run(self, section: int, number: int = 0) -> str:
        """Run one block of a section as the page says; what it printed."""
        account, script = self.blocks[section][number]
        self.done.add((section, number))
        return self.as_account(account, self.here(script))

    def as_account(self, account: str, script: str, status: int = 0) -> str:
        """Run a script as an account of the page; what it printed."""
        place = self.graders_place if account.startswith("grader-") else self.place
        environment = self.environment | {"PATH": f"{place}/bin:{os.environ['PATH']}"}
        given = [f"export {name}='{value}'\n" for name, value in environment.items()]
        command = ["bash", "-euc", "".join(given) + script]
        if account != "root":
            command = ["runuser", "-l", OURS.get(account, account), "-c", command[-1]]
            command[-1] = "set -eu\n" + command[-1]
        ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        assert ran.returncode == status, f"{account}: {script}\n{ran.stdout}{ran.stderr}"
        return ran.stdout + ran.stderr

    def home(self, account: str) -> Path:
        import pwd  # not on Windows

        return Path(pwd.getpwnam(OURS[account]).pw_dir)

    def set_passwords(self, *accounts: str) -> None:
        lines = "".join(f"{OURS[name]}:{PASSWORD}\n" for name in accounts)
        subprocess.run(["chpasswd"], input=lines, text=True, check=True)

    def start(self, section: int, number: int, *arguments: str) -> None:
        """Start the hub by its block, but on ports that are free, and with these arguments."""
        account, script = self.blocks[section][number]
        self.done.add((section, number))
        assert account == "root"
        added = (
            f"--JupyterHub.hub_port={free_port()}",
            f"--ConfigurableHTTPProxy.api_url=http://127.0.0.1:{free_port()}",
            *arguments,
        )
        script = " ".join([self.here(script).rstrip(), *added])
        with (self.folder / "hub.log").open("wb") as log:
            self.hub = subprocess.Popen(
                ["bash", "-euc", script],
                stdout=log,
                stderr=log,
                env=self.environment | {"PATH": f"{self.place}/bin:{os.environ['PATH']}"},
                start_new_session=True,
            )
        self.wait(lambda: requests.get(f"http://{self.address}/hub/login", timeout=5).ok)

    def wait(self, what) -> None:
        """Wait until `what` gives something true; it may fail until then."""
        deadline = time.monotonic() + PATIENCE
        while True:
            assert self.hub is None or self.hub.poll() is None, self.log()
            try:
                if what():
                    return
            except requests.ConnectionError:
                pass
            assert time.monotonic() < deadline, self.log()
            time.sleep(0.2)

    def log(self) -> str:
        return (self.folder / "hub.log").read_text()[-4000:]

    def stop(self) -> None:
        """End the hub and its servers, and remove every account and group."""
        if self.hub is not None:
            # It waits long for each JupyterLab to end by itself.
            end_processes()
            self.hub.send_signal(signal.SIGINT)
            try:
                self.hub.wait(20)
            except subprocess.TimeoutExpired:
                os.killpg(self.hub.pid, signal.SIGKILL)
        remove_accounts()
        shutil.chown(self.graders_place, group="root")
        self.graders_place.chmod(0o700)
        for name in (
            "etc/jupyter/jupyter_server_config.py",
            "etc/jupyter/nbgrader_config.py",
            "etc/jupyter/labconfig",
            "share/jupyter/lab/settings",
        ):
            for place in (self.place, self.graders_place):
                left = place / name
                shutil.rmtree(left) if left.is_dir() else left.unlink(missing_ok=True)


def remove_accounts() -> None:
    """Remove what a run has made, also one that was killed; with the processes of these accounts."""
    for name in end_processes():
        subprocess.run(["userdel", "--remove", OURS[name]], capture_output=True)
    for name in GROUPS:
        subprocess.run(["groupdel", OURS[name]], capture_output=True)


def end_processes() -> list[str]:
    """End what our accounts run; the accounts that are there."""
    import pwd

    there = []
    for name in ACCOUNTS:
        try:
            end_processes_of(pwd.getpwnam(OURS[name]).pw_uid)
            there.append(name)
        except KeyError:
            pass
    return there


def end_processes_of(user: int) -> None:
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            found = re.search(r"^Uid:\s+(\d+)", status.read_text(), re.M)
            if found and int(found[1]) == user:
                os.kill(int(status.parent.name), signal.SIGKILL)
        except (FileNotFoundError, ProcessLookupError):
            pass


class Person:
    """Somebody who is logged in to the hub, and calls its servers by HTTP as a browser would."""

    def __init__(self, server: ClassServer, name: str):
        self.server, self.name = server, OURS[name]
        self.session = requests.Session()
        self.base = f"http://{server.address}"
        self.session.get(f"{self.base}/hub/login")
        reply = self.session.post(
            f"{self.base}/hub/login",
            params={"_xsrf": self.session.cookies.get("_xsrf", path="/hub/")},
            data={"username": self.name, "password": PASSWORD, "_xsrf": self.xsrf("/hub/")},
            allow_redirects=False,
        )
        assert reply.status_code == 302, reply.text

    def xsrf(self, path: str) -> str:
        found = [c.value for c in self.session.cookies if c.name == "_xsrf" and c.path == path]
        return found[0] if found else ""

    def hub(self, method: str, path: str, **options) -> requests.Response:
        """Call the hub's API."""
        self.session.get(f"{self.base}/hub/home")
        return self.session.request(
            method,
            f"{self.base}/hub/api/{path}",
            headers={"X-XSRFToken": self.xsrf("/hub/"), "Referer": f"{self.base}/hub/home"},
            **options,
        )

    def start(self, whose: str | None = None) -> None:
        """Start a JupyterLab, one's own unless told otherwise, and wait until it answers."""
        whose = self.name if whose is None else OURS[whose]
        reply = self.hub("POST", f"users/{whose}/server")
        assert reply.status_code in (201, 202), reply.text
        self.server.wait(lambda: self.opens("lab", whose))

    def restart(self) -> None:
        """Stop one's own JupyterLab and start it again."""
        assert self.hub("DELETE", f"users/{self.name}/server").status_code in (202, 204)
        self.server.wait(lambda: not self.get("api/status").ok)
        self.start()

    def opens(self, path: str, whose: str) -> bool:
        """Whether a page of that JupyterLab is shown; the first time, this logs in to it."""
        reply = self.get(path, whose)
        return reply.ok and reply.url.startswith(f"{self.base}/user/{whose}/")

    def get(self, path: str, whose: str | None = None) -> requests.Response:
        return self.session.get(f"{self.base}/user/{whose or self.name}/{path}", timeout=60)

    def start_kernel(self) -> None:
        """Start a kernel, which needs some seconds before it listens."""
        own = f"/user/{self.name}/"
        started = self.session.post(
            f"{self.base}{own}api/kernels", headers={"X-XSRFToken": self.xsrf(own)}, timeout=60
        )
        assert started.status_code == 201, started.text

    def post(self, button: str, /, **data: str) -> dict:
        """Press a button of Assignment List; what it answers."""
        own = f"/user/{self.name}/"
        self.get("lab")
        reply = self.session.post(
            f"{self.base}{own}{button}",
            data=data,
            headers={"X-XSRFToken": self.xsrf(own)},
            timeout=PATIENCE,
        )
        assert reply.ok, reply.text
        return reply.json()
