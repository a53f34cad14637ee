"""Writes calls and replies as messages in JSON's terms, and reads them, whatever came."""

from dataclasses import replace

from .arguments import decode, encode
from .calls import MOST_CHANGES, Call, Fault, Reply
from .causes import decode_cause, encode_cause
from .own_code import are_arguments
from .readings import FaultKind, decode_value, encode_value
from .riddles import decode_riddle, encode_riddle
from .words import shortened


def encode_call(call: Call) -> dict:
    args = [encode(value) for value in call.args]
    shape = {"at": list(call.at), "parts": call.parts, "truth": call.truth}
    closed = {"without": list(call.without)} if call.without else {}
    return {"name": call.name, "args": args, **shape, **closed}


def decode_call(message: dict) -> Call:
    args = tuple(decode(value) for value in message["args"])
    shape = tuple(message["at"]), message["parts"], message["truth"]
    return Call(message["name"], args, *shape, tuple(message.get("without", ())))


def encode_reply(reply: Reply) -> dict:
    takes = {"takes": list(reply.takes)} if reply.takes else {}
    if reply.fault:
        fault = reply.fault
        said = {"kind": fault.kind, "message": fault.message, "line": fault.line}
        return {"fault": said | {"riddle": encode_riddle(fault.riddle)}, **takes}
    message = {"value": encode_value(reply.value), **takes}
    if reply.caret:
        message["caret"] = True
    if reply.cause:
        message["cause"] = encode_cause(reply.cause)
    if reply.changed:
        message["changed"] = [list(change) for change in reply.changed]
        message["again"] = reply.again and encode_reply(reply.again)
    return message


def decode_reply(message) -> Reply:
    """A reply from the sandbox; anything else becomes a fault, never an exception."""
    reply = _decode_reply(message)
    match message:
        case {"takes": list(names)} if are_arguments(names):
            reply = replace(reply, takes=tuple(names))
    match message:
        case {"changed": list(changes), "again": again} if not reply.fault:
            known = (change for change in changes if _is_change(change))
            changed = tuple(dict.fromkeys((place, name) for place, name in known))[:MOST_CHANGES]
            return replace(reply, changed=changed, again=_decode_reply(again) if again else None)
    return reply


def _decode_reply(message) -> Reply:
    try:
        match message:
            case {"value": value}:
                return Reply(
                    value=decode_value(value),
                    caret=message.get("caret") is True,
                    cause=decode_cause(message.get("cause")),
                )
            case {"fault": {"kind": kind, "message": str(text), "line": str(line), **more}}:
                riddle = decode_riddle(more.get("riddle"))
                return Reply(fault=Fault(FaultKind(kind), shortened(text), shortened(line), riddle))
    except (TypeError, ValueError, OverflowError):
        pass
    return Reply(fault=Fault(FaultKind.GARBLED))


def _is_change(change) -> bool:
    match change:
        case [int(), str()]:
            return True
    return False
