"""Connects the grader to nbgrader; no other package knows nbgrader.

Importing this package does not import nbgrader, which takes seconds; its modules do.
"""

from autograder.nbgrader_glue.in_words import end_in_words
from autograder.nbgrader_glue.patience import VALIDATE_SECONDS
from autograder.nbgrader_glue.private import make_private
from autograder.nbgrader_glue.release import write_problem
from autograder.nbgrader_glue.steps import (
    EXCHANGE,
    FEEDBACK_EXPORTER,
    GRADES_EXPORTER,
    LOG,
    LOG_FORMATTER,
    PAGE_FILTERS,
    RELEASE_EXPORTER,
    SUBMISSION_EXPORTER,
    autograde_preprocessors,
    feedback_preprocessors,
    generate_preprocessors,
    page_templates,
    sanitize_preprocessors,
    templates_of_nbgrader,
)
from autograder.notebook.released import CODE_STUB, TEXT_STUB

__all__ = [
    "CODE_STUB",
    "EXCHANGE",
    "FEEDBACK_EXPORTER",
    "GRADES_EXPORTER",
    "LOG",
    "LOG_FORMATTER",
    "PAGE_FILTERS",
    "RELEASE_EXPORTER",
    "SUBMISSION_EXPORTER",
    "TEXT_STUB",
    "VALIDATE_SECONDS",
    "autograde_preprocessors",
    "end_in_words",
    "feedback_preprocessors",
    "generate_preprocessors",
    "make_private",
    "page_templates",
    "sanitize_preprocessors",
    "templates_of_nbgrader",
    "write_problem",
]
