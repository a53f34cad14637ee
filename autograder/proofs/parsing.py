"""Reads a line: text in, a tree out, in bounded time.

SymPy's own parser runs what it reads as Python, which no text of a student's may do outside the sandbox,
and it knows no product without a sign, as in qd' M qd. This grammar is small enough to read it here.
"""

import re
from collections.abc import Collection, Mapping

from autograder.proofs.expression import (
    Derivative,
    Name,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Transpose,
    Wave,
    minus,
)
from autograder.proofs.indices import SLOPE, UNREAD
from autograder.proofs.notation import plain
from autograder.protocol.proofs import MOST_CHARACTERS

DEEPEST = 24
HIGHEST_POWER = 4
MOST_DERIVATIVES = 2  # one inside the other
MOST_SIGNS = 4  # behind one factor
LARGEST_NUMBER = 1000.0
WAVES = ("sin", "cos")
_TOKEN = re.compile(
    r"\s*(?:(?P<by>d\s*/\s*d(?:t|qd|q)\b|ddt\b)|(?P<number>\d{1,4}(?:\.\d{1,3})?(?![\d.]))"
    r"|(?P<name>[A-Za-z][A-Za-z0-9]*)|(?P<sign>\.T\b|[-+*/^()'\[\]]))"
)
_RELATION = re.compile(r"(>=|=>|==|=|>)")


class LineError(ValueError):
    """A line that cannot be read, in one sentence for the student."""


def relation_and_sides(text: str) -> tuple[str, str, str]:
    """("=", before, after) of "A = B" and of "= B", in which before is "". Of "B": ("", "", B).

    LineError for a second relation, an empty line or one that is too long.
    """
    if not isinstance(text, str):
        raise LineError("A line is text in quotes.")
    if len(text) > MOST_CHARACTERS:
        raise LineError(f"This line has more than {MOST_CHARACTERS} characters: split it.")
    pieces = _RELATION.split(plain(text))
    if len(pieces) > 3:
        raise LineError("Write one = on a line, and the next step on a line of its own.")
    if len(pieces) == 3:
        before, relation, after = pieces
        if not after.strip():
            raise LineError(f"Nothing stands behind {relation}.")
        return {"==": "=", "=>": ">="}.get(relation, relation), before.strip(), after.strip()
    if not pieces[0].strip():
        raise LineError("This line is empty.")
    return "", "", pieces[0].strip()


