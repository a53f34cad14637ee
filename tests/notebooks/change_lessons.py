"""Make one small mistake in a lesson at a time, and list the mistakes that no assert notices.

    python tests/notebooks/change_lessons.py lessons/03-inertia-matrix.ipynb
    python tests/notebooks/change_lessons.py --only sign --only index lessons/*.ipynb

- sign: a plus becomes a minus, a minus a plus, a leading minus goes, sin becomes cos and cos sin;
- number: a number is doubled;
- bound: < becomes ≤, and ≤ becomes <, where the code decides by it;
- index: of two indices each takes the other's place, and 0 and 1 change places;
- statement: a statement is left out.

An assert that could not fail is no assert: what is listed is either drawing, or a change that is no
mistake (a power or a square hides it, a sample has twice as many points), or a claim that no cell holds.
Takes minutes for the signs, an hour for all; not part of `make test`.
"""

import argparse
import ast
import contextlib
import copy
import os
import resource
from collections.abc import Callable, Iterator
from pathlib import Path

import nbformat

from autograder import lesson_checks

SECONDS = 120  # of a processor: on a busy machine the clock would end what only waits
SWAPPED = {"sin": "cos", "cos": "sin"}
BOUNDS = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
DRAWING = {"plotting", "fig", "figure", "ax", "axes", "panels", "ipywidgets"}
TOLERANCES = {"atol", "rtol"}


def changes(source: str, kinds: tuple[str, ...]) -> Iterator[tuple[int, str, str, ast.Module]]:
    """Each change of a cell: its line, its kind, the words that stand there, and the changed cell."""
    tree = ast.parse(source)
    left_alone = {kind: {id(node) for node in _left_alone(tree, kind)} for kind in kinds}
    for place, node in enumerate(ast.walk(tree)):
        for kind in kinds:
            if id(node) in left_alone[kind] or KINDS[kind](copy.deepcopy(node)) is None:
                continue
            changed = copy.deepcopy(tree)
            twin = next(n for i, n in enumerate(ast.walk(changed)) if i == place)
            new = KINDS[kind](twin)
            if new is not twin:
                changed = _Replace(twin, new).visit(changed)
            words = ast.get_source_segment(source, node)
            yield node.lineno, kind, words, ast.fix_missing_locations(changed)


def _left_alone(tree: ast.AST, kind: str) -> Iterator[ast.AST]:
    """The nodes that are drawing or a tolerance, where a change of this kind is no mistake."""
    for node in ast.walk(tree) if kind != "sign" else ():
        inside_is_left = (
            (isinstance(node, ast.Expr | ast.Call) and _root(node) in DRAWING)
            or (isinstance(node, ast.keyword) and node.arg in TOLERANCES)
            or (isinstance(node, ast.Assert) and kind in ("bound", "statement"))
        )
        if inside_is_left:
            yield from ast.walk(node)
        elif isinstance(node, ast.Compare) and kind == "number":
            # Twice the bound that an assert compares with is a weaker assert, as a tolerance is.
            if any(type(op) in BOUNDS for op in node.ops):
                yield from (
                    n for n in (node.left, *node.comparators) if isinstance(n, ast.Constant)
                )
        elif isinstance(node, ast.Subscript) and kind == "number":
            yield from ast.walk(node.slice)  # another kind's


def _root(node: ast.AST) -> str:
    """The name that a call begins with: `ax` of `ax.plot(x)`."""
    while not isinstance(node, ast.Name):
        match node:
            case ast.Expr() | ast.Attribute() | ast.Subscript():
                node = node.value
            case ast.Call():
                node = node.func
            case _:
                return ""
    return node.id


def _sign(node: ast.AST) -> ast.AST | None:
    """The node with one sign changed, in place where it can be; None where it has none."""
    if isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, ast.Add | ast.Sub):
        node.op = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        # The -1 of a shape or an index is no sign.
        if isinstance(node.operand, ast.Constant) and node.operand.value == 1:
            return None
        return node.operand
    elif isinstance(node, ast.Attribute) and node.attr in SWAPPED:
        node.attr = SWAPPED[node.attr]
    elif isinstance(node, ast.Name) and node.id in SWAPPED and isinstance(node.ctx, ast.Load):
        node.id = SWAPPED[node.id]
    else:
        return None
    return node


