"""Writes the C source of a derivation's forward dynamics and RK4 loop."""

import math
from decimal import Decimal, localcontext
from functools import partial

import sympy as sp
from sympy.printing.c import C99CodePrinter

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
    reads += [f"double *restrict o_{i}" for i in range(n + 2)]
    body = [f"const double {s} = {text(e)};" for s, e in program.steps]
    body += [f"*o_{i} = {text(e)};" for i, e in enumerate(program.outputs)]
    count = len(program.angles)
    # The arguments of sine and cosine, of which a whole block is computed at once.
    loads = _loads(
        n, *(angle for *_, angle in program.angles), *(e for _, e in program.angle_steps)
    )
    angles = [f"const double {s} = {text(e)};" for s, e in program.angle_steps]
    angles += [f"t[{i} * lanes + l] = {text(a)};" for i, (*_, a) in enumerate(program.angles)]
    passed = [f"{name}[{i} * lanes + l]" for name in "qvu" for i in range(n)]
    passed += [f"{name}[{i} * lanes + l]" for i in range(count) for name in ("s", "c")]
    passed += [f"a + {i} * lanes + l" for i in range(n)] + ["pivot + l", "trace + l"]
    return f"""#include <math.h>
#include <stddef.h>

#if defined(_MSC_VER)
#define INLINE static __forceinline
#define restrict __restrict
#else
#define INLINE static inline __attribute__((always_inline))
#endif

enum {{ N = {n}, LANES = {LANES}, ANGLES = {max(count, 1)} }};
{_sincos()}
INLINE double least_of(double a, double b)
{{
    return a < b ? a : b;
}}

INLINE void state_to_acceleration(const double *restrict k, {", ".join(reads)})
{{
    (void)k;
    {_lines(body, 4)}
}}

INLINE int forward(const int lanes, const double *restrict k, double least,
                   const double *restrict q, const double *restrict v, const double *restrict u,
                   double *restrict a)
{{
    double t[ANGLES * LANES], s[ANGLES * LANES], c[ANGLES * LANES], pivot[LANES], trace[LANES];
    for (int l = 0; l < lanes; l++) {{
        {_lines(loads + angles, 8)}
    }}
    sines({count} * lanes, t, s, c);
    for (int l = 0; l < lanes; l++)
        state_to_acceleration(k, {", ".join(passed)});
    int regular = 1;
    for (int l = 0; l < lanes; l++)
        regular &= pivot[l] > least * trace[l];
    for (int i = 0; i < N * lanes; i++)
        regular &= a[i] - a[i] == 0;
    return regular;
}}

/* What is not finite may not show in a: a sign, a minimum, a condition can hide it. */
INLINE int all_finite(int count, const double *x)
{{
    int finite = 1;
    for (int i = 0; i < count; i++)
        finite &= x[i] - x[i] == 0;
    return finite;
}}

static int one(const double *k, double least, const double *q, const double *v, const double *u,
        double *a)
{{
    return forward(1, k, least, q, v, u, a) & all_finite(N, q) & all_finite(N, v)
           & all_finite(N, u);
}}
{_LOOPS}"""


