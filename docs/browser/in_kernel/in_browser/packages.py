"""Fetches what a cell will need before it runs: nothing can be fetched in the middle of a call."""

import ast
import json
from pathlib import Path

NEEDS = json.loads((Path(__file__).parent / "needs.json").read_text(encoding="utf-8"))


def mend() -> None:
    """Let the kernel fetch what `armdyn` may import later, besides what the cell imports itself."""
    from pyodide_kernel import kernel

    of_cell = kernel._load_packages_from_imports

    async def of_cell_and_library(code: str) -> None:
        await of_cell(code)
        if others := needed(code):
            await of_cell("\n".join(f"import {name}" for name in others))

    kernel._load_packages_from_imports = of_cell_and_library


def needed(code: str) -> list[str]:
    """The packages that the modules of `armdyn` need which a cell imports."""
    try:
        tree = ast.parse(code)
    except SyntaxError:
        return []
    modules: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            modules.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            modules.add(node.module)
            modules.update(f"{node.module}.{alias.name}" for alias in node.names)
    return sorted({name for module in modules for name in NEEDS.get(module, ())})
