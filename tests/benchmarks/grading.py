"""A class graded by `autograder grade`, beside stock nbgrader, through to the gradebook.

    python -m tests.benchmarks.grading [--quick] [FILE]

Prints the section, and writes it to FILE if one is given. --quick: small classes, for a first look;
its figures are rough.
"""

import importlib
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import nbformat
from jupyter_client.manager import start_new_kernel

from tests.autograder.courses import ROOT
from tests.autograder.pipeline import classes
from tests.benchmarks import report
from tests.benchmarks.commands import Line, Spent, full_marks, run
from tests.benchmarks.timing import Row, table
from tests.submissions import start_here

OURS, STOCK = ("autograder", "grade"), ("nbgrader", "autograde")
JOBS = "2"
CLASS = 100  # what the goals are stated for
APART, INCLUDED, FLAT, AGAIN = 1 / 40, 1 / 20, 1.1, 10.0

HOW = """\
A class of {size} with {jobs} jobs, from the submitted notebooks to the gradebook: the wall-clock time of
`autograder grade` beside that of `nbgrader autograde` as nbgrader comes, in one run, on the same
notebooks. In nbgrader's kernel the same checks run. Of five submissions two are right, one is partly
right, one wrong and one blank; no two have the same code. Both sides must give full marks to the same
cells. {machine}.

"Start-up apart" is the slope between two sizes of class, {ours} for ours and {stock} for nbgrader;
the rest of the time is start-up. "Start-up included" is the time of the whole command by the size of
the class; for nbgrader, its start-up and {size} times its slope. The small notebook is measured
{rounds} times, and the least counts; the others once, nbgrader's slope between {fewer} submissions.
"""


@dataclass(frozen=True)
class Sizes:
    """How many submissions are graded: by us, by nbgrader, and where it is one large class."""

    ours: tuple[int, int]
    stock: tuple[int, ...]
    large: int
    rounds: int


FULL = Sizes((20, CLASS), (5, 10, 20), 1000, 2)
FEWER = Sizes((20, CLASS), (4, 12), 0, 1)  # for the assignments that are not shown in full
QUICK = Sizes((5, 25), (1, 6), 100, 1)


@dataclass(frozen=True)
class Subject:
    """An assignment, and who hands it in. source: its folder or its notebook."""

    name: str
    shown: str
    source: Path | nbformat.NotebookNode
    submissions: object


def subjects() -> list[Subject]:
    small = Subject(
        start_here.ASSIGNMENT,
        "small notebook (three code cells, one check)",
        start_here.source(),
        start_here,
    )
    found = [small]
    for folder in sorted((ROOT / "solutions").iterdir()):
        module = f"tests.submissions.{folder.name.replace('-', '_')}"
        if folder.is_dir() and importlib.util.find_spec(module):
            found.append(Subject(folder.name, folder.name, folder, importlib.import_module(module)))
    return found


class Bench:
    """One assignment, released; classes of any size to be graded."""

    def __init__(self, subject: Subject, folder: Path):
        self._subject, self._folder = subject, folder
        self._released = classes.new_course(folder / "released", subject.name, subject.source)

    def course(self, size: int, command: tuple[str, ...]) -> Path:
        root = self._folder / f"{command[0]}-{size}"
        if root.exists():
            shutil.rmtree(root)
        shutil.copytree(self._released, root)
        classes.hand_in(root, self._subject.name, self._subject.submissions, size)
        if command == STOCK:
            config = root / "nbgrader_config.py"
            kept = [line for line in config.read_text().splitlines() if "nbgrader_glue" not in line]
            config.write_text("\n".join(kept) + "\n")
        return root

    def grade(self, root: Path, command: tuple[str, ...]) -> Spent:
        jobs = ("--jobs", JOBS) if command == OURS else ()
        return run(root, *command, self._subject.name, *jobs)

    def lines(self, sizes: Sizes) -> tuple[Line, Line]:
        """Ours and nbgrader's cost, taken in turn; their verdicts are compared."""
        runs: dict[tuple, Spent] = {}
        for command in (OURS, STOCK):
            self.grade(self.course(1, command), command)  # what is read for the first time
        for _ in range(sizes.rounds):
            for command, counts in ((OURS, sizes.ours), (STOCK, sizes.stock)):
                for size in counts:
                    spent = self.grade(self.course(size, command), command)
                    runs[command, size] = spent.least(runs.get((command, size), spent))
        self._agree(max(sizes.ours), max(sizes.stock))
        return tuple(
            Line({size: runs[command, size] for size in counts})
            for command, counts in ((OURS, sizes.ours), (STOCK, sizes.stock))
        )

    def _agree(self, ours: int, stock: int) -> None:
        found, expected = (
            full_marks(self._folder / f"{command[0]}-{size}")
            for command, size in ((OURS, ours), (STOCK, stock))
        )
        both = {student for student, _ in expected} & {student for student, _ in found}
        differ = {pair for pair in found ^ expected if pair[0] in both}
        if differ or not both:
            raise ValueError(f"the two must give full marks to the same cells: {sorted(differ)}")

    def large(self, size: int) -> tuple[Spent, Spent]:
        """A large class graded, and graded again though nothing has changed."""
        root = self.course(size, OURS)
        return self.grade(root, OURS), self.grade(root, OURS)

    def own_cells(self) -> float:
        """The time of the students' own cells, s a submission, in a kernel that has run them before."""
        root = self.course(len(classes.MIX), OURS)
        notebooks = [
            nbformat.read(path, as_version=4)
            for path in sorted(root.glob("course/submitted/*/*/*.ipynb"))
        ]
        manager, client = start_new_kernel(stderr=subprocess.DEVNULL)
        try:
            for _ in range(2):
                start = time.perf_counter()
                for notebook in notebooks:
                    for cell in notebook.cells:
                        claims = cell.metadata.get("nbgrader", {})
                        if cell.cell_type == "code" and not claims.get("grade"):
                            client.execute(cell.source, reply=True, timeout=60)
                spent = time.perf_counter() - start
        finally:
            client.stop_channels()
            manager.shutdown_kernel(now=True)
        return spent / len(notebooks)


