"""Judges one submission's file, in another process or on another machine: bytes in, JSON out."""

import warnings
from functools import lru_cache

import nbformat
from nbformat import NotebookNode

from autograder.judging.verdict import State
from autograder.notebook.beside import Beside
from autograder.notebook.editions import of_release
from autograder.notebook.grade import CARRIED_ON, NOTHING, grade
from autograder.notebook.reading import UnreadableError, read
from autograder.notebook.scores import with_verdicts
from autograder.notebook.version import other_version
from autograder.pipeline.cache import code_version
from autograder.sandbox.room import Room


def judge(
    content: bytes,
    source: str,
    seed: str,
    beside: Beside = NOTHING,
    said: tuple[str, ...] = (),
    student: str | None = None,
    earlier: tuple[str, ...] = (),
    carried_on: float = CARRIED_ON,
) -> dict:
    """Grade a notebook, and give its cells with outputs that nbgrader can read.

    earlier: the editions of the problem that students may have, as JSON, the newest first.
    The result holds notebook, states, notes, graded (whether every check could judge), certain (whether
    it would do so again, on a busy machine too) and code, which shows whether a worker has other code;
    or refused (why the file cannot be graded) and code.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # nbformat's are not the instructor's business
            judged = _judged(content, source, seed, beside, said, student, earlier, carried_on)
            return judged | {"code": code_version()}
    except UnreadableError as error:
        refused = str(error)
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
    content: bytes,
    source: str,
    seed: str,
    beside: Beside,
    said: tuple[str, ...],
    student: str | None,
    earlier: tuple[str, ...],
    carried_on: float,
) -> dict:
    notebook, notes = read(content)
    if why := other_version(notebook, _source(source), beside.mechanisms):
        raise UnreadableError(why)
    editions = [of_release(text) for text in earlier]
    graded = grade(notebook, _source(source), seed, beside, said, student, editions, carried_on)
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


@lru_cache(maxsize=8)
def _source(text: str) -> NotebookNode:
    return nbformat.reads(text, as_version=4)
