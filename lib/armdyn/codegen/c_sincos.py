"""Writes C that computes sines and cosines by the block, as compilers turn into vector instructions."""

import math
from decimal import Decimal, localcontext
from functools import cache

import sympy as sp

# Terms of the series beyond r in the sine and beyond 1 − r²/2 in the cosine, |r| ≤ π/4: what is left
# out is below a quarter of a unit in the last place.
TERMS = 6
_HALF_PI = Decimal("1.57079632679489661923132169163975144209858469968755291")


@cache
def source() -> str:
    """C99: `sines(count, t, s, c)` gives the sine and cosine of `count` angles, and `bits_of(x)`.

    The angle less the nearest multiple of π/2, subtracted in three parts (W. J. Cody, W. Waite
    (1980), Software Manual for the Elementary Functions); then polynomials. The products of the
    first two parts with the multiple are exact: by 33 bits and up to 20, or, where the processor
    multiplies and adds with one rounding, by that. The multiple modulo 4 says which polynomial is
    the sine, and the signs. Beyond 10⁶ rad the C library's own.
    """
    sine = _horner(_series([(-1) ** j / sp.factorial(2 * j + 1) for j in range(1, 13)]))
    cosine = _horner(_series([(-1) ** j / sp.factorial(2 * j) for j in range(2, 14)]))
    first, second, third = _half_pi(33)
    fused = [-part for part in _half_pi(53)]
    return f"""#include <math.h>
#include <stdint.h>
#include <string.h>

#if defined(_MSC_VER)
#define INLINE static __forceinline
#define restrict __restrict
#define ALIGNED
#else
#define INLINE static inline __attribute__((always_inline))
#define ALIGNED __attribute__((aligned(64)))
#endif

INLINE uint64_t bits_of(double x)
{{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}}

INLINE double flipped(double x, uint64_t sign)
{{
    const uint64_t bits = bits_of(x) ^ sign;
    memcpy(&x, &bits, sizeof x);
    return x;
}}

/* The angle t as r, within pi/4, and a number whose low bits count the quarter turns taken off. */
INLINE void reduce(double t, double *restrict remainder, double *restrict count)
{{
    const double shifted = t * {2 / math.pi!r} + {1.5 * 2**52!r};
    const double turns = shifted - {1.5 * 2**52!r};
#if defined(FP_FAST_FMA)
    const double part = fma(turns, {fused[0]!r}, t);
    const double r = fma(turns, {fused[2]!r}, fma(turns, {fused[1]!r}, part));
#else
    const double r = ((t - turns * {first!r}) - turns * {second!r}) - turns * {third!r};
#endif
    *remainder = r;
    *count = shifted;
}}

INLINE void sine_and_cosine(double r, double count, double *restrict s, double *restrict c)
{{
    const double z = r * r;
    const double sine = r + r * z * {sine};
    const double cosine = 1 + z * (-0.5 + z * {cosine});
    const uint64_t turns = bits_of(count);
    const double a = turns & 1 ? cosine : sine, b = turns & 1 ? sine : cosine;
    *s = flipped(a, (turns & 2) << 62);
    *c = flipped(b, ((turns + 1) & 2) << 62);
}}

INLINE void sines(int count, const double *restrict t, double *restrict s, double *restrict c)
{{
    uint64_t far = 0;
    /* Two loops, as a processor looks only so far ahead for what does not wait for anything. */
    for (int i = 0; i < count; i++) {{
        reduce(t[i], s + i, c + i);
        far |= fabs(t[i]) <= 1e6 ? 0 : 1;
    }}
    for (int i = 0; i < count; i++)
        sine_and_cosine(s[i], c[i], s + i, c + i);
    if (far)
        for (int i = 0; i < count; i++)
            if (!(fabs(t[i]) <= 1e6)) {{
                s[i] = sin(t[i]);
                c[i] = cos(t[i]);
            }}
}}
"""


def _series(taylor):
    """The polynomial in z = r², with TERMS terms, nearest to the Taylor series of these coefficients.

    From the last term on, each is replaced by what is left of it when the Chebyshev polynomial of
    its degree, small throughout the interval, is taken off: economisation (C. Lanczos (1938),
    Trigonometric Interpolation of Empirical and Analytical Functions).
    """
    z = sp.Symbol("z")
    largest = sp.Rational(31, 50)  # above (π/4)²
    series = sp.Poly(list(reversed(taylor)), z)
    while series.degree() >= TERMS:
        flat = sp.Poly(sp.chebyshevt_poly(series.degree(), 2 * z / largest - 1), z)
        series -= flat * (series.LC() / flat.LC())
    return [float(c) for c in reversed(series.all_coeffs())]


def _horner(coefficients):
    text = repr(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        text = f"({coefficient!r} + z * {text})"
    return text


def _half_pi(bits):
    """π/2 as a sum of three floats, the first two of so many bits."""
    rest = _HALF_PI
    parts = []
    with localcontext() as context:
        context.prec = 70
        for _ in range(2):
            mantissa, exponent = math.frexp(float(rest))
            part = math.ldexp(math.floor(mantissa * 2**bits), exponent - bits)
            parts.append(part)
            rest -= Decimal(part)
    return (*parts, float(rest))
