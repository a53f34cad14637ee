"""Change one sign of a lesson at a time, and list the changes that no assert notices.

    python tests/notebooks/change_signs.py lessons/03-inertia-matrix.ipynb

A plus becomes a minus, a minus a plus, a leading minus goes, sin becomes cos and cos sin. An assert
that could not fail is no assert: what is listed is either drawing, or a change that is no mistake (a
power or a square hides it), or a claim that no cell holds. Takes minutes; not part of `make test`.
"""

import ast
import contextlib
import copy
import os
import resource
import sys
from collections.abc import Iterator
from pathlib import Path

import nbformat

SECONDS = 120  # of a processor: on a busy machine the clock would end what only waits
SWAPPED = {"sin": "cos", "cos": "sin"}


def changes(source: str) -> Iterator[tuple[int, str, ast.Module]]:
    """Each change of a cell: its line, the words that stand there, and the changed cell."""
    tree = ast.parse(source)
    for place, node in enumerate(ast.walk(tree)):
        if _changed(copy.deepcopy(node)) is not None:
            changed = copy.deepcopy(tree)
            twin = next(n for i, n in enumerate(ast.walk(changed)) if i == place)
            new = _changed(twin)
            if new is not twin:
                changed = _Replace(twin, new).visit(changed)
            yield (
                node.lineno,
                ast.get_source_segment(source, node),
                ast.fix_missing_locations(changed),
            )


def _changed(node: ast.AST) -> ast.AST | None:
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


class _Replace(ast.NodeTransformer):
    def __init__(self, old, new):
        self.old, self.new = old, new

    def visit(self, node):
        return self.new if node is self.old else super().visit(node)


def survivors(path: Path) -> Iterator[tuple[str, int, str]]:
    """Cell, line and words of each change after which the whole notebook still runs.

    Raises what the unchanged notebook raises.
    """
    cells = [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]
    os.chdir(path.parent)
    namespace = {"__name__": "__main__"}
    for place, cell in enumerate(cells):
        for line, words, changed in changes(cell.source):
            if not _noticed(namespace, changed, [later.source for later in cells[place + 1 :]]):
                yield cell.id, line, words
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


def main(paths: list[str]) -> None:
    for path in map(Path, paths):
        here = Path.cwd()
        for cell, line, words in survivors(path.resolve()):
            print(f"{path.stem}: {cell}, line {line}: {' '.join(words.split())}", flush=True)
        os.chdir(here)


if __name__ == "__main__":
    main(sys.argv[1:])
