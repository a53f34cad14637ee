"""One visible check of an answer that is wrong in a way no mistake explains: the slowest there is.

    python -m tests.benchmarks.checks [FILE]

Every mistake, every pair of them and every term is tried on it. The answers are the solutions' own,
each number a hundredth too large (a zero 0.01); so what the student's function costs is in the time.
"""

import os
import subprocess
import sys
import tempfile
import time
import types
from pathlib import Path
from unittest.mock import patch

import nbformat
import numpy as np
import sympy

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.claims import Claim
from autograder.judging.verdict import State
from autograder.mechanisms import MECHANISMS
from autograder.mutation.checks import check_of
from autograder.mutation.composed import catalogue_of, linear
from autograder.mutation.mistakes import mistakes_of
from autograder.problems import CHECKS
from autograder.protocol import Reply, answer_all
from autograder.student.cell import VISIBLE_SEED
from tests.benchmarks import report

ROOT = Path(__file__).parents[2]
GOAL = 0.2  # s
ROUNDS = 5

HOW = """\
One visible check in the notebook, of an answer that no known mistake explains (a right one, a hundredth
too large), so that every mistake, pair of mistakes and term is tried: the least CPU time of {rounds},
the student's function included. {machine}.

| check | time | goal | met |
|---|---|---|---|
"""


def namespaces() -> dict[str, dict]:
    """What each solution's set-up and answers define, by its folder."""
    found = {}
    for path in sorted((ROOT / "solutions").glob("*/*.ipynb")):
        namespace = types.ModuleType("__main__").__dict__
        for cell in nbformat.read(path, as_version=4).cells:
            name = cell.metadata.get("nbgrader", {}).get("grade_id", "")
            if cell.cell_type == "code" and (name.startswith("answer-") or name.endswith("-setup")):
                exec(compile(cell.source, f"{path.stem}/{name}", "exec"), namespace)
        found[path.parent.name] = namespace
    return found


def too_large(value):
    """The same result, each number a hundredth too large; a truth value is turned round."""
    match value:
        case bool() | np.bool_():
            return not value
        case dict():
            return {name: too_large(entry) for name, entry in value.items()}
        case types.SimpleNamespace():
            return types.SimpleNamespace(**too_large(vars(value)))
        case tuple() | list() if any(isinstance(entry, dict) for entry in value):
            return [too_large(entry) for entry in value]
        case tuple() | list():
            return too_large(np.asarray(value))
        case sympy.Basic() | sympy.MatrixBase():
            return value * sympy.Rational(101, 100)
        case int():
            return value + 1
    return 1.01 * value if np.any(value) else value + 0.01


def taken(check: Check, namespace: dict) -> float:
    """The least CPU time, s, of a visible check. ValueError where the answer passes all the same."""
    right = namespace[check.name]
    answers = namespace | {check.name: lambda *args: too_large(right(*args))}
    best = float("inf")
    for _ in range(ROUNDS):
        start = time.process_time()
        verdict = check.run(
            lambda calls: answer_all(calls, answers),
            np.random.default_rng(VISIBLE_SEED),
            VISIBLE_CASES,
        )
        best = min(best, time.process_time() - start)
    if verdict.state not in (State.INCORRECT, State.PARTLY_CORRECT):
        raise ValueError(f"{check.id} was to be judged wrong, and is: {verdict}")
    return best


MADE = """
A check that is made of a mechanism: how many mistakes it knows, deriving them (less where SymPy
remembers) and reading them from the cache (CPU, SymPy's import apart), and one visible check,
the judging alone. The goal is of an answer that no mistake explains, with up to 2,000 mistakes.

| check | mistakes | derived | read | right | a mistake | two mistakes | unexplained | goal |
|---|---|---|---|---|---|---|---|---|
"""
GENERATED = tuple((name, of) for name in ("planar-2r", "planar-3r") for of in ("M", "C", "f"))
MOST = 0.05  # s

