"""Takes from modules what is needed, and leaves the rest: the references, the mistakes, the answers.

Only whole statements of a module are taken: a function, a class, a constant, an import. What a statement
names is needed too, wherever it stands. It is written down as it stands there, but for its comments:
`ast.unparse` may write what only new Pythons read, such as an f-string with one kind of quotes.
"""

import ast
import builtins
import dis
import importlib.util
import io
import tokenize
from collections.abc import Callable
from importlib.abc import InspectLoader
from pathlib import Path
from types import CodeType


class ShakingError(ValueError):
    """What is needed leads to a module that a student's package may not have, or that an older Python of
    a student cannot read.
    """


class Shaking:
    """may_take(module): whether it is taken in parts. has(module): whether the package has all of it."""

    def __init__(self, may_take: Callable[[str], bool], has: Callable[[str], bool]):
        self._may_take, self._has = may_take, has
        self._taken: dict[str, set[int]] = {}  # by the module: the places of its statements
        self._loaded: dict[str, set[str]] = {}  # by the module: the names that what is taken uses
        self._sources: dict[str, str] = {}
        self._trees: dict[str, ast.Module] = {}

    @property
    def modules(self) -> list[str]:
        return sorted(self._taken)

    def need(self, module: str, name: str) -> None:
        """Take what defines this name, and all that it needs."""
        if self._has(module) or not module.startswith("autograder"):
            return
        if not self._may_take(module):
            raise ShakingError(f"{module}, of which {name} is needed, holds answers")
        taken = self._taken.setdefault(module, set())
        tree = self._tree(module)
        for place, statement in enumerate(tree.body):
            if place not in taken and name in _binds(statement):
                taken.add(place)
                self._follow(module, statement)

    def need_source(self, module: str, source: str) -> None:
        """Take what some more source of a module needs."""
        self._taken.setdefault(module, set())
        for statement in ast.parse(source).body:
            self._follow(module, statement)

    def source(self, module: str) -> str:
        """The module with only what is needed."""
        tree, taken = self._tree(module), self._taken[module]
        names = self._loaded.get(module, set())
        kept: list[str] = []
        for place, statement in enumerate(tree.body):
            if isinstance(statement, ast.Import | ast.ImportFrom):
                only = _only(statement, names)
                kept += [ast.unparse(only)] if only.names else []
            elif place in taken:
                kept.append(lines_of(self._sources[module], statement))
        return "\n".join(kept)

    def _follow(self, module: str, statement: ast.stmt) -> None:
        self._loaded.setdefault(module, set()).update(_loads(statement))
        imported = self._imports(module)
        attributes = _attributes(statement)
        for name in _loads(statement):
            if name not in imported:
                if name not in vars(builtins):
                    self.need(module, name)
                continue
            of, what = imported[name]
            if what and _is_module(f"{of}.{what}"):
                for attribute in attributes.get(name, ()):
                    self.need(f"{of}.{what}", attribute)
                if self._may_take(f"{of}.{what}"):
                    self._taken.setdefault(f"{of}.{what}", set())
            elif what:
                self.need(of, what)

    def _imports(self, module: str) -> dict[str, tuple[str, str]]:
        """By the name that a module gives it: the module, and what of it, "" for the module itself."""
        found = {}
        for statement in self._tree(module).body:
            if isinstance(statement, ast.ImportFrom) and statement.module:
                for alias in statement.names:
                    found[alias.asname or alias.name] = (statement.module, alias.name)
            elif isinstance(statement, ast.Import):
                for alias in statement.names:
                    found[alias.asname or alias.name.partition(".")[0]] = (alias.name, "")
        return found

    def _tree(self, module: str) -> ast.Module:
        if module not in self._trees:
            self._sources[module] = source_of(module)
            self._trees[module] = ast.parse(self._sources[module])
        return self._trees[module]


def path_of(module: str) -> Path:
    """The file of a module; ModuleNotFoundError where there is none."""
    spec = importlib.util.find_spec(module)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(module)
    return Path(spec.origin)


def source_of(module: str) -> str:
    """The text of a module, also of one that is made of a course's own file; ModuleNotFoundError where
    there is none.
    """
    spec = importlib.util.find_spec(module)
    loader = spec.loader if spec else None
    source = loader.get_source(module) if isinstance(loader, InspectLoader) else None
    if source is None:
        raise ModuleNotFoundError(module)
    return source


def lines_of(source: str, statement: ast.stmt) -> str:
    """The lines of a statement, with its decorators and without comments."""
    decorators = getattr(statement, "decorator_list", [])
    first = min(node.lineno for node in [statement, *decorators])
    lines = source.split("\n")[first - 1 : statement.end_lineno]
    return without_comments("\n".join(lines))


def without_comments(source: str) -> str:
    """Whole statements of Python."""
    lines = source.split("\n")
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            line, column = token.start
            lines[line - 1] = lines[line - 1][:column].rstrip()
    return "\n".join(lines)


def _is_module(name: str) -> bool:
    if not name.startswith("autograder"):
        return False
    try:
        return importlib.util.find_spec(name) is not None
    except ModuleNotFoundError:  # what it would be in is a module itself
        return False


def _binds(statement: ast.stmt) -> set[str]:
    """The names that a statement defines."""
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        return {statement.name}
    if isinstance(statement, ast.Assign | ast.AnnAssign | ast.AugAssign):
        return {
            node.id
            for node in ast.walk(statement)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
    return set()


def _loads(statement: ast.stmt) -> set[str]:
    """The names of the module that a statement uses; a local variable of the same name is none."""
    found: set[str] = set()
    codes = [compile(ast.Module([statement], []), "", "exec", dont_inherit=True)]
    while codes:
        code = codes.pop()
        codes += [inner for inner in code.co_consts if isinstance(inner, CodeType)]
        found.update(
            instruction.argval
            for instruction in dis.get_instructions(code)
            if instruction.opname in ("LOAD_GLOBAL", "LOAD_NAME")
        )
    return found


def _attributes(statement: ast.stmt) -> dict[str, set[str]]:
    """By a name: what is asked of it, as `planar_2r.joints` asks for joints."""
    found: dict[str, set[str]] = {}
    for node in ast.walk(statement):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found.setdefault(node.value.id, set()).add(node.attr)
    return found


def _only(statement: ast.Import | ast.ImportFrom, names: set[str]) -> ast.Import | ast.ImportFrom:
    kept = [a for a in statement.names if (a.asname or a.name.partition(".")[0]) in names]
    if isinstance(statement, ast.ImportFrom):
        return ast.ImportFrom(statement.module, kept, statement.level)
    return ast.Import(kept)
