"""Which other packages a module of the library may import, when it is imported or later.

A browser's Python cannot fetch a package in the middle of a call. So before a cell runs, all is fetched
that the modules it imports could ask for.
"""

import ast
from collections.abc import Mapping
from pathlib import PurePosixPath

OTHERS = ("matplotlib", "scipy", "sympy", "tqdm")


def of_library(files: Mapping[str, bytes]) -> dict[str, list[str]]:
    """By the module of `armdyn`: the names in OTHERS that it or a module it imports names.

    files: those of a package, by their paths.
    """
    imported = {
        _module(path): _imports(data.decode(), _module(path))
        for path, data in files.items()
        if path.startswith("armdyn/") and path.endswith(".py")
    }
    found = {}
    for module in imported:
        ahead, seen = [module], set()
        while ahead:
            name = ahead.pop()
            if name in seen:
                continue
            seen.add(name)
            ahead += [other for other in imported.get(name, ()) if other in imported]
        names = {name for other in seen for name in imported[other]}
        found[module] = sorted({name.partition(".")[0] for name in names}.intersection(OTHERS))
    return found


def _module(path: str) -> str:
    parts = PurePosixPath(path).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _imports(source: str, module: str) -> set[str]:
    """What a module imports, at its top or in a function; of `from a import b` both a and a.b."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module)
            found.update(f"{node.module}.{alias.name}" for alias in node.names)
    # `import a.b` runs a too, but armdyn's own __init__ would give each module the needs of all models.
    return found - {"armdyn", module}
