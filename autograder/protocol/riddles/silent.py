"""Finds in a function's code what raises no error and is hardly meant: ^ between whole numbers."""

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
    if (tree := tree_of(code)) is not None:
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and _begins(node, code):
                return any(isinstance(part, ast.BitXor) for part in ast.walk(node))
    return any(
        step.opname == "BINARY_OP" and step.argrepr in ("^", "^=")
        for part in _parts(code)
        for step in dis.get_instructions(part)
    )


def _begins(node: ast.FunctionDef, code: CodeType) -> bool:
    """Whether the code is of this definition, which begins at its first decorator."""
    first = min([node.lineno, *(line.lineno for line in node.decorator_list)])
    return (node.name, first) == (code.co_name, code.co_firstlineno)


def _parts(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _parts(constant)
