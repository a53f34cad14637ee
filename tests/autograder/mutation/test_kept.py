"""What is derived is kept on disk: used by other processes, made anew when out of date or damaged."""

import json
import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.mechanisms import MECHANISMS
from autograder.mutation import catalogue, kept
from autograder.mutation.catalogue import Catalogue
from autograder.mutation.mistakes import mistakes_of
from autograder.mutation.tape import Tape
from autograder.mutation.taping import UntapedError, taped

PENDULUM = MECHANISMS["pendulum"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "armdyn" / "mechanisms"


@pytest.fixture
def derived(monkeypatch):
    """Counts how often mistakes are derived."""
    counted = []
    made = Catalogue._made
    monkeypatch.setattr(Catalogue, "_made", lambda self: counted.append(self) or made(self))
    return counted


def numbers(of: Catalogue):
    rng = np.random.default_rng(3)
    m = of.mechanism
    arms = [m.drawn(rng) for _ in range(4)]
    q, qd = ([draw(rng) for _ in arms] for draw in (m.placed, m.moving))
    return of.numbers(np.array(q), np.array(qd), arms)


def test_what_is_kept_gives_the_same_mistakes(folder, derived):
    made, read = Catalogue(PENDULUM, "M"), Catalogue(PENDULUM, "M")
    assert len(derived) == 1
    assert made.mutants == read.mutants
    assert np.array_equal(numbers(made), numbers(read))


def test_another_process_derives_nothing(folder):
    Catalogue(PENDULUM, "M")
    script = (
        "from autograder.mechanisms import MECHANISMS\n"
        "from autograder.mutation.catalogue import Catalogue\n"
        "Catalogue._made = None\n"
        "print(len(Catalogue(MECHANISMS['pendulum'], 'M').mutants))"
    )
    run = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=300
    )
    assert run.stdout.strip() == str(len(Catalogue(PENDULUM, "M").mutants)), run.stderr


def test_an_entry_follows_from_all_that_derives_and_from_no_sentence():
    names = {path.name for path in kept.sources()}
    assert {"of_waves.py", "steps.py", "coriolis.py", "mechanism.py", "derivation.py"} <= names
    assert "of_terms.py" not in names


@pytest.mark.parametrize("change", ["energy", "name of a term", "unit of a parameter", "code"])
def test_another_mechanism_or_other_code_has_another_entry(folder, derived, monkeypatch, change):
    Catalogue(PENDULUM, "M")
    (term,), (first, *others) = PENDULUM.kinetic, PENDULUM.parameters
    other = {
        "energy": replace(PENDULUM, kinetic=(replace(term, energy=2 * term.energy),)),
        "name of a term": replace(PENDULUM, kinetic=(replace(term, name="the turning"),)),
        "unit of a parameter": replace(
            PENDULUM, parameters=(replace(first, unit="N·s²/m"), *others)
        ),
        "code": PENDULUM,
    }[change]
    if change == "code":
        monkeypatch.setattr(kept, "code", lambda: "changed")
    Catalogue(other, "M")
    assert len(derived) == 2
    assert len(list(folder.iterdir())) == 2


