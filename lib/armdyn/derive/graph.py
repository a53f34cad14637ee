"""Walks expressions as the graphs they are: a part that many places share is met once.

SymPy's own walks (`free_symbols`, `atoms`, `xreplace`) go through an expression as if it were written
out. That of a robot with seven joints is a thousand times longer so.
"""

from collections import Counter
from collections.abc import Iterator, Mapping

import sympy as sp

_KINDS = {"sum": sp.Add, "product": sp.Mul, "power": sp.Pow}


def parts(expressions) -> Iterator[sp.Basic]:
    """Every part of the expressions once, each after its own parts."""
    met = set()
    waiting = [(e, False) for e in reversed(list(expressions))]
    while waiting:
        e, ready = waiting.pop()
        if e in met:
            continue
        if ready or not e.args:
            met.add(e)
            yield e
        else:
            waiting.append((e, True))
            waiting += ((a, False) for a in reversed(e.args) if a not in met)


def symbols(expressions) -> set[sp.Symbol]:
    """The symbols in the expressions."""
    return {e for e in parts(expressions) if e.is_Symbol}


def replaced(expressions, new: Mapping) -> list[sp.Expr]:
    """The expressions with symbols replaced and nothing else changed."""
    found = dict(new)
    for e in parts(expressions):
        if e not in found:
            args = [found[a] for a in e.args]
            found[e] = e if args == list(e.args) else _rebuilt(e, args)
    return [found[e] for e in expressions]


def shared(expressions, names) -> tuple[list, list]:
    """(steps, expressions): what is used more than once as (symbol, expression), in order.

    As `sympy.cse`, in time proportional to the graph, and without a search for what sums or products
    have in common. A negative is written out, as it costs nothing. names: an iterator of symbols.
    """
    every = list(parts(expressions))
    uses = Counter(a for e in every for a in e.args)
    uses.update(expressions)
    # A negative's uses are its argument's.
    for e in every:
        if _is_negative(e) and uses[e] > 1:
            uses[e.args[1]] += uses[e] - 1
    steps: list[tuple[sp.Symbol, sp.Expr]] = []
    found: dict[sp.Basic, sp.Basic] = {}
    for e in every:
        args = [found[a] for a in e.args]
        found[e] = e if args == list(e.args) else _rebuilt(e, args)
        if uses[e] > 1 and e.args and not _is_negative(e) and isinstance(e, sp.Expr):
            symbol = next(names)
            steps.append((symbol, found[e]))
            found[e] = symbol
    return steps, [found[e] for e in expressions]


def packed(expressions) -> list[tuple]:
    """The graph as a table that `unpacked` reads: a row for each part, then the expressions' rows.

    SymPy's own pickles evaluate every sum and product again. What is none, as a sine, is kept whole.
    """
    places: dict[sp.Basic, int] = {}
    rows: list[tuple] = []
    for e in parts(expressions):
        places[e] = len(rows)
        kind = next((name for name, of in _KINDS.items() if isinstance(e, of)), None)
        rows.append((kind, tuple(places[a] for a in e.args)) if kind else (e,))
    return [*rows, tuple(places[e] for e in expressions)]


def unpacked(table: list[tuple]) -> list[sp.Expr]:
    """The expressions of `packed`."""
    found: list[sp.Basic] = []
    for row in table[:-1]:
        if len(row) == 1:
            found.append(row[0])
        else:
            kind, places = row
            found.append(_KINDS[kind](*(found[i] for i in places), evaluate=False))
    return [found[i] for i in table[-1]]


def slopes(expressions, symbols) -> list[list[sp.Expr]]:
    """∂e/∂s for each expression e, in rows, and each symbol s, with shared parts as the expressions.

    Raises ValueError for a Piecewise that depends on a symbol.
    """
    every = list(parts(expressions))
    columns = [_slopes(every, symbol) for symbol in symbols]
    return [[column[e] for column in columns] for e in expressions]


def held(expressions) -> tuple[list[sp.Expr], dict[sp.Symbol, sp.Expr]]:
    """(expressions, back): signs and steps as symbols, since they are constant but where they jump.

    |x| becomes x sign(x). `replaced(…, back)` undoes it; without a sign or step nothing changes.
    """
    expressions = list(expressions)
    new: dict[sp.Basic, sp.Expr] = {}
    back: dict[sp.Symbol, sp.Expr] = {}
    jumps = (sp.sign, sp.Heaviside, sp.floor, sp.ceiling)
    for e in parts(expressions):
        if isinstance(e, (*jumps, sp.Abs)):
            jump = sp.sign(e.args[0]) if isinstance(e, sp.Abs) else e
            if jump not in new:
                new[jump] = sp.Dummy(real=True)
                back[new[jump]] = jump
            if isinstance(e, sp.Abs):
                new[e] = replaced([e.args[0]], new)[0] * new[jump]
    return (replaced(expressions, new), back) if new else (expressions, {})


def _slopes(every, symbol):
    found: dict[sp.Basic, sp.Expr] = {}
    for e in every:
        moving = [i for i, a in enumerate(e.args) if found[a] != 0]
        if not moving:
            found[e] = sp.S.One if e == symbol else sp.S.Zero
        elif e.is_Add:
            found[e] = _sum([found[e.args[i]] for i in moving])
        elif e.is_Mul:
            found[e] = _sum(
                [_product([*e.args[:i], found[e.args[i]], *e.args[i + 1 :]]) for i in moving]
            )
        elif isinstance(e, sp.Piecewise) or not isinstance(e, sp.Expr):
            raise ValueError(f"{e}: needs sums, products, powers and smooth functions")
        else:
            stand_ins = [sp.Dummy(real=True) for _ in e.args]
            back = dict(zip(stand_ins, e.args, strict=True))
            outer = e.func(*stand_ins)
            by_argument = replaced([outer.diff(stand_ins[i]) for i in moving], back)
            found[e] = _sum(
                [_product([a, found[e.args[i]]]) for a, i in zip(by_argument, moving, strict=True)]
            )
    return found


def _sum(addends):
    addends = [a for a in addends if a != 0]
    return sp.Add(*addends, evaluate=False) if len(addends) > 1 else sum(addends, sp.S.Zero)


def _product(factors):
    number = sp.prod([f for f in factors if f.is_Number])
    rest = [f for f in factors if not f.is_Number]
    factors = rest if number == 1 else [number, *rest]
    return sp.Mul(*factors, evaluate=False) if len(factors) > 1 else sp.prod(factors)


def _is_negative(e):
    return e.is_Mul and len(e.args) == 2 and e.args[0] is sp.S.NegativeOne


def _rebuilt(e, args):
    # Sums and products as they stand: SymPy would flatten them.
    return e.func(*args, evaluate=False) if e.is_Add or e.is_Mul else e.func(*args)
