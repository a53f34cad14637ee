"""What Python says of names, lists, functions, texts and powers, in the student's own names."""

import ast
import difflib
import re
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np

from .row import Row, Words
from .scene import CALLABLE, UNKNOWN, Scene, text

# What NumPy calls otherwise than SymPy.
OF_SYMPY = {
    "absolute": "Abs",
    "abs": "Abs",
    "fabs": "Abs",
    "arccos": "acos",
    "arcsin": "asin",
    "arctan": "atan",
    "arctan2": "atan2",
    "power": "Pow",
    "pow": "Pow",
}
SAME_IN_SYMPY = {
    "cos", "sin", "tan", "exp", "log", "sqrt", "sign", "cosh", "sinh", "tanh", "acos", "asin", "atan",
    "atan2",
}  # fmt: skip
MOST_NAMES = 12
NOT_SYMBOLS = "list|tuple|dict|str|NoneType|function|method|set|SimpleNamespace"


def _array_of_numbers(scene: Scene, found, error) -> Words | None:
    """The array into which an expression was to be put."""
    node = scene.find(ast.Subscript)
    return (text(node.value),) if node and type(scene.value(node.value)) is np.ndarray else None


def _function_for_numbers(scene: Scene, found, error) -> Words | None:
    """SymPy's function that refused an array, and NumPy's own."""
    call = scene.find(ast.Call)
    called = text(call.func) if call else ""
    name = called.rpartition(".")[2]
    numpy = next((np_name for np_name, sp_name in OF_SYMPY.items() if sp_name == name), name)
    return (called, f"np.{numpy}") if isinstance(getattr(np, numpy, None), np.ufunc) else None


def _function_of_symbols(scene: Scene, found: re.Match, error) -> Words:
    """The function that refused a symbol, and SymPy's own."""
    call = scene.find(ast.Call)
    called = text(call.func) if call else ""
    name = (called.rpartition(".")[2] or found.groupdict().get("name") or "").strip()
    if name not in SAME_IN_SYMPY and name not in OF_SYMPY:
        return "A function of NumPy or of math", "sp.cos"
    return called or f"np.{name}", f"sp.{OF_SYMPY.get(name, name)}"


def _power(scene: Scene, found, error) -> Words:
    node = scene.find(ast.BinOp)
    if node is None or not isinstance(node.op, ast.BitXor):
        return ("2",)
    power = node.right
    while isinstance(power, ast.BinOp):  # ^ binds less than all of these, unlike a power
        power = power.left
    return (text(power),)


def _by_name(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.Subscript)
    if node is None:
        return None
    owner, key = scene.value(node.value), scene.value(node.slice)
    if type(owner) is not SimpleNamespace or not vars(owner):
        return None
    name = key if isinstance(key, str) and key in vars(owner) else next(iter(vars(owner)))
    return text(node.value), f"{text(node.value)}.{name}", text(node)


def _no_name(scene: Scene, found, error) -> Words | None:
    if type(error.obj) is not SimpleNamespace:
        return None
    names = list(vars(error.obj))
    node = scene.find(ast.Attribute)
    # Before the letters are compared: L1 is l1.
    close = [name for name in names if name.casefold() == str(error.name).casefold()]
    close = close or difflib.get_close_matches(str(error.name), names, n=1, cutoff=0.6)
    shown = ", ".join(names[:MOST_NAMES]) + (", …" if len(names) > MOST_NAMES else "")
    meant = f" Did you mean {close[0]}?" if close else ""
    return text(node.value) if node else "It", str(error.name), shown, meant


def _of_array(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.Attribute)
    if type(error.obj) is not np.ndarray or node is None:
        return None
    of, name = text(node.value), str(error.name)
    use = f" Write np.{name}({of})." if isinstance(getattr(np, name, None), np.ufunc) else ""
    return of, str(error.obj.shape), name, use


def _list_attribute(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.Attribute)
    if (
        type(error.obj) not in (list, tuple)
        or node is None
        or not hasattr(np.ndarray, str(error.name))
    ):
        return None
    return text(node.value), str(error.name)


def _operand(fits: Callable[[object], bool]):
    """Which operand of a sign is of this kind."""

    def words(scene: Scene, found, error) -> Words | None:
        node = scene.find(ast.BinOp, ast.Subscript, ast.UnaryOp)
        parts: list[ast.AST] = []
        if isinstance(node, ast.BinOp):
            parts = [node.left, node.right]
        elif isinstance(node, ast.Subscript):
            parts = [node.value]
        elif isinstance(node, ast.UnaryOp):
            parts = [node.operand]
        for part in parts:
            value = scene.value(part)
            if isinstance(part, ast.Attribute) and value is UNKNOWN and fits is _is_function:
                value = _of_module(scene, part)
            if value is not UNKNOWN and fits(value):
                return (text(part),)
        return None

    return words


def _of_module(scene: Scene, node: ast.Attribute):
    """np.cos, as modules are not looked into otherwise."""
    if isinstance(node.value, ast.Name) and scene.value(node.value) is np:
        return getattr(np, node.attr, UNKNOWN)
    return UNKNOWN


def _is_function(value) -> bool:
    return isinstance(value, CALLABLE)


def _called(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.Call)
    return (text(node.func),) if node else None


def _entries_called(scene: Scene, found, error) -> Words | None:
    """An array or a list with one whole number in round brackets behind it."""
    node = scene.find(ast.Call)
    if node is None or node.keywords or not node.args:
        return None
    at = [scene.value(part) for part in node.args]
    if type(scene.value(node.func)) not in (np.ndarray, list, tuple) or {*map(type, at)} != {int}:
        return None
    of, index = text(node.func), ", ".join(map(text, node.args))
    return of, f"{of}[{index}]"


