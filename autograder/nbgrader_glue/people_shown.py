"""How the formgrader's pages call students: by the class list where the gradebook has no name, as of who
was only collected, and by the id where nobody knows a name.
"""

import json
from importlib import resources
from pathlib import Path

from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.utils import url_path_join
from nbgrader.server_extensions.formgrader import apihandlers, handlers
from nbgrader.server_extensions.formgrader.base import check_notebook_dir, check_xsrf
from tornado import web

from autograder import roster

# nbgrader's scripts that write a student's name into a table, and what comes behind them.
SCRIPTS = ("manage_students", "manage_submissions")
BEHIND = "templates/formgrade/without_name.js"


class Students(apihandlers.StudentCollectionHandler):
    """nbgrader's list of all students, with names."""

    @web.authenticated
    @check_xsrf
    @check_notebook_dir
    def get(self) -> None:
        self.write(json.dumps(named(self.coursedir.root, self.api.get_students(), "id")))


class Submissions(apihandlers.SubmissionCollectionHandler):
    """nbgrader's list of an assignment's submissions, with names."""

    @web.authenticated
    @check_xsrf
    @check_notebook_dir
    def get(self, assignment_id: str) -> None:
        found = self.api.get_submissions(assignment_id)
        self.write(json.dumps(named(self.coursedir.root, found, "student")))


class Submission(apihandlers.SubmissionHandler):
    """nbgrader's answer about one submission, with the name."""

    @web.authenticated
    @check_xsrf
    @check_notebook_dir
    def get(self, assignment_id: str, student_id: str) -> None:
        if (found := self.api.get_submission(assignment_id, student_id)) is None:
            raise web.HTTPError(404)
        self.write(json.dumps(named(self.coursedir.root, [found], "student")[0]))


class Script(JupyterHandler):
    """A script of nbgrader's with our lines behind it."""

    @web.authenticated
    def get(self, name: str) -> None:
        theirs = Path(handlers.static_path) / "js" / f"{name}.js"
        ours = resources.files(__package__).joinpath(BEHIND)
        self.set_header("Content-Type", "text/javascript; charset=utf-8")
        self.finish("\n".join(one.read_text(encoding="utf-8") for one in (theirs, ours)))


def named(root: str, found: list[dict], id: str) -> list[dict]:
    """What nbgrader tells of students, in which `id` is the key of a student's id, with the class list's
    names where the gradebook has none. A class list that is wrong names nobody: the commands say why.
    """
    try:
        people = roster.read_if_there(Path(root))
    except roster.RosterError:
        people = None
    listed = people.people if people else {}
    for one in found:
        person = listed.get(one[id])
        if person and one["last_name"] is None and one["first_name"] is None:
            one |= {"last_name": person.last_name or None, "first_name": person.first_name or None}
            if one.get("email", "") is None:
                one["email"] = person.email or None
    return found


def serve(application: web.Application, base_url: str) -> None:
    """Answer in this server, before nbgrader does."""
    served = {
        r"/formgrader/api/students": Students,
        r"/formgrader/api/submissions/([^/]+)": Submissions,
        r"/formgrader/api/submission/([^/]+)/([^/]+)": Submission,
        rf"/formgrader/static/js/({'|'.join(SCRIPTS)})\.js": Script,
    }
    application.add_handlers(
        ".*$", [(url_path_join(base_url, address), handler) for address, handler in served.items()]
    )
