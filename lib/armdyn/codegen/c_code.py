"""Writes the C source of a derivation's forward dynamics and RK4 loop."""

from functools import partial

import sympy as sp
from sympy.printing.c import C99CodePrinter

from armdyn.codegen import c_loops, c_sincos
from armdyn.codegen.printing import CFamily, code
from armdyn.codegen.straight_line import StraightLine

# States worked through side by side, one per lane of the processor's vector registers.
LANES = 32


def source(program: StraightLine, n: int) -> str:
    """C99 for a program of `straight_line.forward_dynamics`; it knows nothing of Python.

    k: the program's constants. least: the smallest pivot of M, relative to its trace, that counts
    as regular. `one` and `many` give q̈ of one state and of `count` states, row by row, with
    `*_step` numbers from row to row (0: the same row for all); `one` returns whether M was regular
    and q̈ finite, `many` the first row where not, or −1. `rk4` keeps every state,
    (arms, steps + 1, 2n), or with keep = 0 the last, (arms, 2n); it returns −1, or
    arm·(steps + 1) + step where it stopped.
    """
    text = partial(code, _Printer())
    reads = [f"double {name}_{i}" for name in "qvu" for i in range(n)]
    reads += [f"double {symbol}" for s, c, _ in program.angles for symbol in (s, c)]
    reads += [f"double *restrict o_{i}" for i in range(n)]
    reads += ["double *restrict pivot", "double *restrict trace"]
    body = [f"const double {s} = {text(e)};" for s, e in program.steps]
    results = [*(f"o_{i}" for i in range(n)), "pivot", "trace"]
    body += [f"*{o} = {text(e)};" for o, e in zip(results, program.outputs, strict=True)]
    count = len(program.angles)
    # The arguments of sine and cosine, of which a whole block is computed at once.
    loads = _loads(
        n, *(angle for *_, angle in program.angles), *(e for _, e in program.angle_steps)
    )
    angles = [f"const double {s} = {text(e)};" for s, e in program.angle_steps]
    angles += [f"t[{i} * lanes + l] = {text(a)};" for i, (*_, a) in enumerate(program.angles)]
    passed = [f"{name}[{i} * lanes + l]" for name in "qvu" for i in range(n)]
    passed += [f"{name}[{i} * lanes + l]" for i in range(count) for name in ("s", "c")]
    passed += [f"a + {i} * lanes + l" for i in range(n)] + ["&pivot", "&trace"]
    excess = " + ".join(f"(a[{i} * lanes + l] - a[{i} * lanes + l])" for i in range(n))
    return f"""#include <stddef.h>
{c_sincos.source()}
enum {{ N = {n}, LANES = {LANES}, ANGLES = {max(count, 1)} }};

INLINE double least_of(double a, double b)
{{
    return a < b ? a : b;
}}

INLINE void state_to_acceleration(const double *restrict k, {", ".join(reads)})
{{
    (void)k;
    {_lines(body, 4)}
}}

INLINE int all_finite(int count, const double *restrict x)
{{
    uint64_t wrong = 0;
    for (int i = 0; i < count; i++)
        wrong |= bits_of(x[i] - x[i]);
    return wrong == 0;
}}

INLINE int forward(const int lanes, const double *restrict k, double least,
                   const double *restrict q, const double *restrict v, const double *restrict u,
                   double *restrict a)
{{
    ALIGNED double t[ANGLES * LANES], s[ANGLES * LANES], c[ANGLES * LANES];
    uint64_t wrong = 0;
    for (int l = 0; l < lanes; l++) {{
        {_lines(loads + angles, 8)}
    }}
    sines({count} * lanes, t, s, c);
    for (int l = 0; l < lanes; l++) {{
        double pivot, trace;
        state_to_acceleration(k, {", ".join(passed)});
        /* x - x is +0, all bits 0, unless x is not finite. */
        const double zero = pivot > least * trace ? {excess} : NAN;
        wrong |= bits_of(zero);
    }}
    return wrong == 0;
}}

static int one(const double *k, double least, const double *q, const double *v, const double *u,
        double *a)
{{
    return all_finite(N, q) && all_finite(N, v) && all_finite(N, u)
           && forward(1, k, least, q, v, u, a);
}}
{c_loops.SOURCE}"""


def _lines(lines, indent):
    return ("\n" + " " * indent).join(lines)


def _loads(n, *expressions):
    read = {s.name for e in expressions for s in sp.sympify(e).free_symbols}
    return [
        f"const double {name}_{i} = {name}[{i} * lanes + l];"
        for name in "qv"
        for i in range(n)
        if f"{name}_{i}" in read
    ]


class _Printer(CFamily, C99CodePrinter):
    double = "(double)"

    def __init__(self):
        super().__init__({"strict": True, "math_macros": {}})

    def _print_Pow(self, expr):
        base, power = expr.as_base_exp()
        if power in (-1, 2, 3):
            text = f"({self._print(base)})"
            product = "*".join([text] * abs(int(power)))
            # In brackets, as it may come to stand below a fraction line.
            return f"(1.0/{text})" if power == -1 else f"({product})"
        return super()._print_Pow(expr)

    def _print_Symbol(self, expr):
        name = expr.name
        return f"k[{name[2:]}]" if name.startswith("k_") else name

    def _print_Min(self, expr):
        text = self._print(expr.args[0])
        for arg in expr.args[1:]:
            # fmin's care for NaN costs more; q̈ itself shows one.
            text = f"least_of({text}, {self._print(arg)})"
        return text