def damaged(content):
    yield content[: len(content) // 2]
    yield ""
    yield "[]"
    yield content.replace("0", "1", 1)
    for text in unfit(json.loads(content.partition("\n")[2])):
        yield kept.signed(text)


def unfit(data):
    """What another version may have written."""
    yield "[]"
    yield json.dumps(data | {"mutants": [[["no such operator"], "no such step"]]})
    yield json.dumps(data | {"of_term": data["of_term"][:-1]})
    for key in data:
        yield json.dumps({k: v for k, v in data.items() if k != key})
    for name in ("__import__", "os.system", "einsum"):
        steps = [[name, left, right] for _, left, right in data["tape"]["steps"]]
        yield json.dumps(data | {"tape": data["tape"] | {"steps": steps}})
    for place in (10**6, -1):
        yield json.dumps(data | {"tape": data["tape"] | {"outputs": [place]}})


def test_a_damaged_entry_is_made_anew(folder, derived):
    right = numbers(Catalogue(PENDULUM, "M"))
    (path,) = folder.iterdir()
    content = path.read_text(encoding="utf-8")
    for count, wrong in enumerate(damaged(content), 2):
        path.write_text(wrong, encoding="utf-8")
        assert np.array_equal(numbers(Catalogue(PENDULUM, "M")), right)
        assert len(derived) == count, wrong[:80]
        assert path.read_text(encoding="utf-8") == content


ALL_OF_F = """
import json, sys
import numpy as np
from autograder.mutation.generated import Generated
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
made = Generated("pendulum", "f")
calls = ANSWERS["f"].calls(MECHANISMS["pendulum"], np.random.default_rng(0), 3)
print([(m.name, m.sentence) for m in made.mistakes()])
print([np.nan_to_num(values).round(9).tolist() for _, values in made(calls)])
print([(term.name, term.model.for_calls(calls).round(9).tolist()) for term in made.terms()])
print(made.reference.for_calls(calls).round(9).tolist())
"""


def test_whatever_entry_is_damaged_is_made_anew(folder):
    """Those of the catalogues, their places, sentences, outlines and formulas."""

    def said():
        run = subprocess.run(
            [sys.executable, "-c", ALL_OF_F], capture_output=True, text=True, timeout=300
        )
        assert run.returncode == 0, run.stderr
        return run.stdout

    right = said()
    contents = {path: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    kinds = {tuple(json.loads(content.partition("\n")[2])) for content in contents.values()}
    assert len(kinds) > 4  # of entries
    for k, (path, content) in enumerate(sorted(contents.items())):
        wrong = [
            content[:-5],
            "[]",
            kept.signed("{}"),
            re.sub(r"\[[^][]*\]", "[]", content, count=1),
        ]
        path.write_text(wrong[k % len(wrong)], encoding="utf-8")
    assert said() == right
    assert {path: path.read_text(encoding="utf-8") for path in contents} == contents


def test_another_sentence_makes_the_sentences_alone_anew(folder, derived, monkeypatch):
    again = mistakes_of.__wrapped__
    first = again(PENDULUM, "M")
    before = set(folder.iterdir())
    monkeypatch.setattr(kept, "sentences", lambda: "changed")
    monkeypatch.setattr("autograder.mutation.sentences.sentence", lambda *_: "Another one?")
    derived.clear()
    assert {m.sentence for m in again(PENDULUM, "M")} == {"Another one?"}
    assert len(set(folder.iterdir()) - before) == 1
    assert not derived
    monkeypatch.undo()
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder.parents[1]))
    assert again(PENDULUM, "M") == first


def test_a_folder_that_cannot_be_made_is_no_error(tmp_path, monkeypatch, derived):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert Catalogue(PENDULUM, "M").mutants
    assert len(derived) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="folders have no modes there")
def test_a_folder_that_others_may_write_is_not_believed(folder, derived):
    Catalogue(PENDULUM, "M")
    assert os.stat(folder).st_mode & 0o777 == 0o700
    folder.chmod(0o777)
    Catalogue(PENDULUM, "M")
    assert len(derived) == 2


def test_two_processes_at_once_leave_one_whole_entry(folder):
    script = (
        "from autograder.mechanisms import MECHANISMS\n"
        "from autograder.mutation.catalogue import Catalogue\n"
        "print(len(Catalogue(MECHANISMS['pendulum'], 'g_vec').mutants))"
    )
    runs = [
        subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE) for _ in range(2)
    ]
    outputs = {run.communicate(timeout=300)[0] for run in runs}
    assert outputs == {f"{len(Catalogue(PENDULUM, 'g_vec').mutants)}\n".encode()}
    (path,) = folder.iterdir()
    digest, _, text = path.read_text(encoding="utf-8").partition("\n")
    assert kept.signed(text) == f"{digest}\n{text}"


X, Y = sp.symbols("x y", positive=True)
LEAVES = st.sampled_from([X, Y, sp.Integer(2), sp.Rational(-1, 3), sp.pi])
EXPONENTS = st.sampled_from([2, 3, -1, sp.Rational(1, 2)])
FORMULAS = st.recursive(
    LEAVES,
    lambda e: st.one_of(
        st.tuples(e, e).map(lambda two: two[0] + two[1]),
        st.tuples(e, e).map(lambda two: two[0] * two[1]),
        st.tuples(e, EXPONENTS).map(lambda two: (2 + sp.cos(two[0])) ** two[1]),
        e.map(sp.sin),
        e.map(lambda a: sp.exp(-sp.Abs(a))),
    ),
    max_leaves=8,
)


@settings(max_examples=40, deadline=None)
@given(st.lists(FORMULAS, min_size=1, max_size=4))
def test_a_tape_gives_what_sympy_gives(formulas):
    columns = np.random.default_rng(0).uniform(0.1, 3.0, (2, 5))
    with np.errstate(all="ignore"):
        found = Tape.from_data(taped((X, Y), formulas).as_data())(columns)
    for formula, row in zip(formulas, found, strict=True):
        for (x, y), value in zip(columns.T, row, strict=True):
            exact = complex(sp.sympify(formula).evalf(30, subs={X: x, Y: y}))
            if exact.imag or not np.isfinite(exact):
                continue  # the root of less than nothing
            size = max(1.0, abs(exact))
            assert abs(value - exact.real) <= 1e-9 * size, formula


def test_a_function_without_numbers_is_named():
    with pytest.raises(UntapedError, match="gamma"):
        taped((X,), [sp.gamma(X)])


def test_nothing_is_kept_by_importing(folder):
    assert catalogue
    assert not folder.exists()