class Parser:
    """Reads expressions in given names.

    rates: the name of a rate → the name it is the rate of (Mdot → M). variables: those of partial
    derivatives. short: names → what they stand for, as text.
    """

    def __init__(
        self,
        names: Collection[str],
        rates: Mapping[str, str],
        variables: Collection[str],
        short: Mapping[str, str],
    ):
        self._short: dict[str, Node] = {}
        self._variables = frozenset(variables)
        self._names = frozenset(names)
        self._rates = rates
        self._short |= {name: self.read(text) for name, text in short.items()}

    def read(self, text: str) -> Node:
        """The tree. LineError, naming what cannot be read."""
        if len(text) > 4 * MOST_CHARACTERS:
            raise LineError(f"This line has more than {MOST_CHARACTERS} characters: split it.")
        self._tokens = list(self._read_tokens(plain(text)))
        self._at = self._depth = self._differentiated = 0
        tree = self._sum()
        if self._at < len(self._tokens):
            raise LineError(f"{self._next()[1]!r} is not expected there.")
        return tree

    def _read_tokens(self, text: str):
        at = 0
        text = text.rstrip()
        while at < len(text):
            found = _TOKEN.match(text, at)
            if found is None:
                odd = text[at:].split()[0][:20]
                if odd.startswith(SLOPE):
                    raise LineError(
                        "A slope of an entry of M is read in a sum with the velocity of k."
                    )
                raise LineError(f"{odd!r} cannot be read here.")
            kind = str(found.lastgroup)
            value = found.group(kind)
            if kind == "name" and value not in (*WAVES, *self._names, *self._rates, *self._short):
                raise LineError(self._unknown(value))
            if kind == "number" and float(value) > LARGEST_NUMBER:
                raise LineError(f"The number {value} is larger than {LARGEST_NUMBER:g}.")
            yield kind, value
            at = found.end()

    def _unknown(self, name: str) -> str:
        if name == UNREAD:
            return "A sum is read over k with the velocity of k, or over the two links."
        known = ", ".join(sorted([*self._names, *self._rates, *self._short]))
        return f"{name[:20]!r} is no name of this derivation. The names are {known}."

    def _next(self) -> tuple[str, str]:
        return self._tokens[self._at] if self._at < len(self._tokens) else ("end", "")

    def _take(self, *signs: str) -> str:
        kind, value = self._next()
        if kind == "sign" and value in signs:
            self._at += 1
            return value
        return ""

    def _sum(self) -> Node:
        self._depth += 1
        if self._depth > DEEPEST:
            raise LineError("The brackets of this line are nested too deep.")
        sign = self._take("+", "-")
        terms = [minus(self._product()) if sign == "-" else self._product()]
        while sign := self._take("+", "-"):
            term = self._product()
            terms.append(minus(term) if sign == "-" else term)
        self._depth -= 1
        return terms[0] if len(terms) == 1 else Sum(tuple(terms))

    def _product(self) -> Node:
        made, quotients = self._power(), 0
        while True:
            if self._take("/"):
                quotients += 1
                if quotients > MOST_SIGNS:
                    raise LineError("There are too many / in this line.")
                made = Quotient(made, self._power())
            elif self._take("*") or self._starts():
                factor = self._power()
                before = made.factors if isinstance(made, Product) else (made,)
                made = Product((*before, factor))
            else:
                return made

    def _starts(self) -> bool:
        """Whether a factor follows without a sign."""
        kind, value = self._next()
        return kind in ("number", "name", "by") or (kind == "sign" and value in "([")

    def _power(self) -> Node:
        made, signs = self._atom(), 0
        while sign := self._take("^", "'", ".T"):
            signs += 1
            if signs > MOST_SIGNS:
                raise LineError("There are too many powers or transposes on one factor.")
            made = Power(made, self._exponent()) if sign == "^" else Transpose(made)
        return made

    def _exponent(self) -> int:
        bracket = self._take("(")
        negative = self._take("-")
        kind, value = self._next()
        if kind != "number" or "." in value or not 1 <= int(value) <= HIGHEST_POWER:
            raise LineError(f"A power is a whole number up to {HIGHEST_POWER}, -1 or T.")
        if negative and value != "1":
            raise LineError("The only negative power is -1.")
        self._at += 1
        if bracket and not self._take(")"):
            raise LineError("A bracket of this line is not closed.")
        return -int(value) if negative else int(value)

    def _atom(self) -> Node:
        kind, value = self._next()
        self._at += 1
        if kind == "number":
            return Number(float(value))
        if kind == "by":
            by = "t" if value == "ddt" else value.rpartition("/")[2].strip()[1:]
            if by not in ("t", *self._variables):
                return self._slopes(by)
            self._differentiated += 1
            if self._differentiated > MOST_DERIVATIVES:
                raise LineError("A derivative of a derivative of a derivative is not needed here.")
            inner = self._operand()
            self._differentiated -= 1
            return Derivative(inner, by)
        if kind == "name":
            if value in WAVES:
                return Wave(value, self._operand())
            if value in self._rates:
                return Derivative(Name(self._rates[value]), "t")
            return self._short.get(value) or Name(value)
        if kind == "sign" and value in "([":
            inner = self._sum()
            if not self._take({"(": ")", "[": "]"}[value]):
                raise LineError("A bracket of this line is not closed.")
            return inner
        if kind == "end":
            raise LineError("This line stops where something should follow.")
        raise LineError(f"{value!r} is not expected there.")

    def _slopes(self, by: str) -> Node:
        """∂P/∂q where the column of these slopes is a name of its own."""
        inner = self._operand()
        if isinstance(inner, Name) and (name := f"d{inner.name}d{by}") in self._names:
            return Name(name)
        raise LineError(f"There is no derivative by {by} here.")

    def _operand(self) -> Node:
        """What a function or a derivative acts on: brackets, a name, or another derivative."""
        self._depth += 1
        if self._depth > DEEPEST:
            raise LineError("The brackets of this line are nested too deep.")
        made = self._atom()
        self._depth -= 1
        return made
