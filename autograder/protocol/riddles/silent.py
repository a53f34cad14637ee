"""Finds in a function's code what is hardly meant, and what no error tells: ^ between whole numbers, an
answer below the line that stops the function.
"""

import ast
import dis
from collections.abc import Iterator
from functools import lru_cache
from types import CodeType

from .scene import tree_of


def uses_caret(function) -> bool:
    """Whether a Python function, or one that it defines, uses ^, which is no power."""
    code = getattr(function, "__code__", None)
    return isinstance(code, CodeType) and _has_caret(code)


@lru_cache(maxsize=64)
def _has_caret(code: CodeType) -> bool:
    # Python itself computes 10 ^ -3 before it makes code of it.
    if (node := _definition(code)) is not None:
        return any(isinstance(part, ast.BitXor) for part in ast.walk(node))
    return any(
        step.opname == "BINARY_OP" and step.argrepr in ("^", "^=")
        for part in _parts(code)
        for step in dis.get_instructions(part)
    )


def line_above_answer(function) -> str:
    """The line of a Python function that raises an error always, where more stands below it, as
    "line 2"; "" where there is none.
    """
    code = getattr(function, "__code__", None)
    node = _definition(code) if isinstance(code, CodeType) else None
    for line in node.body[:-1] if node else []:
        if isinstance(line, ast.Raise):
            return f"line {line.lineno}"
    return ""


def _definition(code: CodeType) -> ast.FunctionDef | None:
    for node in ast.walk(tree_of(code) or ast.Module([], [])):
        if isinstance(node, ast.FunctionDef) and _begins(node, code):
            return node
    return None


def _begins(node: ast.FunctionDef, code: CodeType) -> bool:
    """Whether the code is of this definition, which begins at its first decorator."""
    first = min([node.lineno, *(line.lineno for line in node.decorator_list)])
    return (node.name, first) == (code.co_name, code.co_firstlineno)


def _parts(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _parts(constant)