FIRST = """
The first wrong answer in a process, importing what judges it included (CPU): where nothing of its check
is kept, and where all of it is, so that SymPy is not imported.

| check | nothing kept | kept |
|---|---|---|
"""
FIRST_OF = ("p1-M", "p2-C", "p3-g_vec", "p4-g_vec", "p5-f", "p5-energy_drift", "c6-regressor")
FRESH = """
import sys, time
import numpy as np
from autograder.problems import CHECKS
from autograder.protocol import Reply

check = CHECKS[sys.argv[1]]
right = check.reference

def ask(calls):
    return [Reply(value=np.asarray(1.01 * right(*c.args) + 0.001, dtype=float)) for c in calls]

start = time.process_time()
verdict = check.run(ask, np.random.default_rng(0))
assert verdict.problem == "", verdict.problem
print(time.process_time() - start)
"""


def first_answers() -> str:
    """The rows of first answers."""
    found = ""
    for id in FIRST_OF:
        with tempfile.TemporaryDirectory() as folder:
            cold, *kept = [fresh(id, folder) for _ in range(1 + ROUNDS)]
        found += f"| {id} | {cold:.2g} s | {min(kept):.2g} s |\n"
    return found


def fresh(id: str, folder: str) -> float:
    """The CPU time, s, of a first answer in a process of its own. folder: where entries are kept."""
    run = subprocess.run(
        [sys.executable, "-c", FRESH, id],
        env=os.environ | {"XDG_CACHE_HOME": folder},
        capture_output=True,
        text=True,
        check=True,
    )
    return float(run.stdout)


def judging(check: Check, answer) -> float:
    """The least CPU time, s, of a visible check, what the answer itself costs taken out."""
    best = float("inf")
    for _ in range(ROUNDS):
        asked = 0.0

        def ask(calls):
            nonlocal asked
            start = time.process_time()
            replies = [Reply(value=answer(*call.args)) for call in calls]
            asked += time.process_time() - start
            return replies

        start = time.process_time()
        check.run(ask, np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)
        best = min(best, time.process_time() - start - asked)
    return best


def generated() -> str:
    """The rows of checks that are made of a mechanism."""
    found = ""
    for name, answer in GENERATED:
        mechanism = MECHANISMS[name]
        with tempfile.TemporaryDirectory() as folder, patch.dict(os.environ, XDG_CACHE_HOME=folder):
            spent = []
            for _ in range(2):
                linear.cache_clear()
                start = time.process_time()
                catalogue_of.__wrapped__(mechanism, answer)
                spent.append(time.process_time() - start)
        check, known = check_of(mechanism, answer), mistakes_of(mechanism, answer)
        right = check.reference
        first, second = [m.wrong for m in known if m.combines and m.claim is not Claim.WHOLE][5:7]
        answers = (
            right,
            first,
            lambda *args, a=first, b=second, r=right: a(*args) + b(*args) - r(*args),
            lambda *args, r=right: 1.01 * r(*args) + 0.001 * np.sin(args[0][0]),
        )
        times = [f"{1e3 * judging(check, given):.0f} ms" for given in answers]
        found += f"| {name}-{answer} | {len(known)} | {spent[0]:.2g} s | {spent[1]:.2g} s | "
        found += f"{' | '.join(times)} | {1e3 * MOST:.0f} ms |\n"
    return found


def main(arguments: list[str]) -> None:
    text = HOW.format(rounds=ROUNDS, machine=report.machine())
    for folder, namespace in namespaces().items():
        problem = folder.partition("-")[0]
        for id, check in CHECKS.items():
            if id.startswith(f"{problem}-"):
                seconds = taken(check, namespace)
                met = "yes" if seconds <= GOAL else "no"
                text += f"| {id} | {1e3 * seconds:.0f} ms | {1e3 * GOAL:.0f} ms | {met} |\n"
    text += MADE + generated() + FIRST + first_answers()
    print(text)
    for file in arguments:
        report.put(Path(file), "Feedback", text, measured=("time",))


if __name__ == "__main__":
    main(sys.argv[1:])
