"""Reports a class: scores, the state of each check, who made which mistake, what nobody met.

The verdicts come from the autograded notebooks, so it does not matter which command graded them; the
scores come from the gradebook, and include the points that a person gave.
"""

from autograder.report.mistakes import mistakes_made
from autograder.report.pages import page, summary, term_page, term_summary
from autograder.report.students import Class, Student, read_graded

__all__ = [
    "Class",
    "Student",
    "mistakes_made",
    "page",
    "read_graded",
    "summary",
    "term_page",
    "term_summary",
]
