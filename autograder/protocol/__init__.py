"""The wall between a student's code and its judge: calls go in, plain numbers come back.

This package is on both sides. In JupyterLab `answer` runs in the student's own kernel; in grading it
runs in the sandbox, and calls and replies cross as JSON, never as objects. It knows nothing of the
problems, and holds nothing that a student should not see. Its imports are relative, as it has another
name there.
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
    read,
    said_by,
    time_limit,
)
from .looks import Look
from .readings import MOST_NUMBERS, FaultKind, NotNumbersError, one_line, shortened

__all__ = [
    "CALL_SECONDS",
    "MOST_NUMBERS",
    "PATIENCE",
    "Call",
    "Expressions",
    "Fault",
    "FaultKind",
    "Function",
    "Look",
    "NotNumbersError",
    "Reply",
    "Symbol",
    "TimeLimitError",
    "answer",
    "answer_all",
    "decode_call",
    "decode_reply",
    "encode_call",
    "encode_reply",
    "kind_of",
    "one_line",
    "read",
    "real",
    "said_by",
    "shortened",
    "time_limit",
]
