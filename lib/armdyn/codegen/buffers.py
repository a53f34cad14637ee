"""Rewrites straight-line NumPy code so that it works in a few reused buffers.

An expression such as `a*b + c` makes a new array for each intermediate result. The C library soon
gives the memory of such arrays back to the system, and getting it again, page by page, takes longer
than the arithmetic. Here every operation is one call that overwrites a value that is no longer
needed: `w_0 = multiply(a, b, out=b_0)`, `x = add(w_0, c, out=b_0)`.
"""

import ast
import itertools
from collections import Counter
from dataclasses import dataclass

import numpy as np

_OPERATORS = {
    ast.Add: "add",
    ast.Sub: "subtract",
    ast.Mult: "multiply",
    ast.Div: "divide",
    ast.Pow: "power",
    ast.USub: "negative",
}


def in_buffers(
    statements: list[str], results: list[str], arrays: list[str]
) -> tuple[list[str], list[str], int]:
    """(statements, results, k): the same computation, in buffers b_0, …, b_(k−1).

    statements: `name = expression`, each name assigned once. results: expressions. arrays: the
    names that hold arrays from the start, all others being numbers; they are not written to. Of
    the returned results, each is a name or a number, and some of the names are of buffers.
    """
    three_address = _ThreeAddress(arrays)
    for statement in ast.parse("\n".join(statements)).body:
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                three_address.assign(name, value)
            case _:
                raise ValueError(f"{ast.unparse(statement)}: needs name = expression")
    results = [three_address.operand(ast.parse(r, mode="eval").body, {}) for r in results]
    lines, count = _placed(three_address.operations, results, arrays)
    return lines, results, count


@dataclass(frozen=True)
class _Operation:
    """name = text; with `out`, the text is an elementwise call's, and takes out=."""

    name: str
    text: str
    reads: tuple[str, ...]
    out: bool


class _ThreeAddress:
    """Takes expressions apart into operations, innermost first."""

    def __init__(self, arrays):
        self.arrays = set(arrays)
        self.operations = []
        self.numbers = itertools.count()

    def assign(self, name, node, seen=None):
        """Append the operations that give `name` the node's value; seen: names by expression."""
        seen = {} if seen is None else seen
        reads = self._arrays_in(node)
        function, parts = _elementwise(node)
        # What is not elementwise, as a Piecewise's select, stays as it is.
        out = bool(reads) and function is not None
        if out:
            operands = [self.operand(part, seen) for part in parts]
            reads = [o for o in operands if o in self.arrays]
            text = f"{function}({', '.join(operands)}"
        else:
            text = ast.unparse(node)
        self.operations.append(_Operation(name, text, tuple(reads), out))
        if reads:
            self.arrays.add(name)

    def operand(self, node, seen):
        """A name or a number for the node's value."""
        text = ast.unparse(node)
        if isinstance(node, ast.Name) or not self._arrays_in(node):
            return text
        if text not in seen:  # a square's base is computed once
            seen[text] = f"w_{next(self.numbers)}"
            self.assign(seen[text], node, seen)
        return seen[text]

    def _arrays_in(self, node):
        names = (part.id for part in ast.walk(node) if isinstance(part, ast.Name))
        return [name for name in names if name in self.arrays]


def _elementwise(node):
    """(name of the NumPy function, its arguments), or (None, []) if it cannot write to a buffer."""
    match node:
        case ast.Name():
            return "positive", [node]
        case ast.BinOp(left, operator, right) if type(operator) in _OPERATORS:
            return _OPERATORS[type(operator)], [left, right]
        case ast.UnaryOp(ast.USub(), operand):
            return "negative", [operand]
        case ast.Call(ast.Name(name), arguments, []):
            function, inputs = getattr(np, name, None), "d" * len(arguments)
            if isinstance(function, np.ufunc) and f"{inputs}->d" in function.types:
                return name, arguments
    return None, []


def _placed(operations, results, arguments):
    """(lines, number of buffers): each value in a buffer that no later operation reads."""
    readings = Counter(name for operation in operations for name in operation.reads)
    last = {name: at for at, o in enumerate(operations) for name in o.reads}
    # What is not elementwise may give a view of what it reads.
    kept = {*results, *(name for o in operations if not o.out for name in o.reads)}
    lines: list[str] = []
    places: dict[str, str] = {}
    free: list[str] = []
    count = 0

    def place(name, text):
        nonlocal count
        if not free:
            free.append(f"b_{count}")
            count += 1
        places[name] = free.pop()
        lines.append(f"{name} = {text}, out={places[name]})")

    for at, operation in enumerate(operations):
        for name in dict.fromkeys(operation.reads):
            # A column of an array of states; to read it from there twice is slower.
            if name in arguments and readings[name] > 1 and name not in places:
                place(name, f"positive({name}")
        if not operation.out:
            lines.append(f"{operation.name} = {operation.text}")
            continue
        ended = {n for n in operation.reads if last[n] == at and n in places and n not in kept}
        free += sorted(places.pop(name) for name in ended)
        place(operation.name, operation.text)
    return lines, count
