"""The protocol between the judge and a student's code: calls go in, plain numbers come back.

This package is on both sides. In JupyterLab `answer` runs in the student's own kernel. When a
notebook is graded, it runs in the sandbox; calls and replies cross as JSON, never as objects. It knows
nothing of the problems, and holds nothing that a student should not see. Its imports are relative,
because it has another name in the sandbox.
"""

from .arguments import Expressions, Function, Symbol, numbers_at, real
from .calls import CALL_SECONDS, Call, Fault, Reply, answer, answer_all, kind_of, message_of, read
from .causes import Cause
from .limits import FAR, PATIENCE, TimeLimitError, no_limit, time_limit
from .looks import Look
from .own_arm import OwnArm
from .proofs import HandedIn, decode_handed_in, encode_handed_in, handed_in
from .readings import MOST_NUMBERS, FaultKind, NotNumbersError, is_finite
from .riddles import Riddle
from .riddles import sentence as sentence_of
from .wire import decode_call, decode_reply, encode_call, encode_reply
from .words import one_line, other_cell, shortened

__all__ = [
    "CALL_SECONDS",
    "FAR",
    "MOST_NUMBERS",
    "PATIENCE",
    "Call",
    "Cause",
    "Expressions",
    "Fault",
    "FaultKind",
    "Function",
    "HandedIn",
    "Look",
    "NotNumbersError",
    "OwnArm",
    "Reply",
    "Riddle",
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
    "is_finite",
    "kind_of",
    "message_of",
    "no_limit",
    "numbers_at",
    "one_line",
    "other_cell",
    "read",
    "real",
    "sentence_of",
    "shortened",
    "time_limit",
]
