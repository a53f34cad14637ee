"""The code cell with a student's answer, as an example that names nobody."""

import io
import re
import tokenize
from collections.abc import Iterable

MOST_LINES, MOST_COLUMNS = 24, 100
HIDDEN = "…"


def anonymous(source: str, names: Iterable[str]) -> str:
    """The code without comments and texts in which a person may be named, and not too long to be read.

    names: of the students, which stand nowhere in it.
    """
    code = _without_comments(source)
    for name in sorted(filter(None, names), key=len, reverse=True):
        # A name as short as an index would take letters out of the code.
        if len(name) > 2:
            code = re.sub(rf"(?i)(?<!\w){re.escape(name)}(?!\w)", HIDDEN, code)
    lines = [line.rstrip() for line in code.splitlines() if line.strip()]
    shown = [line if len(line) <= MOST_COLUMNS else f"{line[:MOST_COLUMNS]} {HIDDEN}"
             for line in lines[:MOST_LINES]]  # fmt: skip
    return "\n".join([*shown, HIDDEN] if len(lines) > MOST_LINES else shown)


def _without_comments(source: str) -> str:
    """The code with nothing in the place of comments and of texts over lines of their own."""
    try:
        tokens = list(tokenize.generate_tokens(io.StringIO(source).readline))
    except (tokenize.TokenError, SyntaxError):  # code that never ran
        return re.sub(r"#.*", "", source)
    lines = source.splitlines(keepends=True)
    begins_line = True
    for token in tokens:
        docstring = token.type == tokenize.STRING and begins_line
        if token.type == tokenize.COMMENT or docstring:
            _blank(lines, token.start, token.end)
        begins_line = token.type in (
            tokenize.NEWLINE, tokenize.NL, tokenize.INDENT, tokenize.DEDENT, tokenize.ENCODING
        ) or (begins_line and token.type == tokenize.COMMENT)  # fmt: skip
    return "".join(lines)


def _blank(lines: list[str], start: tuple[int, int], end: tuple[int, int]) -> None:
    (first, left), (last, right) = start, end
    for number in range(first - 1, last):
        line = lines[number].rstrip("\r\n")
        begin = left if number == first - 1 else 0
        stop = right if number == last - 1 else len(line)
        lines[number] = line[:begin] + " " * (stop - begin) + line[stop:] + "\n"
