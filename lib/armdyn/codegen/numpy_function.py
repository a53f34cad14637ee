"""Runs straight-line code as a NumPy function: in buffers on arrays, in floats on one state."""

import math
from contextlib import nullcontext
from functools import partial

import numpy as np
import sympy as sp

from armdyn.codegen.buffers import in_buffers
from armdyn.codegen.numpy_printer import ArrayPrinter, FloatPrinter
from armdyn.codegen.printing import code

# As many states at a time as keep every temporary in the processor's cache.
BLOCK = 8192


class NumpyFunction:
    """Straight-line code as a function of q, v, u (those of them it takes), each (..., n).

    Gives (..., *shape), of the code's first results; or None where `judge` says no to all of them.
    The same program runs on arrays, in buffers, and with `math` on one state, which is many times
    faster on single numbers.
    """

    def __init__(self, program, numbers, arguments, n, shape, judge=None):
        self.shape, self.n, self.judge = shape, n, judge
        self.size = math.prod(shape)
        given = [f"{name}_{i}" for name in arguments for i in range(n)]
        text = partial(code, FloatPrinter())
        self.on_floats = _compiled(_FLOATS, numbers, given, *_lines(program, text, _sincos_call))
        lines = _lines(program, partial(code, ArrayPrinter()), _half_angle)
        statements, results, self.buffers = in_buffers(*lines, given)
        # All cases of a Piecewise are computed, those too that are not defined there.
        self.branches = any(e.has(sp.Piecewise) for _, e in program.steps)
        self.branches |= any(e.has(sp.Piecewise) for e in program.outputs)
        given += [f"b_{i}" for i in range(self.buffers)]
        self.on_arrays = _compiled(vars(np), numbers, given, statements, results)

    def __call__(self, *states):
        batch = np.broadcast_shapes(*(s.shape[:-1] for s in states))
        with np.errstate(all="ignore") if self.branches else nullcontext():
            return self._many(states, batch) if batch else self._one(states)

    def _many(self, states, batch):
        count = math.prod(batch)
        rows = [
            # One row for the whole batch stays one row.
            s.reshape(-1, self.n)
            if s.size == self.n or s.shape[:-1] == batch
            else np.broadcast_to(s, (*batch, self.n)).reshape(-1, self.n)
            for s in states
        ]
        found = np.empty((count, self.size))
        # Of this call alone: another thread may be in another.
        buffers = np.empty((self.buffers, min(count, BLOCK)))
        for start in range(0, count, BLOCK):
            part = found[start : start + BLOCK]
            given = [r[start : start + BLOCK] if len(r) == count else r for r in rows]
            # It may not show in q̈: a sign, a minimum, a condition can hide it.
            if self.judge and not all(np.isfinite(g.sum()) for g in given):
                return None
            columns = (column for g in given for column in g.T)
            results = self.on_arrays(*columns, *buffers[:, : len(part)])
            for i in range(self.size):
                part[:, i] = results[i]
            if self.judge and not self.judge(part, *results[self.size :]):
                return None
        return found.reshape(*batch, *self.shape)

    def _one(self, states):
        numbers = [x for s in states for x in s.tolist()]
        if self.judge and not math.isfinite(sum(numbers)):
            return None
        try:
            results = self.on_floats(*numbers)
        except (ArithmeticError, ValueError):
            # Python raises an error where NumPy gives inf or NaN, or warns as the user has set it.
            return self._many(states, ())
        found = np.array(results[: self.size], dtype=float)
        if self.judge and not self.judge(found, *results[self.size :]):
            return None
        return found.reshape(self.shape)


def _lines(program, text, sincos) -> tuple[list[str], list[str]]:
    """(statements, results) of the program, as Python expressions."""
    lines = [f"{s} = {text(e)}" for s, e in program.angle_steps]
    for s, c, angle in program.angles:
        lines += sincos(s, c, text(angle))
    lines += [f"{s} = {text(e)}" for s, e in program.steps]
    return lines, [text(e) for e in program.outputs]


def _sincos_call(s, c, angle):
    return [f"{s}, {c} = sincos({angle})"]


def _half_angle(s, c, angle):
    """sin x and cos x from tan(x/2), which NumPy computes faster than both."""
    return [
        f"tan_{s} = tan(0.5*({angle}))",
        f"two_{c} = 2/(1 + tan_{s}*tan_{s})",
        f"{s} = tan_{s}*two_{c}",
        f"{c} = two_{c} - 1",
    ]


def _compiled(names, numbers, given, lines, results):
    """The lines as a function of what is given, with the numbers for k_0, k_1, …"""
    constants = ", ".join(f"k_{i}" for i in range(len(numbers)))
    body = "".join(f"        {line}\n" for line in lines)
    source = (
        f"def with_constants({constants}):\n"
        f"    def compute({', '.join(given)}):\n{body}        return ({', '.join(results)},)\n"
        "    return compute\n"
    )
    space = dict(names)
    exec(compile(source, "<armdyn.codegen>", "exec"), space)
    return space["with_constants"](*numbers)


_FLOATS = {
    **vars(np),
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "pow")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "pi", "e")},
    **{f"arc{name}": getattr(math, f"a{name}") for name in ("sin", "cos", "tan", "tan2")},
    **{f"arc{name}h": getattr(math, f"a{name}h") for name in ("sin", "cos", "tan")},
    "abs": abs,
    "minimum": min,
    "maximum": max,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "floor": lambda x: float(math.floor(x)),
    "ceil": lambda x: float(math.ceil(x)),
    "sincos": lambda x: (math.sin(x), math.cos(x)),
}
