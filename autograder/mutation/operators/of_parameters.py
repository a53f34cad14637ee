"""A parameter that is wrong in a term: another one, one more, one less, or in another power."""

import sympy as sp

from autograder.mutation.operators.rewriting import Rewriting, pairs

EARTH = 9.81


def wrong_parameter(term, mechanism):
    """Another parameter of the same unit."""
    for parameter, other in pairs(term, mechanism):
        wrong = term.xreplace({parameter.symbol: other.symbol})
        yield Rewriting("wrong parameter", wrong, other.name, parameter.name)


def parameter_added(term, mechanism):
    """A sum of two parameters where one stands alone, as a mass is carried along that is not."""
    for parameter, other in pairs(term, mechanism):
        total = parameter.symbol + other.symbol
        wrong = term.xreplace({parameter.symbol: total})
        yield Rewriting("parameter added", wrong, other.name, parameter.name)


def parameters_exchanged(term, mechanism):
    for a, b in pairs(term, mechanism):
        exchanged = term.xreplace({a.symbol: b.symbol, b.symbol: a.symbol})
        first, second = sorted((a.name, b.name))
        yield Rewriting("parameters exchanged", exchanged, first, second)


def about_another_point(term, mechanism):
    """An inertia to which the parallel-axis theorem was applied, wrongly, or a point mass for it."""
    for inertia in mechanism.parameters:
        if inertia.unit != "kg·m²" or inertia.symbol not in term.free_symbols:
            continue
        lengths = list(_beside(inertia, "m", mechanism))
        for mass in _beside(inertia, "kg", mechanism):
            for length in lengths:
                moved = mass.symbol * length.symbol**2
                for name, put in (
                    ("parallel axis added", inertia.symbol + moved),
                    ("parallel axis taken off", inertia.symbol - moved),
                    ("point mass", moved),
                ):
                    wrong = term.xreplace({inertia.symbol: put})
                    detail = f"with {length.name}" if len(lengths) > 1 else ""
                    yield Rewriting(name, wrong, mass.name, inertia.name, detail=detail)
            wrong = term.xreplace({inertia.symbol: mass.symbol})
            yield Rewriting("mass for inertia", wrong, mass.name, inertia.name)


def _beside(parameter, unit, mechanism):
    """The parameters of a unit that have the same number: m2, l2 and lc2 of I2."""
    number = parameter.name[len(parameter.name.rstrip("0123456789")) :]
    for other in mechanism.parameters:
        if other.unit == unit and other.name[len(other.name.rstrip("0123456789")) :] == number:
            yield other


def square_lost(term, mechanism):
    known = {p.symbol for p in mechanism.parameters}
    known |= {c.symbol for c in mechanism.coordinates if c.unit == "m"}
    squares = [e for e in term.atoms(sp.Pow) if e.base in known and e.exp == 2]
    for square in sorted(squares, key=sp.default_sort_key):
        wrong = term.xreplace({square: square.base})
        yield Rewriting("square lost", wrong, square.base.name, f"{square.base.name}²")


def square_added(term, mechanism):
    """A mass or a length squared that belongs once."""
    known = [p.symbol for p in mechanism.parameters if p.unit != "m/s²"]
    known += [c.symbol for c in mechanism.coordinates if c.unit == "m"]
    powers = {e.base for e in term.atoms(sp.Pow)}
    for symbol in known:
        if symbol in term.free_symbols and symbol not in powers:
            wrong = term.xreplace({symbol: symbol**2})
            yield Rewriting("square added", wrong, symbol.name)


def parameter_inverted(term, mechanism):
    """Divided by a mass or a length that should multiply."""
    for parameter in mechanism.parameters:
        if parameter.symbol in term.free_symbols:
            wrong = term.xreplace({parameter.symbol: 1 / parameter.symbol})
            yield Rewriting("parameter inverted", wrong, parameter.name)


def sum_of_lengths(term, mechanism):
    """A length forgotten in a sum such as r0 + s, or the sum squared part by part."""
    lengths = {p.symbol for p in mechanism.parameters if p.unit == "m"}
    lengths |= {c.symbol for c in mechanism.coordinates if c.unit == "m"}
    sums = {e for e in sp.preorder_traversal(term) if e.is_Add and e.free_symbols <= lengths}
    for total in sorted(sums, key=sp.default_sort_key):
        if not all(part.is_Symbol or (-part).is_Symbol for part in total.args):
            continue
        names = [part.free_symbols.pop().name for part in total.args]
        for part, name in zip(total.args, names, strict=True):
            yield Rewriting("length left out", term.xreplace({total: total - part}), "", name)
        squares = sp.Add(*(part**2 for part in total.args))
        yield Rewriting(
            "squared part by part", term.xreplace({total**2: squares}), " and ".join(sorted(names))
        )


def parameter_left_out(term, mechanism):
    for parameter in mechanism.parameters:
        if parameter.symbol in term.free_symbols:
            wrong = term.xreplace({parameter.symbol: sp.S.One})
            yield Rewriting("parameter left out", wrong, "", parameter.name)


def kind_left_out(term, mechanism):
    """All masses, say, where a formula is written for bodies of 1 kg."""
    for unit in dict.fromkeys(p.unit for p in mechanism.parameters):
        there = [p.symbol for p in mechanism.parameters if p.unit == unit]
        if len(there) > 1 and term.free_symbols & set(there):
            wrong = term.xreplace(dict.fromkeys(there, sp.S.One))
            yield Rewriting("kind left out", wrong, "", unit)


def gravity_of_earth(term, mechanism):
    for parameter in mechanism.parameters:
        if parameter.unit == "m/s²" and parameter.symbol in term.free_symbols:
            wrong = term.xreplace({parameter.symbol: sp.Float(EARTH)})
            yield Rewriting("gravity of Earth", wrong, "9.81", parameter.name)
