"""How far generated C is from the machine's own limits: bytes and operations beside the time.

The limits are measured in the same run, in one thread: a copy between two arrays too large for the
caches, and multiplications and additions in registers that wait for nothing.
"""

import ast
import ctypes
import re
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from armdyn.codegen import build, c_code, straight_line

COPIED = 64_000_000  # bytes, more than processors cache
CHAINS = 12  # enough independent ones to hide the latency of a multiplication and addition
FMA_LOOP = """
#if defined(__AVX512F__)
enum { LANES = 8 };
#elif defined(__AVX__)
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double vector __attribute__((vector_size(8 * LANES)));

int fma_loop(long rounds, double *out)
{
    const double a = 0.999999, b = 1e-9;
    vector x[CHAINS];
    for (int i = 0; i < CHAINS; i++)
        x[i] = (vector){1 + i} + out[0];
    for (long r = 0; r < rounds; r++)
        for (int i = 0; i < CHAINS; i++)
            x[i] = x[i] * a + b;
    for (int i = 0; i < CHAINS; i++)
        for (int j = 0; j < LANES; j++)
            out[0] += x[i][j];
    return 2 * LANES * CHAINS;
}
"""


@dataclass(frozen=True)
class Work:
    """What one state, or one step, takes: s, bytes from and to memory, operations."""

    what: str
    seconds: float
    bytes: float
    operations: int


def copied_bytes() -> float:
    """Bytes per second, read and written, of one thread's copy in memory."""
    source, target = np.ones(COPIED // 8), np.ones(COPIED // 8)
    return 2 * COPIED / _least(lambda: np.copyto(target, source))


def most_operations() -> float:
    """Operations per second of one thread: a multiplication and an addition are two."""
    rounds, flags = 1_000_000, build.FLAGS["posix"][0]
    out = (ctypes.c_double * 1)()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "fma_loop.c"
        file.write_text(FMA_LOOP.replace("CHAINS", str(CHAINS)), encoding="utf-8")
        loop = ctypes.CDLL(str(build.shared_library(file, flags))).fma_loop
    in_a_round = loop(ctypes.c_long(0), out)
    return in_a_round * rounds / _least(lambda: loop(ctypes.c_long(rounds), out))


def evaluation_and_step(derivation) -> tuple[int, int]:
    """The operations of q̈ of one state, and of one step of RK4, as the generated C has them."""
    program = straight_line.forward_dynamics(derivation)
    # As the preprocessor leaves it: there is another reduction of angles without hardware's fma.
    source = subprocess.run(
        [*build.compiler(), *build.FLAGS["posix"][0], "-E", "-x", "c", "-"],
        input=c_code.source(program, derivation.n),
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    reduction, sines, steps, update = (
        body(source, name)
        for name in ("reduce", "sine_and_cosine", "state_to_acceleration", "rk4_block")
    )
    evaluation = len(program.angles) * operations(reduction + sines) + operations(steps)
    stages = re.findall(r"^ +for \(int stage .*?^        }", update, re.DOTALL | re.MULTILINE)
    updates = operations(update) + 2 * operations(stages[0])  # it runs three times
    return evaluation, 4 * evaluation + derivation.n * updates


def body(source: str, function: str) -> str:
    """What stands between a C function's braces, which begin lines."""
    found = re.search(rf"\b{function}\([^)]*\)\s*^{{\n(.*?)^}}", source, re.DOTALL | re.MULTILINE)
    if found is None:
        raise ValueError(f"{function}: no such function")
    return found[1]


def operations(statements: str) -> int:
    """The +, −, · and / on floats in C's simple assignments, one a line; an fma is two."""
    count = 0
    for line in statements.splitlines():
        try:
            tree = ast.parse(line.strip().removeprefix("const double ").rstrip(";"))
        except SyntaxError:  # a loop, a choice, integers: no arithmetic of the formulas
            continue
        count += _count(tree)
    return count


def _count(node) -> int:
    match node:
        case ast.Subscript():  # an index is no float
            return 0
        case ast.BinOp(op=ast.Add() | ast.Sub() | ast.Mult() | ast.Div()) | ast.AugAssign():
            here = 1
        case ast.Call(func=ast.Name("fma")):
            here = 2
        case _:
            here = 0
    return here + sum(map(_count, ast.iter_child_nodes(node)))


def table(rows: list[Work], copy: float, peak: float) -> str:
    """The rows as a Markdown table, with what they reach of the two limits."""
    lines = [
        "| generated C | time | bytes | operations | GB/s | of a copy | Gflop/s | of the peak |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        moved, done = row.bytes / row.seconds, row.operations / row.seconds
        lines.append(
            f"| {row.what} | {row.seconds * 1e9:.3g} ns | {row.bytes:.3g} | {row.operations} "
            f"| {moved / 1e9:.3g} | {moved / copy:.0%} | {done / 1e9:.3g} | {done / peak:.0%} |"
        )
    return "\n".join(lines) + "\n"


def _least(call: Callable, rounds: int = 10) -> float:
    least = float("inf")
    for _ in range(rounds):
        start = time.process_time()
        call()
        least = min(least, time.process_time() - start)
    return least
