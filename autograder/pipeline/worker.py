"""Judges one submission's file, in another process or on another machine: bytes in, JSON out."""

import warnings
from functools import lru_cache

import nbformat
from nbformat import NotebookNode

from autograder.judging.verdict import State
from autograder.notebook.beside import Beside
from autograder.notebook.grade import NOTHING, grade
from autograder.notebook.scores import with_verdicts
from autograder.notebook.version import other_version
from autograder.pipeline.cache import code_version
from autograder.sandbox.room import Room


class NoNotebookError(ValueError):
    """What was handed in under a notebook's name is something else."""


class OtherVersionError(ValueError):
    """A notebook has other questions than the course; the message says which."""


def judge(
    content: bytes,
    source: str,
    seed: str,
    beside: Beside = NOTHING,
    said: tuple[str, ...] = (),
    student: str | None = None,
) -> dict:
    """Grade a notebook, and give its cells with outputs that nbgrader can read.

    The result holds notebook, states, notes, graded (whether every check could judge), certain (whether
    it would do so again, on a busy machine too) and code, which shows whether a worker has other code;
    or refused (why the file cannot be graded) and code.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # nbformat's are not the instructor's business
            return _judged(content, source, seed, beside, said, student) | {"code": code_version()}
    except (UnicodeDecodeError, nbformat.reader.NotJSONError):
        refused = "is not valid JSON: ask the student for it again"
    except OtherVersionError as error:
        refused = str(error)
    except NoNotebookError:
        refused = "is not a notebook: ask the student for it again"
    except OSError:
        raise  # ours
    except Exception as error:
        refused = f"cannot be read: {type(error).__name__}: {error}"
    refused = "; ".join([refused, *said])
    return {"refused": refused, "code": code_version()}


def load() -> None:
    """Start what the first submission would otherwise wait for."""
    Room().close()
    code_version()


def _judged(
    content: bytes, source: str, seed: str, beside: Beside, said: tuple, student: str | None
) -> dict:
    notebook, notes = _read(content.decode("utf-8-sig"))
    if why := other_version(notebook, _source(source), beside.mechanisms):
        raise OtherVersionError(why)
    graded = grade(notebook, _source(source), seed, beside, said, student)
    notebook = with_verdicts(graded)
    nbformat.validate(notebook, relax_add_props=True)
    states = [verdict.state for verdict in graded.verdicts.values()]
    return {
        "notebook": notebook,
        "states": [state.value for state in states],
        "notes": [*notes, *graded.notes],
        "graded": State.CHECK_FAILED not in states,
        "certain": State.CHECK_FAILED not in states and not graded.uncertain,
    }


def _read(text: str) -> tuple[NotebookNode, list[str]]:
    try:
        notebook = nbformat.reads(text, as_version=nbformat.NO_CONVERT)
        has_metadata = isinstance(notebook.get("metadata"), dict)
    except (AttributeError, KeyError, TypeError) as error:  # JSON, but of something else
        raise NoNotebookError from error
    if not has_metadata:
        raise NoNotebookError
    notes = []
    if notebook.nbformat != 4:
        notes.append(f"the notebook was in format {notebook.nbformat}; it was converted")
        notebook = nbformat.convert(notebook, 4)
    return notebook, notes


@lru_cache(maxsize=8)
def _source(text: str) -> NotebookNode:
    return nbformat.reads(text, as_version=4)
