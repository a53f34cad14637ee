"""Whatever one or two reasons license is true: no two of them contradict each other."""

import itertools

import numpy as np
import pytest

from autograder.proofs import DERIVATIONS
from autograder.proofs.parsing import relation_and_sides
from autograder.proofs.steps import Step, Worlds
from tests.autograder.proofs.models import models
from tests.autograder.proofs.test_false_proofs import TABLE
from tests.autograder.proofs.test_other_right_ways import WAYS


def expressions(id: str) -> list[str]:
    """Of the model, of other right ways and of false proofs, each once, and a wrong one."""
    lines = [text for text, *_ in models()[id]]
    lines += [text for of, *way in WAYS.values() if of == id for text, *_ in way]
    lines += [text for (of, _), row in TABLE.items() if of == id for text in row[:2]]
    sides = [relation_and_sides(text)[2] for text in lines]
    return list(dict.fromkeys([DERIVATIONS[id].start, f"2 ({DERIVATIONS[id].start})", *sides]))


@pytest.mark.parametrize("id", DERIVATIONS)
def test_what_two_reasons_license_is_true(id):
    derivation, subject = DERIVATIONS[id], DERIVATIONS[id].subject
    worlds = Worlds(subject, np.random.default_rng(2))
    trees = [derivation.read(text) for text in expressions(id)]
    steps = [Step("=", one, other) for one, other in itertools.combinations(trees, 2)]
    true = {step for step in steps if worlds.hold(step, (subject.everything,), subject.truth)}
    false = [step for step in steps if step not in true]
    assert len(true) > 2
    assert len(false) > 2
    for pair in itertools.combinations_with_replacement(subject.reasons, 2):
        given = tuple(dict.fromkeys(pair))
        named = [reason.name for reason in given]
        assert [step for step in false if worlds.hold(step, given)] == [], named
