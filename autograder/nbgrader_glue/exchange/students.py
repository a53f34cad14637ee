"""A student's side of the exchange."""

import os
import shutil
import tempfile

from nbgrader.exchange import default

from autograder.nbgrader_glue.exchange.entered import Entered


class FetchAssignment(Entered, default.ExchangeFetchAssignment):
    """As nbgrader's."""


class FetchFeedback(Entered, default.ExchangeFetchFeedback):
    """As nbgrader's."""


class List(Entered, default.ExchangeList):
    """As nbgrader's."""


class Submit(Entered, default.ExchangeSubmit):
    """Hands in to the graders alone, and all at once."""

    inbound_path: str

    def copy_files(self) -> None:
        inbound = self.inbound_path
        # Nobody else enters this folder, so that what is in it is closed before it gets its name.
        stage = tempfile.mkdtemp(prefix=".", dir=inbound)
        try:
            here, there = os.stat(stage), os.stat(inbound)
            if here.st_uid != there.st_uid and here.st_gid != there.st_gid:
                self.fail(
                    f"{inbound} is not as this version needs it. Ask your instructor to set the "
                    "exchange up again with `nbgrader release_assignment --force`."
                )
            self.inbound_path = stage
            super().copy_files()
            made = os.path.join(stage, self.assignment_filename)
            _give_to_group(here.st_gid, made, stage)
            self.set_perms(made, fileperms=0o640, dirperms=0o770)
            os.rename(made, os.path.join(inbound, self.assignment_filename))
        finally:
            self.inbound_path = inbound
            shutil.rmtree(stage)


def _give_to_group(group: int, folder: str, stage: str) -> None:
    """Write those files again that do not belong to the group that the stage hands down.

    These are nbgrader's own two. Before it writes them, it gives the folder the permissions of the
    student's, and with them the folder no longer hands its group down.
    """
    for entry in list(os.scandir(folder)):
        if entry.is_file() and entry.stat().st_gid != group:
            again = shutil.copyfile(entry.path, os.path.join(stage, entry.name))
            os.replace(again, entry.path)
