"""Makes a tape of SymPy's expressions: what several of them share is computed once."""

from collections.abc import Callable, Sequence
from functools import reduce

import sympy as sp

from autograder.mutation.tape import Tape

# SymPy's functions, by the operations that compute them.
UNARY: dict[type, str] = {
    sp.sin: "sin",
    sp.cos: "cos",
    sp.tan: "tan",
    sp.asin: "arcsin",
    sp.acos: "arccos",
    sp.atan: "arctan",
    sp.sinh: "sinh",
    sp.cosh: "cosh",
    sp.tanh: "tanh",
    sp.exp: "exp",
    sp.log: "log",
    sp.sign: "sign",
    sp.Abs: "absolute",
}
BINARY: dict[type, str] = {
    sp.Add: "add",
    sp.Mul: "multiply",
    sp.Max: "maximum",
    sp.Min: "minimum",
    sp.atan2: "arctan2",
    sp.Heaviside: "heaviside",
}
FOLDED = (sp.Add, sp.Mul, sp.Max, sp.Min)


class UntapedError(ValueError):
    """An expression holds a function that no operation computes; the text names it."""


def taped(symbols: Sequence[sp.Symbol], expressions: Sequence[sp.Expr]) -> Tape:
    """The tape from the symbols' numbers to the expressions'.

    UntapedError where one holds another function than those above. What has no real value, as 1/0,
    is NaN.
    """
    graph = _Graph(symbols)
    return graph.tape([graph.place(sp.sympify(e)) for e in expressions])


class _Graph:
    """Each operation once, with the places of what it takes."""

    def __init__(self, symbols: Sequence[sp.Symbol]):
        self._inputs = len(symbols)
        self._of: dict[sp.Basic, int] = {symbol: i for i, symbol in enumerate(symbols)}
        self._made: dict[tuple, int] = {}
        self._nodes: list[tuple] = [()] * len(symbols)  # (operation, left, right) or (constant,)
        self._depths = [0] * len(symbols)

    def place(self, e: sp.Basic) -> int:
        if e not in self._of:
            self._of[e] = self._new(e)
        return self._of[e]

    def _new(self, e: sp.Basic) -> int:
        if not e.free_symbols:
            return self._node(_constant(e))
        if isinstance(e, sp.Pow):
            return self._power(*e.args)
        args = [self.place(arg) for arg in e.args]
        if isinstance(e, FOLDED):
            return _folded(lambda a, b: self._node(BINARY[e.func], a, b), args)
        if e.func in UNARY and len(args) == 1:
            return self._node(UNARY[e.func], args[0])
        if e.func in BINARY and len(args) == 2:
            return self._node(BINARY[e.func], *args)
        known = ", ".join(sorted(kind.__name__ for kind in UNARY))
        raise UntapedError(f"{e} holds {e.func}, of which no numbers are made; known are {known}")

    def _power(self, base: sp.Basic, exponent: sp.Basic) -> int:
        if exponent.is_negative and exponent.is_number:
            return self._node("reciprocal", self.place(base ** (-exponent)))
        if exponent == 2:
            return self._node("square", self.place(base))
        if exponent == sp.Rational(1, 2):
            return self._node("sqrt", self.place(base))
        if exponent.is_Integer and exponent > 0:
            return reduce(
                lambda a, b: self._node("multiply", a, b), int(exponent) * [self.place(base)]
            )
        return self._node("power", self.place(base), self.place(exponent))

    def _node(self, *key) -> int:
        if key not in self._made:
            self._made[key] = len(self._nodes)
            self._nodes.append(key)
            self._depths.append(1 + max((self._depths[i] for i in key[1:]), default=-1))
        return self._made[key]

    def tape(self, outputs: list[int]) -> Tape:
        """Those operations that the outputs need, the same ones of one depth together."""
        needed = self._needed(outputs)
        order = sorted(i for i in needed if i >= self._inputs)
        constants = [i for i in order if len(self._nodes[i]) == 1]
        groups: dict[tuple, list[int]] = {}
        for i in order:
            operation, *taken = self._nodes[i]
            if taken:
                groups.setdefault((self._depths[i], operation, len(taken)), []).append(i)
        steps, place = [], {i: i for i in range(self._inputs)}
        for i in constants:
            place[i] = len(place)
        for (_, operation, count), members in sorted(groups.items()):
            columns = [[place[self._nodes[i][1 + k]] for i in members] for k in range(count)]
            steps.append((operation, columns[0], columns[1] if count == 2 else []))
            for i in members:
                place[i] = len(place)
        return Tape(
            self._inputs,
            [self._nodes[i][0] for i in constants],
            steps,
            [place[i] for i in outputs],
        )

    def _needed(self, outputs: list[int]) -> set[int]:
        found: set[int] = set()
        left = list(outputs)
        while left:
            i = left.pop()
            if i not in found:
                found.add(i)
                left += self._nodes[i][1:]
        return found


def _folded(combine: Callable[[int, int], int], places: list[int]) -> int:
    """All combined in pairs, then the pairs in pairs: few steps follow each other."""
    while len(places) > 1:
        pairs = [combine(*places[i : i + 2]) for i in range(0, len(places) - 1, 2)]
        places = pairs + places[2 * len(pairs) :]
    return places[0]


def _constant(e: sp.Basic) -> float:
    try:
        return float(sp.sympify(e).evalf(17))
    except TypeError:  # infinite in all directions, or complex
        return float("nan")
