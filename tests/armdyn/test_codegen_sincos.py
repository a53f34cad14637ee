"""The sines and cosines of generated C, against arithmetic of 40 digits."""

import ctypes
import sys

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn.codegen import NoCompilerError, build, c_sincos
from tests.armdyn.arms import a_few

pytestmark = [
    pytest.mark.usefixtures("compiler"),
    pytest.mark.skipif(sys.platform == "win32", reason="asks a compiler of gcc's kind"),
]
RUN = """
void run(int count, const double *t, double *s, double *c)
{
    sines(count, t, s, c);
}
"""
# As this processor is; as one that rounds each product; as one whose compiler keeps them apart.
FLAGS = {
    "native": build.FLAGS["posix"][0],
    "no fma": (*build.FLAGS["posix"][0], "-mno-fma", "-mno-avx512f"),
    "not contracted": (*build.FLAGS["posix"][0], "-ffp-contract=off"),
    "plain": build.FLAGS["posix"][1],
}


@pytest.fixture(scope="module", params=FLAGS)
def sines(request, tmp_path_factory):
    """From angles to (sines, cosines)."""
    file = tmp_path_factory.mktemp("sines") / "sines.c"
    file.write_text(c_sincos.source() + RUN)
    try:
        run = ctypes.CDLL(str(build.shared_library(file, FLAGS[request.param]))).run
    except NoCompilerError as error:
        if request.param == "no fma" and "mno-fma" in str(error):
            pytest.skip("the compiler knows no -mno-fma")
        raise
    pointer = np.ctypeslib.ndpointer(float, flags="C_CONTIGUOUS")
    run.argtypes, run.restype = (ctypes.c_int, pointer, pointer, pointer), None

    def call(angles):
        t = np.array(angles, dtype=float)
        s, c = np.empty_like(t), np.empty_like(t)
        run(len(t), t, s, c)
        return s, c

    return call


near_quarter_turns = st.builds(
    lambda quarters, steps: float(np.pi / 2 * quarters + steps * np.spacing(np.pi / 2 * quarters)),
    st.integers(-700_000, 700_000),
    st.integers(-3, 3),
)


@a_few
@given(st.lists(st.floats(-1e7, 1e7) | st.floats(-10, 10) | near_quarter_turns, min_size=1))
def test_they_are_right_to_a_few_units_in_the_last_place(sines, angles):
    with mpmath.workdps(40):
        for found, function in zip(sines(angles), (mpmath.sin, mpmath.cos), strict=True):
            for x, angle in zip(found, angles, strict=True):
                off = abs(float(mpmath.mpf(float(x)) - function(mpmath.mpf(angle))))
                assert off <= 3 * np.spacing(abs(x)), angle


def test_no_angle_disturbs_its_neighbours(sines):
    angles = [0.5, np.inf, -0.0, np.nan, 1e300, 2.0]
    s, c = sines(angles)
    alone = [sines([angle]) for angle in angles]
    assert np.array_equal(s, [a[0][0] for a in alone], equal_nan=True)
    assert np.array_equal(c, [a[1][0] for a in alone], equal_nan=True)
    assert np.isnan(s[[1, 3]]).all()
    assert np.isnan(c[[1, 3]]).all()
    assert (s[2], c[2]) == (0, 1)
