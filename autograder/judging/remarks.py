"""What of a function is hardly meant, said beside a verdict that is not "correct"."""

from autograder.judging.call_text import arguments
from autograder.protocol import Fault, Reply

CARET = "Your {} uses ^. In Python ^ is no power; the power is **."
ORDER = "The check calls {}; the first line of yours, {}, has its arguments in another order."
COUNT = "The check calls {}; the first line of yours, {}, does not fit."


def remarks(reply: Reply, signature: str) -> list[str]:
    """Sentences about a function that should be callable as `signature`, by one of its replies."""
    name, names = signature.partition("(")[0], arguments(signature)
    found = [CARET.format(name)] if reply.caret else []
    own = f"{name}({', '.join(reply.takes)})"
    if len(names) != len(reply.takes):
        # Some may have a value already: f(q, arm, gain=1).
        found += [COUNT.format(signature, own)] if _cannot_begin(reply.fault, name) else []
    elif any(one in reply.takes and one != at for one, at in zip(names, reply.takes, strict=True)):
        found.append(ORDER.format(signature, own))
    return found


def _cannot_begin(fault: Fault | None, name: str) -> bool:
    """Whether Python says that a function of this name does not take what it was called with."""
    if not fault or fault.line:  # the call is a line of the student's own
        return False
    return (
        fault.message.startswith(f"TypeError: {name}() ") and "positional argument" in fault.message
    )
