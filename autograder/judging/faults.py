"""What to say of a call that gave no numbers."""

from autograder.protocol import Fault, FaultKind


def describe_fault(fault: Fault, name: str, signature: str) -> str:
    """The sentence for a student whose function `name` should be callable as `signature`."""
    where = f" ({fault.line})" if fault.line else ""
    left_out = f" Before that, {fault.line}." if fault.line else ""
    renamed = f" There is a {fault.message}: is that it?" if fault.message else ""
    return {
        FaultKind.MISSING: f"The notebook defines no {name}.{renamed} The check calls "
        f"{signature}, by exactly this name; was its cell run?{left_out}",
        FaultKind.CELL_FAILED: f"The notebook defines no {name}: the cell that should "
        f"define it stopped with {fault.message}{where}. Mend that line; what stands below it in "
        "the cell runs then.",
        FaultKind.STALE: f"An earlier {name} was judged: the cell that defines it again "
        f"stopped with {fault.message}{where}. Mend that line.",
        FaultKind.NOT_CALLABLE: f"{name} is a {fault.message}, not a function that can "
        f"be called as {signature}; was the name used again further down?",
        FaultKind.RAISED: f"{signature} raised {fault.message}{where}.",
        FaultKind.TIMED_OUT: f"{signature} did not return within {fault.message}; "
        "is there a loop that never ends?",
        FaultKind.STARVED: f"{signature} did not return within {fault.message}, and was mostly "
        "asleep; does it wait for something?",
        FaultKind.NO_TOOLS: f"{name} is written in a language that cannot be run here. "
        f"{fault.message} An answer in Python is always possible.",
        FaultKind.DIED: f"Python itself stopped while {signature} was running; "
        "does it call exit, or use up all memory?",
        FaultKind.NOTHING: f"{signature} returned None; is the return statement missing?",
        FaultKind.NOT_NUMBERS: f"{signature} returned {fault.message}; it must return numbers.",
        FaultKind.GARBLED: f"What {signature} returned could not be read as numbers.",
    }[fault.kind]


def describe_second_fault(fault: Fault, name: str, signature: str) -> str:
    """The sentence for a second call, after a first one that gave numbers."""
    if fault.kind in (FaultKind.RAISED, FaultKind.NOTHING, FaultKind.NOT_NUMBERS):
        return describe_fault(fault, name, signature)
    return f"{signature} gave no numbers."
