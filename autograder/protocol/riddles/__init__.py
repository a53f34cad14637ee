"""Reads errors of Python, NumPy and SymPy for a student, with the names of the student's own code.

An error is read where it arose, as only there its frame says what J and I are. What crosses to the judge
is which row of the table it is, and a few short words; the sentence is made of them on the other side.
"""

from .reading import Riddle, decode_riddle, encode_riddle, of_error, of_nothing, sentence
from .silent import line_above_answer, uses_caret

__all__ = [
    "Riddle",
    "decode_riddle",
    "encode_riddle",
    "line_above_answer",
    "of_error",
    "of_nothing",
    "sentence",
    "uses_caret",
]
