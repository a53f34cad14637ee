r"""Sums over indices, as lessons write them, in matrices: `\sum_k h_{ijk}\,\dot q_k`, `\sum_k m_k p_k`.

The free indices of a matrix are i and j, in this order. Of ∂M_ij/∂q_k, the sum with q̇_k is Ṁ; of
∂M_ik/∂q_j it is W, whose column j is the slope of M q̇ along qj.
"""

import re

_M = r"\\partial\s*M_?\{?([ijk])([ijk])\}?"
_Q = r"\\partial\s*q_?\{?([ijk])\}?"
_SLOPE = re.compile(rf"\\[dt]?frac\s*\{{\s*{_M}\s*\}}\s*\{{\s*{_Q}\s*\}}|{_M}\s*/\s*{_Q}")
_SYMBOL = re.compile(r"(?<![A-Za-z\\])h_\{?([ijk])([ijk])([ijk])\}?(?:\s*\(\s*q\s*\))?")
_ENTRY = re.compile(r"(\\dot\s*M|(?<![A-Za-z\\])[MCN])_\{?(ij|ji)\}?")
_SUM = r"\\sum(?:_(?:\{\s*([a-z])[^{}]*\}|([a-z])))?(?:\^(?:\{[^{}]*\}|\w))?\s*"
_SUMS = re.compile(rf"(?:{_SUM})+")
_VELOCITY = re.compile(r"\s*\\dot\s*q_\{?([ijk])\}?")
_OF_P = re.compile(
    rf"\\sum_\{{?([ijk])\}}?\s*(?:\\dot\s*q_\1\s*)?"
    rf"(?:\\[dt]?frac\s*\{{\s*\\partial\s*P\s*\}}\s*\{{\s*{_Q}\s*\}}|\\partial\s*P\s*/\s*{_Q})"
    r"(?:\s*\\dot\s*q_\1)?"
)
# M_ij q̇_j, added up over j; or over both.
_ENTRIES = re.compile(
    r"((?:\\d?dot\s*)?[MC])_\{?([ijk])([ijk])\}?(?:\s*\(\s*q\s*\))?\s*"
    r"((?:\\d?dot\s*q_\{?[ijk]\}?\s*){1,2})$"
)
_SUBSCRIPT = r"_(?:\{{\s*(?:[a-z],)?{0}\s*\}}|{0})"
MOST_SUMS = 8
SLOPE = "⟨"  # ∂M_ij/∂q_k, until a sum takes it
UNREAD = "sum"  # what no parser knows: a sum whose indices do not fit is refused by this name


def without_indices(text: str) -> str:
    """The formula without sums and indices, where it has some that can be read; else as it is."""
    if "_" not in text and "\\sum" not in text:
        return text
    text = _OF_P.sub(_rate_of_P, text)
    text = _SLOPE.sub(lambda found: "⟨" + "".join(filter(None, found.groups())) + "⟩", text)
    text = _SYMBOL.sub(lambda found: _christoffel(*found.groups()), text)
    for _ in range(MOST_SUMS):
        found = _SUMS.search(text)
        if not found:
            break
        text = text[: found.start()] + _added_up(found[0], text[found.end() :])
    text = _ENTRY.sub(lambda found: found[1] + ("" if found[2] == "ij" else "'"), text)
    return text


def _christoffel(i: str, j: str, k: str) -> str:
    return f"(1/2) (⟨{i}{j}{k}⟩ + ⟨{i}{k}{j}⟩ - ⟨{j}{k}{i}⟩)"


def _added_up(sums: str, rest: str) -> str:
    """What stands for sums and what is behind them."""
    body, behind = _body(rest)
    over = re.findall(r"_\{?\s*([a-z])", sums)
    if (found := _ENTRIES.search(body.strip())) and (made := _of_entries(over, *found.groups())):
        return f" {body.strip()[: found.start()]} {made} {behind}"
    if "⟨" not in body:
        return _over_links(over, body) + behind
    velocities = sorted(_VELOCITY.findall(body))
    if velocities != sorted(over) or velocities not in (["k"], ["j", "k"], ["i", "j", "k"]):
        return f" {UNREAD} {body}{behind}"
    inside = _VELOCITY.sub("", body)
    matrix = re.sub(r"⟨(.)(.)(.)⟩", lambda found: _matrix(*found.groups()), inside)
    dressed = {1: "({})", 2: "({}) qd", 3: "qd' ({}) qd"}[len(velocities)]
    return f" {dressed.format(matrix)} {behind}"


def _rate_of_P(found: re.Match) -> str:
    """Σ ∂P/∂q_i q̇_i, with q̇_i on one side."""
    over, *by = filter(None, found.groups())
    has_one = len(re.findall(r"\\dot", found[0])) == 1
    return " qd' dPdq " if by == [over] and has_one else found[0]


def _of_entries(over: list[str], matrix: str, row: str, column: str, behind: str) -> str:
    """What the entries of a matrix, times rates, add up to; "" where the indices do not fit."""
    rates = {index: dots for dots, index in re.findall(r"\\(d?dot)\s*q_\{?([ijk])", behind)}
    if sorted(over) != sorted(rates) or len(rates) != behind.count("q_"):
        return ""
    last = rf"\{rates.get(column) or rates.get(row)} q"
    match row in rates, column in rates:
        case True, True if row != column:
            return rf"\{rates[row]} q' {matrix} {last}"
        case False, True:
            return f"{matrix} {last}"
        case True, False:
            return f"{matrix}' {last}"
    return ""


def _matrix(first: str, second: str, by: str) -> str:
    """What ∂M_{first second}/∂q_by becomes when it is multiplied by q̇_k and added up over k."""
    if by == "k":
        return r"\dot M" if first + second == "ij" else r"\dot M'"
    row = second if first == "k" else first
    return "W" if row + by == "ij" else "W'"


def _over_links(over: list[str], body: str) -> str:
    held = over or re.findall(r"_\{?(?:[a-z],)?([ik])", body)
    if not held or len(over) > 1 or not re.search(_SUBSCRIPT.format(held[0]), body):
        return f" {UNREAD} {body}"
    subscript = _SUBSCRIPT.format(held[0])
    both = (re.sub(subscript, f"_{link}", body).strip() for link in (1, 2))
    return f"({' + '.join(both)})"


def _body(rest: str) -> tuple[str, str]:
    """What is added up, to the next sign outside brackets, and what follows."""
    depth, begun = 0, False
    for at, sign in enumerate(rest):
        if sign in "([{":
            depth += 1
        elif sign in ")]}":
            depth -= 1
            if depth < 0:
                return rest[:at], rest[at:]
        elif sign in "+-=" and depth == 0 and begun:
            return rest[:at], rest[at:]
        begun = begun or not sign.isspace()
    return rest, ""
