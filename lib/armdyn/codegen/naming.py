"""Finds names for generated source: for symbols, as the language allows them, and for shared terms."""

import re

import sympy as sp

MEANINGS = {
    "l": "length, m",
    "lc": "joint to centre of mass, m",
    "ly": "centre of mass off the link's axis, m",
    "m": "mass, kg",
    "I": "inertia, kg m^2",
    "g": "gravitational acceleration, m/s^2",
}


def meaning(symbol) -> str:
    """What a parameter with the course's name for it is, with its unit; otherwise ''."""
    return MEANINGS.get(re.sub(r"_?\d+$", "", symbol.name), "")


def checked_name(name: str, reserved) -> str:
    """`name`; ValueError unless generated source may call its model so."""
    if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name):
        raise ValueError(f"name = {name!r}: needs ASCII letters and digits, a letter first")
    if name in reserved:
        raise ValueError(f"name = {name!r}: needs a name that the language does not reserve")
    return name


def identifiers(symbols, reserved, mark="_", underscores=True) -> dict[sp.Symbol, sp.Symbol]:
    """For each symbol one whose name is an identifier, its own name wherever that is free.

    A name in `reserved` gets `mark` behind it. Without `underscores`, theta_dot becomes thetaDot.
    Raises ValueError for a name that is no ASCII identifier, and for two symbols of one name.
    """
    named = {}
    for symbol in symbols:
        name = symbol.name
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name):
            raise ValueError(
                f"symbol {name!r}: needs a name of ASCII letters, digits and _, a letter first"
            )
        if not underscores:
            name = re.sub(r"_+(.?)", lambda found: found[1].upper(), name)
        while name in reserved:
            name += mark
        named[symbol] = name
    for symbol, name in named.items():
        if any(s != symbol and other == name for s, other in named.items()):
            raise ValueError(f"symbol {symbol.name!r}: needs a name that no other symbol has")
    return {s: sp.Symbol(name, **s.assumptions0) for s, name in named.items()}


class TermNames:
    """Names for shared terms as one would write them by hand: s12 = sin(q1 + q2), lc1sq = lc1²."""

    def __init__(self, symbols, taken):
        self.symbols = set(symbols)
        self.taken = set(taken)
        self.meaning = {}  # of each name given to a sum of the model's own symbols
        self.numbered = 0

    def give(self, term, preferred="") -> sp.Symbol:
        """A new symbol for `term`; `preferred` where that is free."""
        meaning = term.xreplace(self.meaning)
        name = preferred or self._suggested(term, meaning)
        while not name or name in self.taken:
            self.numbered += 1
            name = f"t{self.numbered}"
        self.taken.add(name)
        symbol = sp.Symbol(name, real=True)
        if meaning.is_Add and self.symbols.issuperset(meaning.args):
            self.meaning[symbol] = meaning
        return symbol

    def _suggested(self, term, meaning):
        if isinstance(term, sp.sin | sp.cos | sp.tan):
            angle = self._sum(meaning.args[0])
            if angle:
                index = re.fullmatch(r"q(\d[\d_]*)", angle)
                head = type(term).__name__
                return f"{head[0]}{index[1]}" if index else f"{head}{angle}"
        if isinstance(term, sp.Add):
            return self._sum(meaning)
        if isinstance(term, sp.Mul | sp.Pow):
            return self._product(term)
        return ""

    def _sum(self, expression):
        """q1 + q2 as q12, m2 + m3 as m23; '' for what is not a sum of one kind of symbol."""
        terms = sp.Add.make_args(expression)
        found = [re.fullmatch(r"(\D+)(\d*)", s.name) for s in terms if s in self.symbols]
        parts = [part for part in found if part]
        if len(parts) < len(terms):
            return ""
        if len(parts) == 1:
            return parts[0][0]
        heads = {part[1] for part in parts}
        indices = sorted(int(part[2] or 0) for part in parts)
        if len(heads) > 1 or indices[0] == 0 or indices[-1] > 9:
            return ""
        return heads.pop() + "".join(map(str, indices))

    def _product(self, term):
        """lc2·m2 as lc2m2, of up to four factors that have names, squares among them."""
        names = []
        for factor in sp.Mul.make_args(term):
            base, exponent = factor.as_base_exp()
            if not base.is_Symbol or exponent not in (1, 2) or re.fullmatch(r"t\d+", base.name):
                return ""
            names.append(base.name + ("sq" if exponent == 2 else ""))
        name = "".join(names)
        return name if len(names) <= 4 and len(name) <= 12 else ""
