"""Finds the vector width that is fastest on this processor, by trying it once, and keeps the answer.

Compilers choose a width by the processor's name, not by its speed: GCC takes 256 bits on most
processors that have 512, to keep their clock high, and code that does little but multiply and add
then runs at little more than half its speed. The results are the same in each width: every lane
goes through the same operations.
"""

import ctypes
import hashlib
import os
import re
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from armdyn.codegen import c_sincos

WIDTHS = ("-mprefer-vector-width=256", "-mprefer-vector-width=512")
# By how much the second has to be faster to be taken: it may slow down what runs beside it.
MARGIN = 0.95
COUNT, CALLS, ROUNDS = 256, 10_000, 6

_TRIAL = """
enum { COUNT = @COUNT@ };
double angle[COUNT], sine[COUNT], cosine[COUNT], result[COUNT];

void trial(int calls)
{
    for (int call = 0; call < calls; call++) {
        sines(COUNT, angle, sine, cosine);
        for (int i = 0; i < COUNT; i++) {
            const double pivot = 3 + cosine[i];
            result[i] = (angle[i] - sine[i] * cosine[i] * result[i]) / pivot;
        }
    }
}
"""


def flags(
    command: list[str], compile_file: Callable, chosen: tuple[str, ...], cache: Path, machine
) -> tuple[str, ...]:
    """What to add to `chosen`, the compiler's flags: one of WIDTHS, or nothing.

    compile_file(file, flags) makes a shared library. The answer is kept in the folder `cache`, for
    this compiler and this machine. Nothing is added, and nothing raised, where the processor has
    one width only, the compiler knows no such flag, or the trial fails.
    """
    try:
        version = _printed([*command, "--version"])
        if "__AVX512F__" not in _printed([*command, *chosen, "-dM", "-E", "-x", "c", os.devnull]):
            return ()
        key = repr((command, version, chosen, machine, WIDTHS, _source()))
        kept = cache / f"vector-width-{hashlib.sha256(key.encode()).hexdigest()[:32]}"
        answer = kept.read_text(encoding="utf-8") if os.path.isfile(kept) else None
        if answer not in ("", *WIDTHS):
            answer = _fastest(compile_file, chosen)
            _keep(kept, answer)
    except (OSError, subprocess.SubprocessError):
        return ()
    return (answer,) if answer else ()


def _fastest(compile_file, chosen):
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        trials = []
        for width in WIDTHS:
            file = Path(folder) / f"trial{re.sub(r'[^0-9]', '', width)}.c"
            file.write_text(_source(), encoding="utf-8")
            try:
                trials.append(ctypes.CDLL(str(compile_file(file, (*chosen, width)))).trial)
            except RuntimeError:  # the compiler does not know this width
                return ""
        narrow, wide = _least_times(trials)
    return WIDTHS[wide < MARGIN * narrow]


def _least_times(trials):
    # In turn, each for milliseconds: a processor may lower its clock for wide instructions.
    least = [float("inf")] * len(trials)
    for _ in range(ROUNDS):
        for i, trial in enumerate(trials):
            start = time.process_time()
            trial(CALLS)
            least[i] = min(least[i], time.process_time() - start)
    return least


def _keep(file, answer):
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(
            "w", dir=file.parent, delete=False, encoding="utf-8"
        ) as made:
            made.write(answer)
        os.replace(made.name, file)
    except OSError:  # then the next process tries again
        pass


def _printed(command):
    return subprocess.run(command, capture_output=True, check=True, timeout=60).stdout.decode(
        errors="replace"
    )


def _source():
    return c_sincos.source() + _TRIAL.replace("@COUNT@", str(COUNT))
