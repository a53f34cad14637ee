"""Tells a student why a call gave no numbers."""

import numpy as np

from autograder.protocol import Fault, FaultKind, sentence_of

NUMBERS = "numbers"
# Why a cell stopped, in place of the error that stops most.
PYTHON_ENDED = "Python itself ended"
NOT_RUN = "not run: "
# What helps where a function returned something else than numbers, by how that is described.
INSTEAD = {
    "the function ": "Call it: write its arguments behind it, in round brackets.",
    "the text ": "Without the quotes, Python would compute it.",
    "an array of texts": "Without the quotes, Python would compute them.",
    "the complex number ": "Is it a root of something negative?",
    "an array of complex numbers": "Is there a root of something negative?",
    "a tuple of ": "Which of its parts is the answer?",
}


def describe_fault(fault: Fault, name: str, signature: str, needed: str = NUMBERS) -> str:
    """The sentence for a student whose function `name` should be callable as `signature`.

    needed: what the function should return, in words.
    """
    where = f" ({fault.line})" if fault.line else ""
    means = sentence_of(fault.riddle, "SymPy" in needed)
    means = f" {means}" if means else ""
    instead = next((f" {w}" for kind, w in INSTEAD.items() if fault.message.startswith(kind)), "")
    left_out = f" Before that, {fault.line}." if fault.line else ""
    if fault.message.startswith(PYTHON_ENDED):
        stopped, fix = f"stopped because {fault.message}", "Fix that cell"
    elif NOT_RUN in fault.message:
        why = fault.message.partition(NOT_RUN)[2]
        stopped, fix = f"was not run, as {why}", "Make those cells quicker"
    else:
        stopped, fix = f"stopped with {fault.message}{where}", "Fix that line"
    renamed = f" Did you mean {fault.message}?" if fault.message else ""
    return {
        FaultKind.MISSING: f"The notebook does not define {name}.{renamed} The check "
        f"calls {signature}, by exactly this name. Did you run its cell?{left_out}",
        FaultKind.CELL_FAILED: f"The notebook does not define {name}: the cell that should "
        f"define it {stopped}. {fix}, so that the lines below it run as well.",
        FaultKind.STALE: f"The check judged an earlier {name}: the cell that defines it again "
        f"{stopped}. {fix}.",
        FaultKind.NOT_CALLABLE: f"{name} is of type {fault.message}, not a function that can "
        f"be called as {signature}. Did you use the name again further down?",
        FaultKind.RAISED: f"{signature} raised {fault.message}{where}.{means}",
        FaultKind.TIMED_OUT: f"{signature} did not return within {fault.message}. "
        "Is there a loop that never ends?",
        FaultKind.STARVED: f"{signature} did not return within {fault.message}, and hardly computed "
        "in that time. Does it wait for something?",
        FaultKind.SLOW_LOOP: f"The check called {name} step by step in a closed loop, and after "
        f"{fault.message} it had not come to the end. Which of its lines takes so long?",
        FaultKind.NO_TOOLS: f"{name} is written in a language that cannot run here. "
        f"{fault.message} You can always answer in Python.",
        FaultKind.DIED: f"Python itself stopped while {signature} was running. "
        "Does it call exit, or use up all memory?",
        FaultKind.NOTHING: f"{signature} returned None. "
        f"{means.strip() or 'Is the return statement missing?'}",
        FaultKind.NOT_NUMBERS: f"{signature} returned {fault.message}; it must return {needed}."
        f"{instead}",
        FaultKind.GARBLED: f"The check could not read what {signature} returned as numbers.",
    }[fault.kind]


def describe_unfit(signature: str, unfit: str, truth: bool, value, right) -> str:
    """The sentence where numbers came back, but not as many, or not in the shape, that is asked for.

    unfit: what came, and what is needed. truth: whether True or False is. value: what came for a call;
    right: what should have.
    """
    if isinstance(value, dict | list) or isinstance(right, dict | list):
        return f"{signature} returned {unfit}."
    if truth and np.size(value) != 1:
        return (
            f"{signature} returned {np.size(value)} values, in shape {np.shape(value)}; it must return "
            "one, True or False. Must all of them hold (np.all), or is one enough (np.any)?"
        )
    matrix, n = np.shape(value), np.size(right)
    if np.ndim(right) == 1 and n > 1 and matrix == (n, n):
        return (
            f"{signature} returned {unfit}. Did you multiply a matrix and a vector by *? It multiplies "
            "entry by entry; the matrix product is @."
        )
    return f"{signature} returned {unfit}."


def describe_second_fault(fault: Fault, name: str, signature: str, needed: str = NUMBERS) -> str:
    """The sentence for a second call, after a first one that gave numbers."""
    if fault.kind in (FaultKind.RAISED, FaultKind.NOTHING, FaultKind.NOT_NUMBERS):
        return describe_fault(fault, name, signature, needed)
    return f"{signature} returned nothing that the check can judge."
