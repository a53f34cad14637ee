"""The protocol between the judge and a student's code: calls go in, plain numbers come back.

This package is on both sides. In JupyterLab `answer` runs in the student's own kernel. When a
notebook is graded, it runs in the sandbox; calls and replies cross as JSON, never as objects. It knows
nothing of the problems, and holds nothing that a student should not see. Its imports are relative,
because it has another name in the sandbox.
"""

from .arguments import Expressions, Function, Symbol, real
from .calls import (
    CALL_SECONDS,
    PATIENCE,
    Call,
    Fault,
    Reply,
    TimeLimitError,
    answer,
    answer_all,
    decode_call,
    decode_reply,
    encode_call,
    encode_reply,
    kind_of,
    message_of,
    read,
    time_limit,
)
from .looks import Look
from .own_arm import OwnArm
from .proofs import HandedIn, decode_handed_in, encode_handed_in, handed_in
from .readings import MOST_NUMBERS, FaultKind, NotNumbersError
from .words import one_line, shortened

__all__ = [
    "CALL_SECONDS",
    "MOST_NUMBERS",
    "PATIENCE",
    "Call",
    "Expressions",
    "Fault",
    "FaultKind",
    "Function",
    "HandedIn",
    "Look",
    "NotNumbersError",
    "OwnArm",
    "Reply",
    "Symbol",
    "TimeLimitError",
    "answer",
    "answer_all",
    "decode_call",
    "decode_handed_in",
    "decode_reply",
    "encode_call",
    "encode_handed_in",
    "encode_reply",
    "handed_in",
    "kind_of",
    "message_of",
    "one_line",
    "read",
    "real",
    "shortened",
    "time_limit",
]
