"""Whether the oldest Python that students may have can read a file."""

import ast
import io
import sys
import tokenize

OLDEST = (3, 11)


def unreadable_line(source: str) -> int | None:
    """The first line of valid Python that OLDEST cannot read; None where it reads all of it."""
    try:
        ast.parse(source, feature_version=OLDEST)
    except SyntaxError as error:
        return error.lineno or 1
    return _new_in_a_formatted_text(source)


def _new_in_a_formatted_text(source: str) -> int | None:
    """The line of what Python 3.12 first took within the braces of an f-string: its own kind of quotes,
    a backslash, a comment, or in one that is on one line a line's end.
    """
    if sys.version_info < (3, 12):
        return None  # `ast.parse` has read it as OLDEST does
    around: list[str] = []  # the quotes of the f-strings that are open
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.FSTRING_END:
            around.pop()
            continue
        starts = token.type == tokenize.FSTRING_START
        outer = around[:-1] if token.type == tokenize.FSTRING_MIDDLE else around
        if outer and (
            token.type == tokenize.COMMENT
            or "\\" in token.string
            or any(quotes in token.string for quotes in outer)
            or (token.type == tokenize.NL and len(outer[-1]) == 1)
        ):
            return token.start[0]
        if starts:
            around.append(token.string.lstrip("fFrR"))
    return None