_LOOPS = """
INLINE void gather(int lanes, int width, const double *rows, ptrdiff_t step, double *restrict to)
{
    for (int l = 0; l < lanes; l++)
        for (int i = 0; i < width; i++)
            to[i * LANES + l] = rows[l * step + i];
    for (int l = lanes; l < LANES; l++)
        for (int i = 0; i < width; i++)
            to[i * LANES + l] = rows[(lanes - 1) * step + i];
}

static ptrdiff_t many(const double *k, double least, ptrdiff_t count, const double *q, ptrdiff_t q_step,
               const double *v, ptrdiff_t v_step, const double *u, ptrdiff_t u_step, double *a)
{
    double ql[N * LANES], vl[N * LANES], ul[N * LANES], al[N * LANES];
    for (ptrdiff_t first = 0; first < count; first += LANES) {
        const int lanes = count - first < LANES ? (int)(count - first) : LANES;
        gather(lanes, N, q + first * q_step, q_step, ql);
        gather(lanes, N, v + first * v_step, v_step, vl);
        gather(lanes, N, u + first * u_step, u_step, ul);
        if (!(forward(LANES, k, least, ql, vl, ul, al) & all_finite(N * LANES, ql)
              & all_finite(N * LANES, vl) & all_finite(N * LANES, ul)))
            for (int l = 0; l < lanes; l++) {
                const ptrdiff_t row = first + l;
                if (!one(k, least, q + row * q_step, v + row * v_step, u + row * u_step, al))
                    return row;
            }
        for (int l = 0; l < lanes; l++)
            for (int i = 0; i < N; i++)
                a[(first + l) * N + i] = al[i * LANES + l];
    }
    return -1;
}

/* The state of the block at one time, to the rows of x. */
INLINE void scatter(int lanes, int used, const double *x, ptrdiff_t step, double *to)
{
    for (int l = 0; l < used; l++)
        for (int i = 0; i < 2 * N; i++)
            to[l * step + i] = x[i * lanes + l];
}

INLINE ptrdiff_t rk4_block(const int lanes, int used, const double *k, double least, double *x,
                           const double *u, double dt, ptrdiff_t steps, int keep, double *to)
{
    enum { SIZE = 2 * N * LANES };
    double slope[SIZE], sum[SIZE], at[SIZE];
    const ptrdiff_t step = keep ? (steps + 1) * 2 * N : 2 * N;
    const int half = N * lanes;
    if (keep)
        scatter(lanes, used, x, step, to);
    for (ptrdiff_t t = 0; t < steps; t++) {
        int regular = forward(lanes, k, least, x, x + half, u, slope + half);
        for (int i = 0; i < half; i++)
            slope[i] = x[half + i];
        for (int i = 0; i < 2 * half; i++) {
            sum[i] = slope[i];
            at[i] = x[i] + dt / 2 * slope[i];
        }
        for (int stage = 1; stage < 4; stage++) {
            const double reach = stage == 1 ? dt / 2 : dt, weight = stage == 3 ? 1 : 2;
            regular &= forward(lanes, k, least, at, at + half, u, slope + half);
            for (int i = 0; i < half; i++)
                slope[i] = at[half + i];
            for (int i = 0; i < 2 * half; i++) {
                sum[i] += weight * slope[i];
                at[i] = x[i] + reach * slope[i];
            }
        }
        for (int i = 0; i < 2 * half; i++)
            x[i] += dt / 6 * sum[i];
        for (int i = 0; i < 2 * half; i++)
            regular &= x[i] - x[i] == 0;
        if (!regular)
            return t + 1;
        if (keep)
            scatter(lanes, used, x, step, to + (t + 1) * 2 * N);
    }
    if (!keep)
        scatter(lanes, used, x, step, to);
    return -1;
}

static ptrdiff_t rk4(const double *k, double least, ptrdiff_t arms, const double *x0, ptrdiff_t x_step,
              const double *u, ptrdiff_t u_step, double dt, ptrdiff_t steps, int keep, double *x)
{
    double xl[2 * N * LANES], ul[N * LANES];
    const ptrdiff_t row = keep ? (steps + 1) * 2 * N : 2 * N;
    for (ptrdiff_t first = 0; first < arms; first += LANES) {
        const int used = arms - first < LANES ? (int)(arms - first) : LANES;
        ptrdiff_t stopped = -1;
        if (used >= LANES / 4) {
            gather(used, 2 * N, x0 + first * x_step, x_step, xl);
            gather(used, N, u + first * u_step, u_step, ul);
            stopped = rk4_block(LANES, used, k, least, xl, ul, dt, steps, keep, x + first * row);
            if (stopped < 0)
                continue;
        }
        for (ptrdiff_t arm = first; arm < first + used; arm++) {
            for (int i = 0; i < 2 * N; i++)
                xl[i] = x0[arm * x_step + i];
            stopped = rk4_block(1, 1, k, least, xl, u + arm * u_step, dt, steps, keep,
                                x + arm * row);
            if (stopped >= 0)
                return arm * (steps + 1) + stopped;
        }
    }
    return -1;
}
"""


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


def _sincos():
    """Sine and cosine of a whole block, as compilers turn into vector instructions.

    The angle less the nearest multiple of π/2, subtracted in three parts whose products with the
    multiple are exact (W. J. Cody, W. Waite (1980), Software Manual for the Elementary Functions);
    then Taylor series within ±π/4, whose remainders are below half a unit in the last place.
    Beyond 10⁶ rad the C library's own.
    """
    sine = _horner([(-1) ** j / math.factorial(2 * j + 1) for j in range(1, 9)])
    cosine = _horner([(-1) ** j / math.factorial(2 * j) for j in range(2, 9)])
    first, second, third = _half_pi_parts()
    return f"""INLINE void sines(int count, const double *restrict t, double *restrict s,
                  double *restrict c)
{{
    for (int i = 0; i < count; i++) {{
        const double turns = (t[i] * {2 / math.pi!r} + 0x1.8p52) - 0x1.8p52;
        const double r = ((t[i] - turns * {first!r}) - turns * {second!r}) - turns * {third!r};
        const double z = r * r;
        const double sine = r + r * z * {sine};
        const double cosine = 1 - (0.5 * z - z * z * {cosine});
        const double quarter = turns - 4 * floor(turns * 0.25);
        const double odd = quarter - 2 * floor(quarter * 0.5);
        const double a = odd != 0 ? cosine : sine, b = odd != 0 ? sine : cosine;
        s[i] = quarter >= 2 ? -a : a;
        c[i] = fabs(quarter - 1.5) < 1 ? -b : b;
    }}
    int far = 0;
    for (int i = 0; i < count; i++)
        far |= !(fabs(t[i]) <= 1e6);
    if (far)
        for (int i = 0; i < count; i++)
            if (!(fabs(t[i]) <= 1e6)) {{
                s[i] = sin(t[i]);
                c[i] = cos(t[i]);
            }}
}}
"""


def _horner(coefficients):
    text = repr(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        text = f"({coefficient!r} + z * {text})"
    return text


def _half_pi_parts():
    """π/2 as a sum of three floats, the first two of 33 bits: times 2²⁰ they are still exact."""
    rest = Decimal("1.57079632679489661923132169163975144209858469968755291")
    parts = []
    with localcontext() as context:
        context.prec = 60
        for _ in range(2):
            mantissa, exponent = math.frexp(float(rest))
            part = math.ldexp(math.floor(mantissa * 2**33), exponent - 33)
            parts.append(part)
            rest -= Decimal(part)
    return (*parts, float(rest))


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