def measured(subject: Subject, sizes: Sizes, is_first: bool) -> tuple[list[Row], list[str]]:
    """The rows of an assignment, and what is to be said below the table."""
    with tempfile.TemporaryDirectory(prefix="benchmark-") as folder:
        bench = Bench(subject, Path(folder))
        ours, stock = bench.lines(sizes)
        own = bench.own_cells()
        size, shown = max(sizes.ours), subject.shown
        rows = [
            Row(f"{shown}: start-up apart", ours.each, "nbgrader", stock.each, APART),
            Row(
                f"{shown}: start-up included",
                ours.at(size) / size,
                "nbgrader",
                stock.at(size) / size,
                INCLUDED,
            ),
        ]
        said = [
            f"{shown}: start-up {ours.start:.1f} s, nbgrader's {stock.start:.1f} s. The students' own "
            f"cells take {1000 * own:.0f} ms a submission in a warm kernel, which no grader can save: "
            f"{100 * own / int(JOBS) / ours.each:.0f} % of ours ({JOBS} jobs), "
            f"{100 * own / stock.each:.0f} % of nbgrader's."
        ]
        if is_first:
            costs = " and ".join(f"{cost:.2f} s" for cost in stock.steps())
            said[0] += f" nbgrader's cost between {sizes.stock} submissions: {costs} each."
            first, again = bench.large(sizes.large)
            each = (first.wall - ours.at(size)) / (sizes.large - size)
            what = f"{shown}, {sizes.large:,} submissions"
            rows += [
                Row(f"{what}: start-up apart", each, f"of {size}", ours.each, FLAT),
                Row(f"{what}, unchanged: work (CPU)", again.cpu, "goal", AGAIN, 1.0),
                Row(f"{what}, unchanged: wall clock", again.wall, "goal", AGAIN, 1.0),
            ]
    return rows, said


def main(arguments: list[str]) -> None:
    quick = "--quick" in arguments
    sizes = QUICK if quick else FULL
    rows, said = [], []
    for subject in subjects():
        is_shown_in_full = subject.name == start_here.ASSIGNMENT
        fewer = sizes if quick or is_shown_in_full else FEWER
        more = measured(subject, fewer, is_shown_in_full)
        rows += more[0]
        said += more[1]
        print(table(more[0]), *more[1], sep="\n", flush=True)
    how = HOW.format(
        size=max(sizes.ours),
        jobs=JOBS,
        machine=report.machine(),
        ours=" and ".join(map(str, sizes.ours)),
        stock=" and ".join((str(sizes.stock[0]), str(sizes.stock[-1]))),
        rounds=sizes.rounds,
        fewer=" and ".join(map(str, FEWER.stock)),
    )
    text = f"{how}\n{table(rows)}\n" + "".join(f"- {line}\n" for line in said)
    print(text)
    for file in arguments:
        if file != "--quick":
            report.put(Path(file), "Grading", text, measured=("ours", "ratio"))


if __name__ == "__main__":
    main(sys.argv[1:])
