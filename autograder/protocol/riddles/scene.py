"""The student's own expression that raised an error, and what its names stand for.

Nothing of the student's runs again here: names are looked up, and operated on only where they are plain
numbers, arrays, lists or namespaces of exactly these types.
"""

import ast
import itertools
import linecache
import operator
import traceback
from types import BuiltinFunctionType, CodeType, FunctionType, MethodType, SimpleNamespace

import numpy as np

from ..words import one_line

UNKNOWN = object()
NUMBERS = (bool, int, float, complex, np.float64, np.int64, np.bool_)
PLAIN = (*NUMBERS, np.ndarray, list, tuple, str, SimpleNamespace, type(None))
CALLABLE = (FunctionType, BuiltinFunctionType, MethodType, np.ufunc, type)
OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.MatMult: operator.matmul,
}
MOST_NUMBERS = 10_000
MOST_TEXT = 40
# A cell as IPython names it, in a kernel and in the sandbox.
OWN = ("ipykernel_", "<ipython-input")


class Scene:
    """Where the student's own code raised an error. node: its expression, or the statement x += y; tree:
    its cell; None where they are not known.
    """

    def __init__(self, error: BaseException):
        self.node: ast.AST | None = None
        self.tree: ast.Module | None = None
        self._names: list[dict] = []
        own = [
            (frame, at)
            for (frame, _), at in zip(
                traceback.walk_tb(error.__traceback__), _places(error), strict=True
            )
            if any(name in frame.f_code.co_filename for name in OWN)
        ]
        if own:
            frame, at = own[-1]
            self._names = [frame.f_locals, frame.f_globals]
            self.node = _node(frame.f_code, at)
            self.tree = tree_of(frame.f_code)

    def find(self, *kinds: type[ast.AST]):
        """The expression, if it is of one of these kinds."""
        return self.node if isinstance(self.node, kinds) else None

    def local_names(self) -> list[tuple[str, object]]:
        """The function's own names and their values, its arguments first."""
        return list(self._names[0].items()) if self._names else []

    def value(self, node: ast.AST | None):
        """What an expression stands for, or UNKNOWN."""
        try:
            with np.errstate(all="ignore"):
                return self._value(node)
        except Exception:  # it is the error itself, perhaps
            return UNKNOWN

    def shape(self, node: ast.AST | None) -> tuple[int, ...] | None:
        """The shape of an array, a number, a list of numbers or a SymPy matrix; None for another."""
        value = self.value(node)
        if type(value) in (np.ndarray, list, tuple):
            return np.shape(value) if _is_plain(value) else None
        if type(value) in NUMBERS:
            return ()
        if type(value).__module__.startswith("sympy.matrices"):
            return tuple(map(int, value.shape))
        return None

    def _value(self, node):
        match node:
            case ast.Constant(value):
                return value
            case ast.Name(id):
                found = next((names[id] for names in self._names if id in names), UNKNOWN)
                return found
            case ast.Attribute(value=owner, attr=name):
                of = self._value(owner)
                if type(of) is SimpleNamespace:
                    return vars(of).get(name, UNKNOWN)
                if type(of) is np.ndarray and name == "T":
                    return of.T
            case ast.Subscript(value=owner, slice=index):
                of, at = self._value(owner), self._index(index)
                if type(of) in (np.ndarray, list, tuple) and at is not UNKNOWN:
                    return of[at]
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                of = self._value(inner)
                if type(of) in (*NUMBERS, np.ndarray):
                    return -of
            case ast.BinOp(left=left, op=sign, right=right):
                one, other = self._value(left), self._value(right)
                if type(sign) in OPERATORS and _is_small(one) and _is_small(other):
                    return OPERATORS[type(sign)](one, other)
        return UNKNOWN

    def _index(self, node):
        match node:
            case ast.Tuple(elts=entries):
                found = tuple(map(self._index, entries))
                return UNKNOWN if any(entry is UNKNOWN for entry in found) else found
            case ast.Slice(lower=lower, upper=upper, step=step):
                ends = [None if end is None else self._index(end) for end in (lower, upper, step)]
                return UNKNOWN if any(end is UNKNOWN for end in ends) else slice(*ends)
        value = self._value(node)
        return value if type(value) in (int, np.int64) else UNKNOWN


def text(node: ast.AST) -> str:
    """An expression as source, on one short line."""
    return one_line(ast.unparse(node), MOST_TEXT)


def _is_small(value) -> bool:
    if type(value) is np.ndarray:
        return value.size <= MOST_NUMBERS and value.dtype.kind in "biufc"
    return type(value) in NUMBERS


def _is_plain(value) -> bool:
    """Whether nothing in a list is of a type whose code NumPy would run."""
    if type(value) in (list, tuple):
        return len(value) <= MOST_NUMBERS and all(map(_is_plain, value))
    return type(value) in (*NUMBERS, np.ndarray)


def _places(error: BaseException):
    trace = error.__traceback__
    while trace is not None:
        yield trace.tb_lasti
        trace = trace.tb_next


def _node(code: CodeType, at: int) -> ast.AST | None:
    """The expression of the instruction at which the code stopped, or the statement x += y."""
    place = next(itertools.islice(code.co_positions(), at // 2, None), None)
    if place is None or None in place:
        return None
    for node in ast.walk(tree_of(code) or ast.Module([], [])):
        if isinstance(node, ast.expr | ast.AugAssign) and place == (
            node.lineno,
            node.end_lineno,
            node.col_offset,
            node.end_col_offset,
        ):
            return node
    return None


def tree_of(code: CodeType) -> ast.Module | None:
    """The cell, or file, that the code is from; None where its text is not known."""
    lines = linecache.getlines(code.co_filename)
    try:
        return ast.parse("".join(lines)) if lines else None
    except (SyntaxError, ValueError, RecursionError):
        return None
