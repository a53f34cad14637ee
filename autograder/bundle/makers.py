"""Finds the source of functions that have no name, and writes makers for them.

A lambda in a check, or a function within another one, cannot be written down by a name. Its maker is a
function of the names that it has from around it: `_made_2(ids)` gives the lambda.
"""

import ast
from functools import cache
from types import CodeType, FunctionType

from autograder.bundle.shaking import lines_of, source_of, without_comments


class Makers:
    """The makers of each module, in the order in which they were asked for."""

    def __init__(self) -> None:
        self.sources: dict[str, dict[str, str]] = {}  # by the module: source → name

    def of(self, function: FunctionType) -> tuple[str, list]:
        """Its maker, as "module:name"; and what it has from around it, in the maker's order."""
        module = function.__module__
        source = _maker(module, function.__code__)
        made = self.sources.setdefault(module, {})
        name = made.setdefault(source, f"_made_{len(made) + 1}")
        cells = [cell.cell_contents for cell in function.__closure__ or ()]
        return f"{module}:{name}", cells

    def written(self, module: str) -> str:
        """The source of a module's makers."""
        made = self.sources.get(module, {})
        return "\n\n".join(source.replace("_made", name, 1) for source, name in made.items())


@cache
def _maker(module: str, code: CodeType) -> str:
    node = _node(module, code)
    names = ", ".join(code.co_freevars)
    if isinstance(node, ast.Lambda):
        source = without_comments(f"({ast.get_source_segment(source_of(module), node)})")
        return f"def _made({names}):\n    return {source}\n"
    node.decorator_list = []
    # Its lines keep their own indent: those of a text in them may have none.
    inner = lines_of(source_of(module), node)
    indent = " " * node.col_offset
    return f"def _made({names}):\n{inner}\n{indent}return {node.name}\n"


def _node(module: str, code: CodeType) -> ast.Lambda | ast.FunctionDef:
    """The smallest function of the source that has all places of this one's code."""
    places = [
        (first, column)
        for first, _, column, _ in code.co_positions()
        if first is not None and column is not None and column > 0
    ]
    found = [
        node
        for node in ast.walk(_tree(module))
        if isinstance(node, ast.Lambda | ast.FunctionDef)
        and all(_is_in(place, node) for place in places)
        and [a.arg for a in node.args.args] == list(code.co_varnames[: code.co_argcount])
    ]
    return min(found, key=lambda node: _extent(node))


def _extent(node) -> tuple[int, int]:
    """Its lines, and its columns where it stands in one line."""
    lines = node.end_lineno - node.lineno
    return lines, 0 if lines else node.end_col_offset - node.col_offset


def _is_in(place: tuple[int, int], node) -> bool:
    return (node.lineno, node.col_offset) <= place <= (node.end_lineno, node.end_col_offset)


@cache
def _tree(module: str) -> ast.Module:
    return ast.parse(source_of(module))
