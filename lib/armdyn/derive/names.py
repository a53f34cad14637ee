"""Refuses symbols that would be taken for one another: SymPy tells them apart, a reader does not.

`Symbol("m")` and `Symbol("m", positive=True)` are two symbols. Derivatives by the one leave the other
alone, and a model that asks for the number of "m" cannot say which one it means.
"""

from collections import Counter

import sympy as sp


def refuse_shared(symbols, where: str) -> None:
    """ValueError, saying where, if two different symbols have one name."""
    different = set(symbols)
    counts = Counter(s.name for s in different)
    shared = sorted(name for name, count in counts.items() if count > 1)
    if shared:
        made = sorted(sp.srepr(s) for s in different if s.name == shared[0])
        raise ValueError(
            f"{where}: {len(made)} different symbols are called {shared[0]}: {', '.join(made)}; "
            "make the symbol once and use it everywhere, or rename the others"
        )


def refuse_taken(given, symbols, where: str, instead: str) -> None:
    """ValueError, saying where, if a symbol has a name that armdyn gives to something else.

    given: name → what armdyn calls so. instead: what a user can do who will not rename the symbol.
    """
    for name in sorted({s.name for s in symbols} & given.keys()):
        raise ValueError(
            f"{where}: the symbol {name} has the name of {given[name]}; rename it, or {instead}"
        )
