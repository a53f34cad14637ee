"""What formulas are worth in numbers: those in a text's LaTeX, and those that Python code types.

A formula's letters are given numbers; abbreviations (`h = ...`, `\\underbrace{...}_A`) get theirs from
where they stand. What is no sum of products of letters, sines and cosines has no number.

The parser of `autograder.proofs` cannot take the LaTeX's place: it reads one line of a student in known
names and refuses the rest with a sentence. A lesson's formula has entries of matrices, alignments,
braces, `\\dot q_1` and definitions of its own, and what of it has no number is passed over.
"""

import ast
import itertools
import math
import re
from collections.abc import Iterator

Numbers = dict[str, float]
# A formula's number and those of the terms of its sum, each with its sign.
Worth = tuple[float, ...]

FUNCTIONS = {"sin": math.sin, "cos": math.cos}
STATES = {"q", "qd", "qdd"}
LETTERS = {"ell_": "l", "ell": "l", "qddot": "qdd", "qdot": "qd"}


def known_as(name: str) -> str:
    """The name that a letter has among the numbers, as `lc1` for `ell_c1`."""
    for own, ours in LETTERS.items():
        name = name.replace(own, ours)
    return name


MATH = re.compile(r"\$\$(.+?)\$\$|\$([^$]+)\$", re.DOTALL)
SPACE = re.compile(
    r"\\(?:begin|end)\{\w+\}(?:\{\w+\})?|\\(?:left|right|[bB]ig+[lrm]?|displaystyle|boxed|underbrace)(?![a-z])"
    r"|\[\d+pt\]|\s+"
)
SINGLE = re.compile(r"\\?[A-Za-z]+(_\w|_\{\w+\})?")
THIN = re.compile(r"(?<!\\)\\[,;:! ]")
APART = re.compile(r"=|&|\\\\|,|;|\\q?quad|\\text\{[^{}]*\}|\\(?:Rightarrow|approx|ge|le|to)\b")
BRACE = re.compile(
    r"\\underbrace\{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}_\{?(?:\\)?([A-Za-z]+)\}?"
)
LABEL = re.compile(r"(?<=\})_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\w)")
TOKEN = re.compile(
    r"(?P<half>\\[td]?frac(?P<up>\d)(?P<down>\d)|\\[td]?frac\{(?P<over>\d+)\}\{(?P<under>\d+)\})"
    r"|(?P<number>\d+(?:\.\d+)?)"
    r"|\\(?P<function>sin|cos)(?![a-z])"
    r"|(?:\\(?P<dots>d?dot)\s*)?\{?(?P<letter>\\(?:ell|alpha|beta|gamma|varphi)|[A-Za-z])\}?"
    r"(?:_(?:\{(?P<long>\w+)\}|(?P<short>\w)))?"
    r"|(?P<sign>\\cdot|[-+*/^(){}\[\]])"
)


class Reader:
    """Reads LaTeX, formula after formula; what one has defined, the next ones may use.

    numbers: the letters' numbers, as {"lc1": 0.4, "qd1": 2.0}.
    """

    def __init__(self, numbers: Numbers):
        self.numbers = numbers | {"q12": numbers["q1"] + numbers["q2"]}
        self.own: Numbers = {}

    def worths(self, text: str) -> Iterator[Worth]:
        """Each formula in the text that has a number: the sides of equations, entries of matrices."""
        for display, inline in MATH.findall(text):
            formula = THIN.sub(" ", display or inline)
            for content, label in BRACE.findall(formula):
                self._define(label, self._worth(content))
            # A definition may stand behind what uses it.
            for again in (False, True):
                sides = APART.split(LABEL.sub("", formula))
                found = [self._worth(side) for side in sides]
                for name, side, worth in zip(sides, sides[1:], found[1:], strict=False):
                    if "begin" not in side:
                        self._define(re.sub(r"[{}\\_]", "", SPACE.sub("", name)), worth)
                if again:
                    composed = (not SINGLE.fullmatch(SPACE.sub("", side)) for side in sides)
                    yield from filter(None, itertools.compress(found, composed))

    def _define(self, name: str, worth: Worth | None) -> None:
        if worth and re.fullmatch(r"[A-Za-z]+\d*", name) and known_as(name) not in self.numbers:
            self.own[name] = worth[0]

    def _worth(self, formula: str) -> Worth | None:
        formula = SPACE.sub(" ", formula).strip(" .")
        tokens, place = [], 0
        while place < len(formula):
            found = TOKEN.match(formula, place)
            if found:
                tokens.append(found)
                place = found.end()
            elif formula[place] == " ":
                place += 1
            else:
                return None
        signs = [token["sign"] for token in tokens]
        # A vector's brackets, which its commas have cut in two.
        if signs.count("(") > signs.count(")") and signs[0] == "(":
            tokens = tokens[1:]
        elif signs.count("(") < signs.count(")") and signs[-1] == ")":
            tokens = tokens[:-1]
        try:
            terms = self._sum(tokens)
        except (IndexError, LookupError, ArithmeticError, ValueError):
            return None
        return (sum(terms), *terms) if terms and not tokens else None

    def _sum(self, tokens: list) -> list[float]:
        """Reads a sum from the front of the tokens: its terms."""
        terms = []
        while tokens and tokens[0]["sign"] not in (")", "}", "]"):
            sign = 1.0
            while tokens[0]["sign"] in ("+", "-"):
                sign = -sign if tokens.pop(0)["sign"] == "-" else sign
            terms.append(sign * self._product(tokens))
        return terms

    def _product(self, tokens: list) -> float:
        product = self._power(tokens)
        while tokens and tokens[0]["sign"] not in ("+", "-", ")", "}", "]"):
            by = tokens[0]["sign"]
            if by in ("\\cdot", "*", "/"):
                tokens.pop(0)
            factor = self._power(tokens)
            product = product / factor if by == "/" else product * factor
        return product

    def _power(self, tokens: list) -> float:
        base = self._atom(tokens)
        while tokens and tokens[0]["sign"] == "^":
            tokens.pop(0)
            base **= self._atom(tokens)
        return base

    def _atom(self, tokens: list) -> float:
        token = tokens.pop(0)
        if token["sign"] in ("(", "{", "["):
            value = sum(self._sum(tokens))
            tokens.pop(0)
            return value
        if token["half"]:
            return int(token["up"] or token["over"]) / int(token["down"] or token["under"])
        if token["number"]:
            return float(token["number"])
        if token["function"]:
            power = 1.0
            if tokens[0]["sign"] == "^":
                tokens.pop(0)
                power = self._atom(tokens)
            return FUNCTIONS[token["function"]](self._atom(tokens)) ** power
        if not token["letter"]:
            raise LookupError(token[0])
        name = token["letter"].strip("\\") + (token["long"] or token["short"] or "")
        if token["dots"]:
            dots = "d" * token["dots"].count("d")
            name = name[0] + dots + name[1:]
        name = known_as(name)
        return self.own[name] if name in self.own else self.numbers[name]


