"""What the formgrader's pages show when a button is pressed: what an instructor can read.

nbgrader would show each of its steps, and a traceback for everything that cannot be done.
"""

import logging

from autograder.nbgrader_glue.in_words import InWords, keep_sqlalchemy_quiet, logged, why


def show_in_words(server) -> None:
    """Have the server's log, which the pages show, hold no steps, unless the server was told to write
    these; and have the reason in the place of a traceback.
    """
    from nbgrader.apps import api  # the formgrader needs it, too

    if server.log_level > logging.DEBUG:
        server.log.setLevel(logging.INFO)
    server.log.addFilter(InWords())
    keep_sqlalchemy_quiet()
    by_nbgrader = api.capture_log

    def capture_log(app, *given, **more) -> dict:
        start, known = app.start, []

        def start_and_tell() -> None:
            try:
                start()
            except Exception as error:
                if reason := why(error):
                    known.append(reason)
                    if not isinstance(error, logged()):
                        app.log.error(reason)
                raise

        app.start = start_and_tell
        result = by_nbgrader(app, *given, **more)
        if known:
            result.pop("error", None)
        return result

    api.capture_log = capture_log
