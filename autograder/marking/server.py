"""Serves the page for marking to one person, on this machine alone.

Every request but for the empty page brings the token in a header of its own, which no other page can
send: there is no cookie that a browser would add by itself. Names other than this machine's are refused,
so that no other site's name can be made to lead here.
"""

import asyncio
import hmac
import json
import logging
import secrets
import socket
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from importlib import resources
from urllib.parse import urlsplit

from tornado.httpserver import HTTPServer
from tornado.web import Application, RequestHandler

from autograder.marking.asked import AskedError
from autograder.marking.desk import ChangedError, Desk

log = logging.getLogger(__name__)

ADDRESS = "127.0.0.1"
OURS = {ADDRESS, "localhost"}
MOST_BYTES = 1 << 20  # of a request
KINDS = {"html": "text/html", "css": "text/css", "js": "text/javascript"}
HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; connect-src 'self'; "
    "style-src 'self' 'unsafe-inline'; img-src data:; form-action 'none'; base-uri 'none'; "
    "frame-ancestors 'none'",
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


def serve(desk: Desk, style: str, port: int, ready: Callable[[str], None]) -> None:
    """Serve until KeyboardInterrupt. style: of students' cells. port: 0 for a free one.

    ready: called with the address, in which the token stands behind the #, where no server and no log
    sees it. OSError if the port is in use.
    """
    token = secrets.token_urlsafe(32)
    # One at a time: of two requests for the same answer, the second sees what the first one did.
    with ThreadPoolExecutor(1) as pool, socket.socket() as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind((ADDRESS, port))
        listening.listen(64)
        listening.setblocking(False)
        server = HTTPServer(application(desk, style, token, pool), max_body_size=MOST_BYTES)

        async def run() -> None:
            server.add_socket(listening)
            ready(f"http://{ADDRESS}:{listening.getsockname()[1]}/#token={token}")
            await asyncio.Event().wait()

        logging.getLogger("tornado.access").setLevel(logging.CRITICAL)
        asyncio.run(run())


def application(desk: Desk, style: str, token: str, pool: ThreadPoolExecutor) -> Application:
    folder = resources.files(__package__) / "page"
    files = {
        name: (folder / name).read_text(encoding="utf-8")
        for name in ("index.html", "marking.css", "marking.js", "rubric.js", "elements.js")
    }
    files["page.css"] = style
    asked = {"token": token, "desk": desk, "pool": pool}
    return Application(
        [(r"/(|[\w.]+)", File, {"files": files}), (r"/api/([\w-]+)", Asked, asked)],
        default_handler_class=File,
        default_handler_args={"files": {}},
    )


class OnlyHere(RequestHandler):
    """Answers what is asked of this machine by its own name, and by no other site's page."""

    def set_default_headers(self) -> None:
        self.clear_header("Server")
        for name, value in HEADERS.items():
            self.set_header(name, value)

    def prepare(self) -> None:
        host = self.request.headers.get("Host", "")
        origin = self.request.headers.get("Origin")
        if _name(host) not in OURS:
            self.refuse(403, "This address is not this machine's.")
        elif origin is not None and urlsplit(origin).netloc != host:
            self.refuse(403, "Another site's page asks for this.")

    def refuse(self, status: int, why: str) -> None:
        self.set_status(status)
        self.finish({"error": why})

    def write_error(self, status_code: int, **about) -> None:
        self.finish({"error": "The server could not do this; its terminal says more."})


class File(OnlyHere):
    """A part of the page, which is the same for everybody."""

    def initialize(self, files: dict[str, str]) -> None:
        self._files = files

    def get(self, name: str = "?") -> None:
        name = name or "index.html"
        if name not in self._files:
            return self.refuse(404, "There is nothing here.")
        self.set_header("Content-Type", f"{KINDS[name.rpartition('.')[2]]}; charset=utf-8")
        self.finish(self._files[name])
        return None


class Asked(OnlyHere):
    """A question to the desk, or something to be done, from who has the token."""

    def initialize(self, token: str, desk: Desk, pool: ThreadPoolExecutor) -> None:
        self._token, self._pool = token, pool
        self._questions: dict[str, Callable[..., object]] = {
            "proofs": desk.proofs,
            "proof": desk.proof,
            "answer": desk.answer,
            "differences": desk.differences,
        }
        self._acts: dict[str, Callable[..., object]] = {
            "save": desk.save,
            "take-back": desk.take_back,
            "choose": desk.choose,
        }

    def prepare(self) -> None:
        super().prepare()
        given = self.request.headers.get("Authorization", "").removeprefix("token ")
        if not self._finished and not hmac.compare_digest(given.encode(), self._token.encode()):
            self.refuse(403, "Open the address that the terminal shows: this page has no token.")

    async def get(self, name: str) -> None:
        wanted = {key: self.get_query_argument(key) for key in self.request.query_arguments}
        await self._answer(self._questions.get(name), wanted)

    async def post(self, name: str) -> None:
        try:
            said = json.loads(self.request.body)
        except ValueError:
            said = None
        if not isinstance(said, dict):
            return self.refuse(400, "The request is no JSON object.")
        await self._answer(self._acts.get(name), {"said": said})
        return None

    async def _answer(self, does: Callable[..., object] | None, given: dict) -> None:
        if does is None:
            return self.refuse(404, "There is nothing here.")
        loop = asyncio.get_running_loop()
        try:
            self.finish(json.dumps(await loop.run_in_executor(self._pool, lambda: does(**given))))
        except ChangedError as error:
            self.refuse(409, str(error))
        except (AskedError, TypeError) as error:
            self.refuse(400, str(error))
        except (OSError, ValueError) as error:  # the gradebook, a file, the class list
            log.error("%s", error)
            self.refuse(500, str(error))
        return None


def _name(host: str) -> str:
    return urlsplit(f"//{host}").hostname or ""
