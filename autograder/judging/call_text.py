"""A call as a student can paste it into the notebook, and the lines that give its arguments."""

import ast
from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from autograder.protocol import Call, Expressions, Function, Symbol

LONGEST_ARRAY = 12  # entries; a longer one stands in a call by its name
FEW = (3, 4)  # significant digits of a call, tried in turn before SHORT
SHORT, EXACT = 6, 17  # significant digits: of numbers to be read, and of numbers to the last bit


def arguments(signature: str) -> list[str]:
    """The names of a function's arguments: "M(q, arm)" has q and arm."""
    inside = signature.partition("(")[2].removesuffix(")")
    return inside.split(", ") if inside else []


def shown_call(call: Call, signature: str, digits: int = SHORT) -> str:
    """A call as Python that runs in the student's notebook.

    Arguments that would be long, and symbols, stand by their names: `given_by` says what gives them.
    """
    names = arguments(signature)
    if not _is_by_name(call):
        return f"{call.name}({', '.join(_shown(value, digits) for value in call.args)})"
    plain = f"{call.name}({', '.join(names)})"
    if not call.at:
        return plain
    if any(isinstance(value, Expressions) for value in call.args):
        plain = f"sp.Matrix({plain})"
    symbols = _symbols(names, call.args)
    point = ", ".join(f"{symbols[of]}: {_number(at, digits)}" for of, at in call.at[-1].items())
    return f"{plain}.subs({{{point}}})"


def by_name(call: Call, signature: str) -> str:
    """The call with its arguments' names for them, which the lines of `given_by` define."""
    if _is_by_name(call):
        return shown_call(call, signature)
    return f"{call.name}({', '.join(arguments(signature))})"


def given_by(call: Call, signature: str, id: str) -> str:
    """The lines that define a call's arguments, in any cell of the notebook; "" where it has none.

    They tell the shapes of those that are too long to be shown.
    """
    names = arguments(signature)
    if not names:
        return ""
    lines = ["import sympy as sp"] if shown_call(call, signature).startswith("sp.") else []
    lines += ["from autograder import worst_case", f'{", ".join(names)} = worst_case("{id}")']
    return "\n".join(lines) + shapes(call, signature)


def shapes(call: Call, signature: str) -> str:
    """A line with the shapes of the arguments that `shown_call` shows by their names; "" for none."""
    said = [
        f"{name} {value.shape}"
        for name, value in zip(arguments(signature), call.args, strict=False)
        if isinstance(value, np.ndarray) and value.size > LONGEST_ARRAY
    ]
    return f"\n# {', '.join(said)}" if said else ""


def rounded(call: Call, digits: int = SHORT) -> Call:
    """The call whose numbers are those that `shown_call` shows."""
    at = tuple({of: float(_number(v, digits)) for of, v in point.items()} for point in call.at)
    return replace(call, args=tuple(_rounded(value, digits) for value in call.args), at=at)


def _is_by_name(call: Call) -> bool:
    return any(map(_is_long, call.args))


def _is_long(value) -> bool:
    """Whether an argument stands by its name: a symbol, or a long array, also in a namespace."""
    if isinstance(value, SimpleNamespace):
        return any(map(_is_long, vars(value).values()))
    return isinstance(value, Symbol | Expressions) or (
        isinstance(value, np.ndarray) and value.size > LONGEST_ARRAY
    )


def _symbols(names: list[str], args: tuple) -> dict[str, str]:
    """How each symbol of the arguments is written, once these stand in variables: q2 is q[1]."""
    found = {}
    for name, value in zip(names, args, strict=False):
        if isinstance(value, Symbol):
            found[value.name] = name
        elif isinstance(value, tuple):
            found |= {s.name: f"{name}[{k}]" for k, s in enumerate(value) if isinstance(s, Symbol)}
    return found


def _shown(value, digits: int) -> str:
    match value:
        case Function(arguments=given, returns=text):
            return f"lambda {given}: np.array({_with_prefix(text, given)}, dtype=float)"
        case SimpleNamespace():
            entries = (f"{name}={_shown(entry, digits)}" for name, entry in vars(value).items())
            return f"SimpleNamespace({', '.join(entries)})"
        case tuple():
            return f"[{', '.join(_shown(entry, digits) for entry in value)}]"
        case np.ndarray():
            return f"np.array({_nested(value.tolist(), digits)})"
    return _number(value, digits)


def _nested(value, digits: int) -> str:
    if isinstance(value, list):
        return f"[{', '.join(_nested(entry, digits) for entry in value)}]"
    return _number(value, digits)


def _number(value: float, digits: int) -> str:
    """As a float in Python, 2.0 and not 2, but where it is a count."""
    if isinstance(value, int):
        return str(value)
    if not np.isfinite(value):
        return f"float('{value}')"
    return repr(float(f"{value:.{digits}g}"))


def _with_prefix(text: str, given: str) -> str:
    """Source that uses NumPy's names, as one that says where they are from: sin is np.sin."""
    own = {name.strip() for name in given.split(",")}
    tree = ast.parse(text, mode="eval")
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id not in own:
            node.id = f"np.{node.id}"
    return ast.unparse(tree)


def _rounded(value, digits: int):
    match value:
        case SimpleNamespace():
            return SimpleNamespace(**{n: _rounded(v, digits) for n, v in vars(value).items()})
        case tuple():
            return tuple(_rounded(entry, digits) for entry in value)
        case np.ndarray() if value.size <= LONGEST_ARRAY:
            flat = [float(_number(entry, digits)) for entry in value.flat]
            return np.array(flat).reshape(value.shape)
        case float():
            return float(f"{value:.{digits}g}")
    return value
