"""The model derivations hold, on every seed; each line of them counts, and each of its reasons."""

import pytest

from autograder.proofs import DERIVATIONS, marking
from tests.autograder.proofs.models import marked, models

EVERY = pytest.mark.parametrize("id", DERIVATIONS)


@pytest.fixture
def undiagnosed(monkeypatch):
    """Only whether a line holds, not why: that takes most of the time."""
    monkeypatch.setattr(marking, "MOST_DIAGNOSED", 0)


def test_every_derivation_has_a_model():
    assert models().keys() == DERIVATIONS.keys()


@EVERY
@pytest.mark.parametrize("seed", range(12))
def test_the_model_is_complete(id, seed):
    found = marked(id, models()[id], seed)
    assert [line.said for line in found.lines] == [""] * len(found.lines)
    assert (found.done, found.still) == (True, "")
    assert found.earned == DERIVATIONS[id].rows


@EVERY
def test_a_model_without_its_last_line_is_not_complete(id):
    lines = list(models()[id])
    while "algebra" in lines.pop():  # what is left out then says nothing new
        pass
    found = marked(id, lines)
    assert all(line.holds for line in found.lines)
    assert not found.done
    assert "o be shown: " in found.still


@EVERY
def test_no_reason_of_a_model_may_be_left_out_or_exchanged(id, undiagnosed):
    """The reasons are tested themselves: with another one, no line of a model holds."""
    names = DERIVATIONS[id].reason_names
    for at, (text, *reasons) in enumerate(models()[id]):
        for reason in reasons:
            rest = [other for other in reasons if other != reason] or ["algebra"]
            tried = [rest] if reason != "algebra" else []
            tried += [[*(o for o in reasons if o != reason), other] for other in names
                      if other not in (*reasons, "algebra")]  # fmt: skip
            for instead in tried:
                lines = [*models()[id][:at], (text, *instead)]
                line = marked(id, lines).lines[-1]
                twins = LICENSED.get((id, text), ())
                assert line.holds == (tuple(sorted(instead)) in twins), (text, instead, line.said)


# Where more than one reason does give a step.
LICENSED = {
    ("p1-symmetry", "= J1' I1 J1 + J2' I2 J2"): {("semidefinite inertias",)},
    ("p2-E", "= qd' u"): {("Christoffel symbols",)},
    ("p5-E", "= qd' (u - f)"): {("Christoffel symbols",)},
}


@EVERY
def test_one_line_with_two_reasons_is_never_the_whole(id, undiagnosed):
    """Else a proof could be one step."""
    names = DERIVATIONS[id].reason_names
    goal, relation = DERIVATIONS[id].goal, DERIVATIONS[id].relation
    for i, one in enumerate(names):
        for other in names[i:]:
            found = marked(id, [(f"{relation} {goal}", *{one, other})])
            assert not found.done, (one, other)
            assert not found.earned


SKEW = "(Mdot - 2 C) + (Mdot - 2 C)'"
IN_ONE_GO = {
    "the start repeated": ("p2-skew", (SKEW,), ("= 0", "Christoffel symbols")),
    "a line repeated": ("p2-skew", (f"= {SKEW}", "algebra"), ("= 0", "Christoffel symbols")),
    "the start written in another way": (
        "p2-skew",
        ("= Mdot + Mdot' - 2 C - 2 C'", "algebra"),
        ("= 0", "Christoffel symbols"),
    ),
    "the end repeated": (
        "p1-symmetry",
        ("= M", "M from the links", "symmetric inertias"),
        ("= 1 M", "algebra"),
        ("= M", "algebra"),
    ),
    "names of no fact": (
        "p1-symmetry",
        ("= M' + 0 M", "algebra"),
        ("= M' + 0 J1' I1 J1", "algebra"),
        ("= M", "M from the links", "symmetric inertias"),
    ),
}


@pytest.mark.parametrize(("id", "lines"), [(id, lines) for id, *lines in IN_ONE_GO.values()],
                         ids=IN_ONE_GO)  # fmt: skip
def test_lines_that_add_nothing_do_not_make_a_proof_of_one_step(id, lines):
    found = marked(id, lines)
    assert all(line.holds for line in found.lines)
    assert not found.done
    assert not found.earned
    assert found.still.startswith("The end is reached in one go: show why")


@EVERY
def test_hints_are_three_and_give_no_line_away(id):
    hints = DERIVATIONS[id].hints
    assert len(hints) == 3
    for text, *_ in models()[id]:
        after = text.rpartition("=")[2].strip(" >0")
        assert len(after) < 8 or not any(after in hint for hint in hints)
