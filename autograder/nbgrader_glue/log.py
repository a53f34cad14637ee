"""Writes nbgrader's log so that no name or notebook in it can control the terminal."""

import copy
import logging

from tornado.log import LogFormatter

from autograder.terminal import plain


class PlainFormatter(LogFormatter):
    """nbgrader's own format; its colours stay."""

    def format(self, record: logging.LogRecord) -> str:
        record = copy.copy(record)  # other handlers get the original
        record.msg, record.args = plain(record.getMessage()), ()
        return super().format(record)

    def formatException(self, ei) -> str:
        return plain(super().formatException(ei))
