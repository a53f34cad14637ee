"""nbgrader's log, in which names and notebooks are text that no terminal obeys."""

import copy
import logging

from tornado.log import LogFormatter

from autograder.terminal import plain


class PlainFormatter(LogFormatter):
    """nbgrader's own format; its colours stay."""

    def format(self, record: logging.LogRecord) -> str:
        record = copy.copy(record)  # other handlers have theirs
        record.msg, record.args = plain(record.getMessage()), ()
        return super().format(record)

    def formatException(self, ei) -> str:
        return plain(super().formatException(ei))
