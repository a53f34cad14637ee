"""What works in this kernel and will not when the notebook is graded; each check tells it.

The grader runs the notebook in a sandbox: without armdyn, with the files that were handed in and no
others, and with limits on processor time. Validate runs it in a kernel, as JupyterLab does.
"""

import ast
import json
import re
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from autograder.problems.start_here import checks as start_here
from autograder.student.progress import MOST_BYTES

# The sandbox's own limits, in s of processor time; a test compares them. The second holds for the
# cells of a problem, and again for a student's own: a kernel does not know which are which.
CELL_SECONDS, CELLS_SECONDS = 10.0, 60.0
# Modules that the grader has, wherever they lie here.
KNOWN = ("armdyn", "autograder")
INSTALLED = ("site-packages", "dist-packages", "lib-dynload")
CALL = re.compile(r"""^check\(\s*["']([\w-]+)["']""", re.MULTILINE)


@dataclass(frozen=True)
class Told:
    """A sentence to the student. costs: whether Validate has to fail, as points would be lost, or as it
    looks at less than the grader.
    """

    said: str
    costs: bool = True


class Cells:
    """Watches an IPython shell: what each cell holds that ran, and how long it took, s.

    The cells that ran before are there without a time.
    """

    def __init__(self, shell):
        self._transform = shell.transform_cell
        self._sources = dict(enumerate(shell.user_ns.get("In", ())))
        self._seconds: dict[object, float] = {}
        self._started = time.process_time()
        shell.events.register("pre_run_cell", self._starts)
        shell.events.register("post_run_cell", self._ended)

    def told(self) -> list[Told]:
        """What will be different in the grader for these cells."""
        imports = {name for source in self._sources.values() for name in self._imports(source)}
        found = [Told(_ARMDYN)] if "armdyn" in imports else []
        found += [one for name in sorted(imports) for one in _of_module(name)]
        return [*found, *_of_times([*self._seconds.values()])]

    def _starts(self, info) -> None:
        self._started = time.process_time()

    def _ended(self, result) -> None:
        info = result.info
        key = getattr(info, "cell_id", None) or info.raw_cell  # a cell that runs again counts once
        self._sources[key] = info.raw_cell or ""
        self._seconds[key] = time.process_time() - self._started

    def _imports(self, source: str) -> frozenset[str]:
        if "import" not in source:
            return frozenset()
        try:
            return _imported(self._transform(source))
        except Exception:  # no Python, whatever a student typed
            return frozenset()


def told(id: str, cells: Cells | None) -> list[Told]:
    """What will be different in the grader for the notebook with this check; nothing for a lesson."""
    if id in {check.id for check in start_here.CHECKS}:
        return []
    return [*(cells.told() if cells else []), *of_file(id, Path.cwd())]


def watched() -> Cells | None:
    """Watch the shell that this Python runs, from now on; None outside IPython."""
    if "IPython" not in sys.modules:
        return None
    shell = sys.modules["IPython"].get_ipython()
    return None if shell is None else Cells(shell)


def of_file(id: str, folder: Path) -> list[Told]:
    """What the saved notebook with this check has lost; it is looked for in the folder."""
    for path in sorted(folder.glob("*.ipynb")):
        lost = list(_without_settings(path, id))
        if lost:
            cells, have = ("cells", "have") if len(lost) > 1 else ("cell", "has")
            return [
                Told(
                    f"In {path.name}, the {cells} of {', '.join(lost)} {have} lost nbgrader's settings, "
                    "as happens in other editors, and Validate looks at no such cell. Put your answers "
                    "into the notebook as it was handed out."
                )
            ]
    return []


_ARMDYN = (
    "A cell of this notebook imports armdyn. The grader has none, as it holds the answers: there the "
    "cell stops at this line. Use NumPy and SymPy."
)


@lru_cache(maxsize=256)
def _imported(source: str) -> frozenset[str]:
    """The first names of the modules that a cell imports."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {own.name.partition(".")[0] for own in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.add(node.module.partition(".")[0])
    return frozenset(names)


def _of_module(name: str) -> Iterator[Told]:
    file = getattr(sys.modules.get(name), "__file__", None)
    if not isinstance(file, str) or name in KNOWN:
        return
    path, here = Path(file).resolve(), Path.cwd().resolve()
    own = f"{name}.py" if path.name != "__init__.py" else f"the folder {name}"
    if path.is_relative_to(here) and not set(INSTALLED) & set(path.parts):
        yield Told(
            f"This notebook needs {own} beside it. nbgrader's Submit hands it in, too; where you upload "
            f"the notebook yourself, upload {own} as well.",
            costs=False,
        )
    elif not (set(INSTALLED) & set(path.parts) or _is_of_python(path)):
        yield Told(
            f"This notebook imports {name} from {path.parent}, where the grader does not find it. Put "
            f"{own} beside the notebook, and hand in both."
        )


def _is_of_python(path: Path) -> bool:
    homes = {Path(json.__file__).resolve().parents[1], Path(sys.base_prefix).resolve()}
    return any(path.is_relative_to(home) for home in homes)


def _of_times(seconds: list[float]) -> list[Told]:
    longest, whole = max(seconds, default=0.0), sum(seconds)
    if longest > CELL_SECONDS:
        return [
            Told(
                f"A cell of this notebook took {longest:.0f} s of processor time; the grader stops a "
                f"cell after {CELL_SECONDS:.0f} s."
            )
        ]
    if whole > CELLS_SECONDS:
        return [
            Told(
                f"The cells of this notebook took {whole:.0f} s of processor time; the grader gives "
                f"{CELLS_SECONDS:.0f} s to the problem's cells, and {CELLS_SECONDS:.0f} s to your own.",
                costs=whole > 2 * CELLS_SECONDS,
            )
        ]
    return []


def _without_settings(path: Path, id: str) -> Iterator[str]:
    """The checks that a problem's notebook calls in cells without their settings; none, if it does not
    call this one.
    """
    try:
        if path.stat().st_size > MOST_BYTES:
            return
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        calls: dict[str, bool] = {}
        for cell in cells:
            if cell["cell_type"] == "code" and (call := CALL.search("".join(cell["source"]))):
                settings = cell["metadata"].get("nbgrader") or {}
                has = settings.get("grade_id") == call[1]
                calls[call[1]] = calls.get(call[1], False) or has
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return
    # One call may be a student's own, in a notebook to try things in.
    if id in calls and len(calls) > 1:
        yield from (name for name, has in calls.items() if not has)