def _divisor(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.BinOp)
    if node is None or not isinstance(node.op, ast.Div) or isinstance(node.right, ast.Constant):
        return None
    return (text(node.right),)


def _out_of_domain(scene: Scene, found, error) -> Words | None:
    call = scene.find(ast.Call)
    if call is None or len(call.args) != 1:
        return None
    return text(call.func), text(call.args[0])


SIGNS = r"unsupported operand type\(s\) for .*: "
ROWS = (
    Row(
        "symbol put into",
        ("TypeError",),
        r"^Cannot convert expression to float",
        "{0} is an array of numbers, as np.zeros makes it, and this is a SymPy expression. "
        "A matrix made by sp.zeros takes it.",
        _array_of_numbers,
    ),
    Row(
        "array for a symbol",
        ("AttributeError",),
        r"^'ImmutableDenseNDimArray' object has no attribute",
        "{0} is for symbols, and this is an array of numbers: NumPy's own is {1}.",
        _function_for_numbers,
    ),
    Row(
        "symbols",
        ("TypeError",),
        rf"^loop of ufunc does not support argument \d+ of type (?!({NOT_SYMBOLS})\b)\w+ which has no "
        r"callable (?P<name>\w+) method|^Cannot convert expression to float",
        "{0} takes only numbers, and this is a SymPy expression: SymPy's own is {1}.",
        _function_of_symbols,
    ),
    Row(
        "power",
        ("TypeError",),
        r"unsupported operand type\(s\) for \^|bitwise_xor|expecting bool or Boolean",
        "In Python ^ is no power; the power is **, as in x**{0}.",
        _power,
    ),
    Row(
        "by name",
        ("TypeError",),
        r"SimpleNamespace' object (is not subscriptable|does not support item)",
        "{0} keeps its numbers by name: write {1}, not {2}.",
        _by_name,
    ),
    Row(
        "no name",
        ("AttributeError",),
        r"has no attribute",
        "{0} has no {1}. It has {2}.{3}",
        _no_name,
    ),
    Row(
        "array attribute",
        ("AttributeError",),
        r"has no attribute",
        "{0} is an array of shape {1}, which has no {2}.{3}",
        _of_array,
    ),
    Row(
        "list attribute",
        ("AttributeError",),
        r"has no attribute",
        "{0} is a list. An array has .{1}: make it one with np.array({0}).",
        _list_attribute,
    ),
    Row(
        "none",
        ("TypeError",),
        rf"{SIGNS}.*'NoneType'|'NoneType' object is not subscriptable|bad operand type.*'NoneType'",
        "{0} is None. Does a function lack its return?",
        _operand(lambda value: value is None),
    ),
    Row(
        "some none",
        ("TypeError",),
        rf"{SIGNS}.*'NoneType'|'NoneType' object is not subscriptable|bad operand type.*'NoneType'",
        "A value is None there. Does a function lack its return?",
    ),
    Row(
        "function",
        ("TypeError",),
        rf"({SIGNS}|bad operand type).*'(function|builtin_function_or_method|method|numpy\.ufunc|type)'"
        r"|'(function|builtin_function_or_method|method|numpy\.ufunc)' object is not subscriptable",
        "{0} is a function. Call it: write its arguments behind it, in round brackets.",
        _operand(_is_function),
    ),
    Row(
        "called entry",
        ("TypeError",),
        r"'(numpy\.ndarray|list|tuple)' object is not callable",
        "The entries of {0} stand in square brackets, {1}, and are counted from 0.",
        _entries_called,
    ),
    Row(
        "called number",
        ("TypeError",),
        r"'(float|int|numpy\.float64|numpy\.ndarray|list|tuple|(Imm|M)utableDenseMatrix|Symbol|Add|Mul|Pow)'"
        r" object is not callable",
        "{0} is no function, and brackets right behind it call it. Is a * missing there?",
        _called,
    ),
    Row(
        "text",
        ("TypeError", "UFuncTypeError"),
        rf"{SIGNS}.*'str'|can only concatenate str|dtype\('<U|StrDType|can't multiply sequence",
        "{0} is a text, as it stands in quotes.",
        _operand(lambda value: type(value) is str),
    ),
    Row(
        "list times",
        ("TypeError",),
        rf"can't multiply sequence by non-int|{SIGNS}.*'(list|tuple)'|can only concatenate (list|tuple)",
        "{0} is a list, and lists have no arithmetic: make it an array with np.array({0}).",
        _operand(lambda value: type(value) in (list, tuple)),
    ),
    Row(
        "list index",
        ("TypeError",),
        r"(list|tuple) indices must be integers or slices, not tuple",
        "{0} is a list. An array takes two indices: make it one with np.array({0}).",
        _operand(lambda value: type(value) in (list, tuple)),
    ),
    Row(
        "complex",
        ("TypeError",),
        r"not 'complex'|not complex|can't convert complex",
        "The number is complex. Is it a root of something negative?",
    ),
    Row(
        "domain",
        ("ValueError",),
        r"math domain error|^expected a (nonnegative|positive) input",
        "{0} has no value at {1}. Is that negative, or out of its range?",
        _out_of_domain,
    ),
    Row("zero", ("ZeroDivisionError",), r"", "{0} is 0 in this call.", _divisor),
    Row(
        "relation",
        ("TypeError",),
        r"^cannot determine truth value of Relational",
        "A condition on symbols is neither True nor False before they have values.",
    ),
)