def _number(node: ast.AST) -> ast.AST | None:
    if not isinstance(node, ast.Constant) or type(node.value) not in (int, float) or not node.value:
        return None
    return ast.Constant(2 * node.value)


def _bound(node: ast.AST) -> ast.AST | None:
    if not isinstance(node, ast.Compare) or type(node.ops[0]) not in BOUNDS:
        return None
    node.ops[0] = BOUNDS[type(node.ops[0])]()
    return node


def _index(node: ast.AST) -> ast.AST | None:
    if not isinstance(node, ast.Subscript):
        return None
    if isinstance(node.slice, ast.Tuple) and len(node.slice.elts) > 1:
        first, second, *rest = node.slice.elts
        if ast.dump(first) == ast.dump(second):
            return None
        node.slice.elts = [second, first, *rest]
    elif isinstance(node.slice, ast.Constant) and node.slice.value in (0, 1):
        node.slice = ast.Constant(1 - node.slice.value)
    else:
        return None
    return node


def _statement(node: ast.AST) -> ast.AST | None:
    kept = ast.Import | ast.ImportFrom | ast.FunctionDef | ast.ClassDef | ast.Pass
    if not isinstance(node, ast.stmt) or isinstance(node, kept):
        return None
    # Without the assert or the error in it nothing can be noticed.
    if any(isinstance(part, ast.Assert | ast.Raise) for part in ast.walk(node)):
        return None
    # What is printed or stands there to be shown is no claim, and a docstring does nothing.
    if isinstance(node, ast.Expr) and (
        not isinstance(node.value, ast.Call) or _root(node) == "print"
    ):
        return None
    return ast.Pass()


KINDS: dict[str, Callable[[ast.AST], ast.AST | None]] = {
    "sign": _sign,
    "number": _number,
    "bound": _bound,
    "index": _index,
    "statement": _statement,
}


class _Replace(ast.NodeTransformer):
    def __init__(self, old, new):
        self.old, self.new = old, new

    def visit(self, node):
        return self.new if node is self.old else super().visit(node)


def survivors(path: Path, kinds: tuple[str, ...]) -> Iterator[tuple[str, int, str, str]]:
    """Cell, line, kind and words of each change after which the whole notebook still runs.

    Raises what the unchanged notebook raises.
    """
    cells = [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]
    answered = lesson_checks.checks_of(path.name[:2])  # by the student: a card, and no claim
    os.chdir(path.parent)
    namespace = {"__name__": "__main__"}
    for place, cell in enumerate(cells):
        for line, kind, words, changed in changes(cell.source, kinds):
            if cell.id in answered:
                break
            if not _noticed(namespace, changed, [later.source for later in cells[place + 1 :]]):
                yield cell.id, line, kind, words
        with contextlib.redirect_stdout(None):
            exec(compile(cell.source, cell.id, "exec"), namespace)


def _noticed(namespace, changed, later) -> bool:
    """Whether the changed cell, or one after it, raises; tried in a fork of this process."""
    child = os.fork()
    if child == 0:
        raised = True
        # A change can make a loop endless: that is noticed, too.
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        try:
            exec(compile(changed, "changed", "exec"), namespace)
            for source in later:
                exec(compile(source, "later", "exec"), namespace)
            raised = False
        finally:
            os._exit(1 if raised else 0)
    return os.waitpid(child, 0)[1] != 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("lessons", nargs="+", type=Path)
    parser.add_argument("--only", action="append", choices=KINDS, help="one kind; may be repeated")
    given = parser.parse_args()
    kinds = tuple(given.only or KINDS)
    for path in given.lessons:
        here = Path.cwd()
        for cell, line, kind, words in survivors(path.resolve(), kinds):
            print(
                f"{path.stem}: {cell}, line {line}, {kind}: {' '.join(words.split())}", flush=True
            )
        os.chdir(here)


if __name__ == "__main__":
    main()
