"""Finds the cell that is to blame when a notebook does not define a function."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from autograder.judging.faults import NOT_RUN
from autograder.protocol import Fault, FaultKind, one_line

# A cell may hold any text; only this much of it, and of each line, is read.
MOST_LINES, MOST_CHARACTERS = 2000, 500
# Lines that may define a name without naming it.
MAY_DEFINE_ANY = re.compile(
    r"import \*|^\s*%(run|load|store)|_magic\(|\b(exec|globals|vars|setattr|from_file)\b"
)
IMPORT = re.compile(r"(from [\w. ]+ )?import\b")
SCOPE = re.compile(r"(async\s+)?(def|class)\b")
NO_NAME = re.compile(r"NameError: name '(\w+)' is not defined")
CALL = re.compile(r"[\w\])] ?\(")
ASSIGNS = re.compile(r"(?<![=!<>:+\-*/%@&|^~])=(?!=)")


@dataclass(frozen=True)
class Ran:
    """A cell that ran: its source and, if there was an error, its message.

    stopped: whether the error stopped the cell, at line `at`; `at` is 0 if no line of the cell ran, as
    after a syntax error. line: the student's own line that raised the error, with its number.
    left_out: a sentence for each line that could not work.
    """

    source: str
    error: str = ""
    stopped: bool = False
    at: int = 0
    line: str = ""
    left_out: tuple[str, ...] = ()


def ran(source: str, shown: list[dict]) -> Ran:
    """A cell that ran, from the outputs that the sandbox sent, whatever they hold."""
    left_out = tuple(
        one_line(output["left_out"]) for output in shown if isinstance(output.get("left_out"), str)
    )
    errors = [output for output in shown if output.get("output_type") == "error"]
    if not errors:
        return Ran(source, left_out=left_out)
    last = errors[-1]
    at, line = last.get("at"), last.get("line")
    return Ran(
        source,
        one_line(f"{last.get('ename')}: {last.get('evalue')}"),
        bool(last.get("stopped")),
        at if isinstance(at, int) else 0,
        one_line(line) if isinstance(line, str) else "",
        left_out,
    )


def explained(name: str, fault: Fault, cells: list[Ran]) -> Fault:
    """The fault of a call of `name`, or that of the cell that should have defined it."""
    if fault.kind is not FaultKind.MISSING:
        return stale(name, cells) or _with_cell_of_name(fault, cells)
    failed = [cell for cell in _defining(name, cells) if cell.error]
    if not failed and not fault.message:
        failed = [cell for cell in cells if cell.error and _may_define_any(cell.source)]
    if failed:
        return Fault(FaultKind.CELL_FAILED, failed[-1].error, failed[-1].line)
    left_out = [text for cell in cells for text in cell.left_out]
    return replace(fault, line=left_out[-1]) if left_out and not fault.message else fault


def _with_cell_of_name(fault: Fault, cells: list[Ran]) -> Fault:
    """The fault; if it is a name that is not there, with why the cell that defines it stopped."""
    missing = NO_NAME.match(fault.message) if fault.kind is FaultKind.RAISED else None
    failed = [cell for cell in _defining(missing[1], cells) if cell.error] if missing else []
    if not failed:
        return fault
    error = failed[-1].error
    how = f"was {error[error.index(NOT_RUN) :]}" if NOT_RUN in error else f"stopped with {error}"
    why = f"{fault.message}; the cell that defines it {how}"
    return replace(fault, message=one_line(why, 2 * MOST_CHARACTERS))


def stale(name: str, cells: list[Ran]) -> Fault | None:
    """The fault if `name` is an earlier one, as the last cell that defines it stopped before it did."""
    defining = _defining(name, cells)
    if not defining or not _stopped_before(name, defining[-1]):
        return None
    last = defining[-1]
    return Fault(FaultKind.STALE, last.error, last.line)


def _defining(name: str, cells: list[Ran]) -> list[Ran]:
    return [cell for cell in cells if next(_lines_that_define(name, cell.source), 0)]


def _stopped_before(name, cell: Ran) -> bool:
    return cell.stopped and cell.at <= min(_lines_that_define(name, cell.source))


def _may_define_any(source):
    return any(MAY_DEFINE_ANY.search(line) for line in source.split("\n")[:MOST_LINES])


def _lines_that_define(name: str, source: str) -> Iterator[int]:
    """The lines of a cell that define `name`; the cell as a whole may be invalid Python."""
    word = re.escape(name)
    named, defined = (
        re.compile(rf"\b{word}\b"),
        re.compile(rf"\b(def|class|as) +{word}\b|\b{word} *:="),
    )
    scopes: list[int] = []  # the indentation of each function and class that a line is in
    importing = False
    for number, line in enumerate(source.split("\n")[:MOST_LINES], 1):
        code = line[:MOST_CHARACTERS].partition("#")[0]
        statement = code.strip()
        if not statement:
            continue
        indent = len(code) - len(code.lstrip())
        while scopes and indent <= scopes[-1]:
            scopes.pop()
        begins = bool(IMPORT.match(statement))
        importing = importing or begins
        if named.search(code) and (
            statement.startswith("global ")
            or (not scopes and (importing or defined.search(code) or name in _targets(code)))
        ):
            yield number
        # An import goes on over several lines only in parentheses.
        importing = importing and ")" not in code and ("(" in code or not begins)
        if SCOPE.match(statement):
            scopes.append(indent)


def _targets(code):
    """The names that a line assigns to."""
    for statement in code.split(";"):
        *targets, _ = ASSIGNS.split(statement)
        for target in targets:
            if CALL.search(target):
                break
            yield from (part.partition(":")[0].strip(" \t()[]*") for part in target.split(","))
