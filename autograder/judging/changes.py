"""An answer that changes its arguments: which, and what to say of it."""

from types import SimpleNamespace

from autograder.protocol import Call, Reply

# How a second call was made, where the first one had changed its arguments.
SECOND = "on a second call, with its arguments as the first call left them"


def changed(signature: str, calls: list[Call], replies: list[Reply]) -> tuple[str, ...]:
    """What calls of the function changed, by the names that its signature gives: ("q", "arm.I2")."""
    names = signature.partition("(")[2].removesuffix(")").split(", ")
    found: dict[str, None] = {}  # in order, each once
    for call, reply in zip(calls, replies, strict=False):
        for place, entry in reply.changed:
            # What a reply from beyond the wall names counts only where the call has it.
            if 0 <= place < len(call.args) and entry in ("", *_entries(call.args[place])):
                found[f"{names[place]}.{entry}".removesuffix(".")] = None
    return tuple(found)


def remark(name: str, changed: tuple[str, ...], shows: bool) -> str:
    """The sentence for a student whose function changes these; shows: whether a second call shows it."""
    if not changed:
        return ""
    *others, last = changed
    said = f"arguments {', '.join(others)} and {last}" if others else f"argument {last}"
    them = "them" if others else "it"
    harm = (
        f"so a second call with {them} goes wrong" if shows else "which its caller may still need"
    )
    return f"Your {name} changes its {said}, {harm}: work on a copy."


def _entries(value) -> tuple[str, ...]:
    return tuple(vars(value)) if isinstance(value, SimpleNamespace) else ()
