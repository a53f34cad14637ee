import os
import sys
from pathlib import Path

import numpy as np
import pytest

from armdyn.codegen import build, c_model, vector_width
from armdyn.derive import planar_2r, planar_chain
from tests.armdyn.derivations import states, values

pytestmark = [
    pytest.mark.usefixtures("compiler"),
    pytest.mark.skipif(sys.platform == "win32", reason="Microsoft's compiler has no such flags"),
]
NATIVE = build.FLAGS["posix"][0]


@pytest.fixture(autouse=True)
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(build, "_loaded", {})
    return tmp_path / "cache"


@pytest.fixture
def trials(monkeypatch):
    """The flags of each trial, and of each only."""
    made = []

    def noted(file, flags):
        made.append(flags[-1])
        return build.shared_library(file, flags)

    return made, noted


@pytest.fixture
def wide(monkeypatch):
    """A compiler that says its processor has 512 bits, whatever it has."""
    monkeypatch.setattr(
        vector_width,
        "_printed",
        lambda command: "a compiler" if "--version" in command else "#define __AVX512F__ 1",
    )


def chosen(cache, compile_file, machine="this one"):
    return vector_width.flags(build.compiler(), compile_file, NATIVE, cache, machine)


def test_the_numbers_are_the_same_in_each_width(monkeypatch):
    d = planar_chain(3)
    q, qd, u = states(d.n, batch=(77,))
    q[5] *= 1e7  # beyond where we reduce angles ourselves
    x0 = np.concatenate([q, qd], axis=-1)
    found = []
    for width in ((), *((w,) for w in vector_width.WIDTHS if knows(w))):
        monkeypatch.setattr(build, "_width", lambda flags, width=width: width)
        monkeypatch.setattr(build, "_loaded", {})
        monkeypatch.setenv("ARMDYN_CACHE", str(build.cache_folder() / "another"))
        model = c_model(d, values(d))
        found.append((model.dynamics_many(q, qd, u), model.rk4(x0, u, 1e-3, 10)))
    for many, run in found[1:]:
        assert np.array_equal(many, found[0][0])
        assert np.array_equal(run, found[0][1])


def knows(flag):
    command = [*build.compiler(), flag, "-E", "-x", "c", os.devnull]
    try:
        vector_width._printed(command)
    except vector_width.subprocess.SubprocessError:
        return False
    return True


def test_it_is_tried_once_for_a_compiler_and_a_machine(wide, trials, cache):
    made, noted = trials
    if not all(knows(w) for w in vector_width.WIDTHS):
        pytest.skip("needs a compiler with -mprefer-vector-width")
    first = chosen(cache, noted)
    assert len(first) == 1
    assert first[0] in vector_width.WIDTHS
    assert made == list(vector_width.WIDTHS)
    assert chosen(cache, noted) == first
    assert len(made) == 2
    chosen(cache, noted, machine="another")
    assert len(made) == 4


@pytest.mark.parametrize("times", [(1.0, 0.6), (1.0, 0.99), (1.0, 1.5)])
def test_the_wide_one_has_to_be_clearly_faster(monkeypatch, wide, cache, times):
    if not all(knows(w) for w in vector_width.WIDTHS):
        pytest.skip("needs a compiler with -mprefer-vector-width")
    monkeypatch.setattr(vector_width, "_least_times", lambda trials: times)
    assert chosen(cache, build.shared_library) == (vector_width.WIDTHS[times[1] < 0.9],)


def test_one_width_only_needs_no_trial(monkeypatch, trials, cache):
    made, noted = trials
    monkeypatch.setattr(vector_width, "_printed", lambda command: "#define __AVX2__ 1")
    assert chosen(cache, noted) == ()
    assert made == []
    assert not cache.exists()


def test_a_flag_that_the_compiler_does_not_know_is_left_out(monkeypatch, wide, trials, cache):
    made, noted = trials
    monkeypatch.setattr(vector_width, "WIDTHS", ("-mno-such-width=256", "-mno-such-width=512"))
    assert chosen(cache, noted) == ()
    assert chosen(cache, noted) == ()
    assert made == ["-mno-such-width=256"]


def test_a_compiler_that_says_nothing_is_asked_nothing_more(trials, cache):
    made, noted = trials
    assert vector_width.flags(["no-such-compiler"], noted, NATIVE, cache, "") == ()
    assert vector_width.flags(["false"], noted, NATIVE, cache, "") == ()
    assert made == []


def test_a_model_is_made_with_all_the_flags_that_the_compiler_knows(monkeypatch):
    if not all(map(knows, NATIVE)):
        pytest.skip("needs a compiler that knows -march=native")
    tried = []

    def noted(file, flags):
        tried.append((file.stem, flags[: len(NATIVE)]))
        return shared_library(file, flags)

    shared_library = build.shared_library
    monkeypatch.setattr(build, "shared_library", noted)
    c_model(planar_2r(), values(planar_2r()))
    assert [flags for stem, flags in tried if stem == build.MODULE] == [NATIVE]


def test_a_cache_that_nobody_can_write_to_is_no_error(monkeypatch, tmp_path):
    barred = tmp_path / "file"
    barred.write_text("")
    monkeypatch.setenv("ARMDYN_CACHE", str(barred / "cache"))
    d = planar_2r()
    model = c_model(d, values(d))
    assert np.isfinite(model.dynamics(*states(2))).all()
    assert not Path(model._compiled.__file__).is_relative_to(tmp_path)
    assert barred.read_text() == ""


def test_an_answer_that_makes_no_sense_is_found_again(monkeypatch, wide, cache):
    if not all(map(knows, vector_width.WIDTHS)):
        pytest.skip("needs a compiler with -mprefer-vector-width")
    monkeypatch.setattr(vector_width, "_least_times", lambda trials: (1.0, 0.5))
    cached = vector_width.WIDTHS[1]
    assert chosen(cache, build.shared_library) == (cached,)
    for kept in cache.glob("vector-width-*"):
        kept.write_text("half an ans")
    assert chosen(cache, build.shared_library) == (cached,)
    assert [kept.read_text() for kept in cache.glob("vector-width-*")] == [cached]
