"""What is kept is used without SymPy: importing and deriving would take a second."""

import subprocess
import sys

import numpy as np
import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mechanisms.built_in import FAMILY, named
from autograder.mechanisms.outline import BuiltIn
from autograder.mutation import kept
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.generated import Generated
from autograder.mutation.in_pi import in_pi
from autograder.mutation.outlines import outline
from autograder.problems.material import conventions

# Hands a wrong answer in to each check that has a catalogue, one after the other.
FIRST_ANSWERS = """
import sys
import numpy as np
from autograder.judging.models import evaluated
from autograder.problems import CHECKS, families
from autograder.problems.material.conventions import Convention
from autograder.protocol import Reply

def first_answer(check):
    def ask(calls):
        right = [np.asarray(evaluated(check.reference, [call])[0], dtype=float) for call in calls]
        return [Reply(value=r + 0.3 * np.sin(7 * np.abs(r) + 0.1)) for r in right]

    verdict = check.run(ask, np.random.default_rng(1))
    assert verdict.state.name in ("INCORRECT", "PARTLY_CORRECT"), (check.id, verdict.problem)
    return len(check.known_mistakes)

own = Convention("square", "hanging", True)
for check in CHECKS.values():
    if check.catalogue:
        for asked in (check, families.on(own, check)):
            known = first_answer(asked)
            print(asked.id, known, bool({"sympy", "scipy"} & set(sys.modules)))
"""


def run(script, *arguments):
    done = subprocess.run(
        [sys.executable, "-c", script, *arguments], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_first_wrong_answer_imports_no_sympy_where_its_check_is_kept():
    run(FIRST_ANSWERS)  # keeps what is not kept yet
    lines = [line.split() for line in run(FIRST_ANSWERS).splitlines()]
    assert {id.partition("-")[0] for id, *_ in lines} == {"p1", "p2", "p3", "p4", "p5", "c6"}
    assert all(int(known) > 3 for _, known, _ in lines)
    assert [id for id, _, loaded in lines if loaded == "True"] == []


@pytest.mark.parametrize("answer", ANSWERS)
@pytest.mark.parametrize("name", ["pendulum", "cart-pole"])
def test_a_mechanism_by_name_has_the_mistakes_of_the_mechanism_itself(name, answer):
    mechanism = MECHANISMS[name]
    by_name, whole = Generated(name, answer), Generated(mechanism, answer)
    assert [(m.name, m.sentence) for m in by_name.mistakes()] == [
        (m.name, m.sentence) for m in whole.mistakes()
    ]
    calls = check_of(mechanism, answer).calls(np.random.default_rng(0), 6)
    for (_, one), (_, other) in zip(by_name(calls), whole(calls), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("name", [*MECHANISMS, *FAMILY])
def test_an_outline_is_that_of_its_mechanism(name):
    found, mechanism = outline(name), named(name)
    assert found == BuiltIn.of(mechanism)
    assert found.full is mechanism
    assert kept.definition(found) == kept.definition(mechanism)
    for part in ("coordinates", "parameters"):
        assert getattr(found, part) == getattr(mechanism, part)
    assert [c.rate for c in found.coordinates] == [v.name for v in mechanism.qd]
    assert [found.place(t) for t in found.friction] == [
        mechanism.place(t) for t in mechanism.friction
    ]


def test_an_outline_in_pi_is_that_of_its_mechanism():
    found, mechanism = in_pi(outline("planar-2r")), in_pi(MECHANISMS["planar-2r"])
    assert found == type(found).of(mechanism)
    assert found.full is mechanism
    assert kept.definition(found) == kept.definition(mechanism)


def test_the_family_is_that_of_the_conventions():
    assert set(FAMILY) == {own.name for own in conventions.FAMILY}
    assert all(own.mechanism is named(own.name) for own in conventions.FAMILY)
    with pytest.raises(KeyError):
        named("planar-2r-relative-upside-down")
