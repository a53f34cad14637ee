"""Tells a student why a call gave no numbers."""

from autograder.protocol import Fault, FaultKind


def describe_fault(fault: Fault, name: str, signature: str) -> str:
    """The sentence for a student whose function `name` should be callable as `signature`."""
    where = f" ({fault.line})" if fault.line else ""
    left_out = f" Before that, {fault.line}." if fault.line else ""
    renamed = f" Did you mean {fault.message}?" if fault.message else ""
    return {
        FaultKind.MISSING: f"The notebook does not define {name}.{renamed} The check "
        f"calls {signature}, by exactly this name. Did you run its cell?{left_out}",
        FaultKind.CELL_FAILED: f"The notebook does not define {name}: the cell that should "
        f"define it stopped with {fault.message}{where}. Fix that line, so that the lines below it "
        "run as well.",
        FaultKind.STALE: f"The check judged an earlier {name}: the cell that defines it again "
        f"stopped with {fault.message}{where}. Fix that line.",
        FaultKind.NOT_CALLABLE: f"{name} is of type {fault.message}, not a function that can "
        f"be called as {signature}. Did you use the name again further down?",
        FaultKind.RAISED: f"{signature} raised {fault.message}{where}.",
        FaultKind.TIMED_OUT: f"{signature} did not return within {fault.message}. "
        "Is there a loop that never ends?",
        FaultKind.STARVED: f"{signature} did not return within {fault.message}, and slept most of "
        "that time. Does it wait for something?",
        FaultKind.NO_TOOLS: f"{name} is written in a language that cannot run here. "
        f"{fault.message} You can always answer in Python.",
        FaultKind.DIED: f"Python itself stopped while {signature} was running. "
        "Does it call exit, or use up all memory?",
        FaultKind.NOTHING: f"{signature} returned None. Is the return statement missing?",
        FaultKind.NOT_NUMBERS: f"{signature} returned {fault.message}; it must return numbers.",
        FaultKind.GARBLED: f"The check could not read what {signature} returned as numbers.",
    }[fault.kind]


def describe_second_fault(fault: Fault, name: str, signature: str) -> str:
    """The sentence for a second call, after a first one that gave numbers."""
    if fault.kind in (FaultKind.RAISED, FaultKind.NOTHING, FaultKind.NOT_NUMBERS):
        return describe_fault(fault, name, signature)
    return f"{signature} gave no numbers."