class CodeReader:
    """Reads the code of a notebook, cell after cell; what one assigns, the next ones may use.

    numbers: those of names such as `lc1`; `arm.lc1` and `q[..., 0]` have them, too.
    """

    def __init__(self, numbers: Numbers):
        self.numbers = numbers
        self.own: dict[str, float | None] = {}

    def worths(self, source: str) -> Iterator[Worth]:
        """Each formula that the code types and that has a number."""
        lines = (line for line in source.splitlines() if not line.startswith(("%", "!")))
        for node in ast.walk(ast.parse("\n".join(lines))):
            for formula in _formulas(node):
                terms = [self._value(term, sign) for term, sign in _terms(formula)]
                if None not in terms:
                    numbers = [term for term in terms if term is not None]
                    yield (sum(numbers), *numbers)
            self._assign(node)

    def _assign(self, node: ast.AST) -> None:
        if isinstance(node, ast.Assign):
            for target in node.targets:
                self._bind(target, node.value)
        elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            sum_ = ast.BinOp(ast.Name(node.target.id), node.op, node.value)
            self._bind(node.target, sum_)

    def _bind(self, target: ast.expr, value: ast.expr) -> None:
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            for one, its in zip(target.elts, value.elts, strict=False):
                self._bind(one, its)
        elif isinstance(target, ast.Name) and target.id not in self.numbers:
            self.own[target.id] = self._value(value)

    def _value(self, node: ast.expr, sign: int = 1) -> float | None:
        try:
            return sign * self._number(node)
        except (LookupError, ArithmeticError, TypeError, ValueError):
            return None

    def _number(self, node: ast.expr) -> float:
        match node:
            case ast.Constant(value=int() | float() as value):
                return float(value)
            case ast.Name(id=name):
                value = self.own.get(name)
                return self.numbers[known_as(name)] if value is None else value
            case ast.Attribute(attr=name):
                return self.numbers[name]
            case ast.Subscript(value=ast.Name(id=name), slice=place) if name.lower() in STATES:
                last = place.elts[-1] if isinstance(place, ast.Tuple) else place
                return self.numbers[f"{name.lower()}{ast.literal_eval(last) + 1}"]
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                return -self._number(inner)
            case ast.BinOp(left=left, op=op, right=right):
                return _computed(op, self._number(left), self._number(right))
            case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=[inner]):
                return FUNCTIONS[name](self._number(inner))
        raise LookupError(ast.dump(node))


def _computed(op: ast.operator, left: float, right: float) -> float:
    match op:
        case ast.Add():
            return left + right
        case ast.Sub():
            return left - right
        case ast.Mult():
            return left * right
        case ast.Div():
            return left / right
        case ast.Pow():
            return left**right
    raise LookupError(op)


def _formulas(node: ast.AST) -> Iterator[ast.expr]:
    """The formulas that stand by themselves in a node: what is assigned, returned, listed, compared."""
    match node:
        case ast.Assign(value=value) | ast.AugAssign(value=value) | ast.Return(value=value):
            found = [value]
        case ast.List(elts=elts) | ast.Tuple(elts=elts):
            found = elts
        case ast.Call(args=args, keywords=keywords):
            found = [*args, *(keyword.value for keyword in keywords)]
        case ast.Compare(left=left, comparators=others):
            found = [left, *others]
        case ast.Dict(values=values):
            found = values
        case _:
            found = []
    yield from (one for one in found if isinstance(one, ast.BinOp | ast.UnaryOp))


def _terms(formula: ast.expr, sign: int = 1) -> Iterator[tuple[ast.expr, int]]:
    """The terms of a sum, each with its sign."""
    match formula:
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub() as op, right=right):
            yield from _terms(left, sign)
            yield from _terms(right, -sign if isinstance(op, ast.Sub) else sign)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            yield from _terms(inner, -sign)
        case _:
            yield formula, sign
