"""Refuses to grade by a source whose tests do not work in the sandbox, or fail for the model answer."""

import nbformat

from autograder.digest import digest
from autograder.notebook.trial import refusal
from autograder.pipeline.cache import Cache, code_version
from autograder.pipeline.recorder import Recorder


def refuse_unsound(recorder: Recorder, cache: Cache) -> None:
    """ValueError, with a line for each cell, if the source cannot be graded as it is written.

    A source that was found sound is not tried again.
    """
    beside = recorder.laid_in_source()
    key = f"sources/{digest(recorder.source, beside.digest(), code_version())}"
    if cache.load(key):
        return
    source = nbformat.reads(recorder.source, as_version=4)
    if why := refusal(recorder.assignment, source, beside):
        raise ValueError(why)
    cache.store(key, {"sound": True})
