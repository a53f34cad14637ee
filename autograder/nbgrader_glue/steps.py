"""Names the parts of nbgrader and nbconvert that the course replaces, without importing them.

Each list of preprocessors is that of nbgrader 0.9.6 with ours put in; a test compares them.
"""

from importlib.util import find_spec
from pathlib import Path

from autograder.nbgrader_glue.exchange import OF_GRADERS, OF_STUDENTS

OURS = "autograder.nbgrader_glue.preprocessors"
# For `autograde`: what reads a submission.
SUBMISSION_EXPORTER = "autograder.nbgrader_glue.reading.SubmissionExporter"
# For `generate_assignment`: what looks at a source and writes its release.
RELEASE_EXPORTER = "autograder.nbgrader_glue.generating.ReleaseExporter"
# For `generate_feedback`: what writes its pages.
FEEDBACK_EXPORTER = "autograder.nbgrader_glue.feedback.FeedbackExporter"
# For `export`.
GRADES_EXPORTER = "autograder.nbgrader_glue.grades.GradesExporter"
# For every command.
LOG_FORMATTER = "autograder.nbgrader_glue.log.PlainFormatter"
LOG = {
    "formatters": {"console": {"class": LOG_FORMATTER}},
    "filters": {"in_words": {"()": "autograder.nbgrader_glue.in_words.InWords"}},
    "handlers": {"console": {"filters": ["in_words"]}},
}
# For the formgrader and `generate_feedback`: what shows a student's text, formulas and pictures.
PAGE_FILTERS = {
    "markdown2html": "autograder.nbgrader_glue.markdown.markdown2html",
    "with_formulas": "autograder.nbgrader_glue.formulas.with_formulas",
    "pictures_beside": "autograder.nbgrader_glue.markdown.pictures_beside",
}
# For `ExchangeFactory`, on a student's side and on the graders': nbgrader's exchange, closed.
EXCHANGE = OF_STUDENTS | OF_GRADERS


def page_templates() -> list[str]:
    """The folders in which nbconvert looks for the pages' templates: ours first, then nbgrader's own."""
    return [str(Path(__file__).with_name("templates")), *templates_of_nbgrader()]


def templates_of_nbgrader() -> list[str]:
    """The folder of the templates that ours build on."""
    found = find_spec("nbgrader")
    folders = found.submodule_search_locations if found else None
    return [
        str(Path(folder) / "server_extensions" / "formgrader" / "templates")
        for folder in folders or ()
    ]


def sanitize_preprocessors() -> list[str]:
    """nbgrader's own, with RepairCells first."""
    return [
        f"{OURS}.RepairCells",
        "nbgrader.preprocessors.ClearOutput",
        "nbgrader.preprocessors.DeduplicateIds",
        "nbgrader.preprocessors.OverwriteKernelspec",
        "nbgrader.preprocessors.OverwriteCells",
        "nbgrader.preprocessors.CheckCellMetadata",
    ]


def autograde_preprocessors() -> list[str]:
    """nbgrader's own, with Judge instead of Execute, and SaveSuggestions instead of SaveAutoGrades."""
    return [
        f"{OURS}.Judge",
        "nbgrader.preprocessors.IgnorePattern",
        "nbconvert.preprocessors.ClearMetadataPreprocessor",
        "nbgrader.preprocessors.LimitOutput",
        f"{OURS}.SaveSuggestions",
        "nbgrader.preprocessors.AssignLatePenalties",
        "nbgrader.preprocessors.CheckCellMetadata",
    ]


def generate_preprocessors() -> list[str]:
    """nbgrader's own, with ours first, and SaveChangedCells instead of SaveCells."""
    return [
        f"{OURS}.StampVersion",
        f"{OURS}.ContinuePastErrors",
        "nbgrader.preprocessors.IncludeHeaderFooter",
        "nbgrader.preprocessors.InstantiateTests",
        "nbgrader.preprocessors.LockCells",
        "nbgrader.preprocessors.ClearSolutions",
        "nbgrader.preprocessors.ClearOutput",
        "nbgrader.preprocessors.CheckCellMetadata",
        "nbgrader.preprocessors.ComputeChecksums",
        "autograder.nbgrader_glue.new_cells.SaveChangedCells",
        "nbgrader.preprocessors.ClearHiddenTests",
        "nbgrader.preprocessors.ClearMarkScheme",
        "nbgrader.preprocessors.ComputeChecksums",
        "nbgrader.preprocessors.CheckCellMetadata",
    ]


def feedback_preprocessors() -> list[str]:
    """nbgrader's own, with GetDecidedGrades instead of GetGrades."""
    return [
        f"{OURS}.GetDecidedGrades",
        "nbconvert.preprocessors.CSSHTMLHeaderPreprocessor",
    ]
