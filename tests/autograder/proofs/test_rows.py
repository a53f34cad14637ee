"""A row of the table is earned by lines that show what it names, and by no others of the same value."""

import pytest

from tests.autograder.proofs.models import marked, models

BALANCE = list(models()["p2-E"])
POSITIVE = list(models()["p1-positive"])
WEIGHT = list(models()["p4-P"])


def rows(id: str, lines) -> list[int]:
    return [row.number for row in marked(id, lines).earned]


def test_rows_are_earned_up_to_the_first_wrong_line():
    assert [rows("p2-E", BALANCE[:at]) for at in range(1, 9)] == [
        *([[]] * 4), [1], [1], [1, 2], [1, 2],
    ]  # fmt: skip
    wrong = [BALANCE[0], ("= d/dt(1/2 qd' M qd) + Pdot", "chain rule"), *BALANCE[2:]]
    assert rows("p2-E", wrong) == []


@pytest.mark.parametrize(
    "formed",
    [
        "qd' u + 1/2 qd' (Mdot - 2 C) qd",
        "qd' u - qd' (C - Mdot/2) qd",
        r"\dot q^T u + \tfrac12 \dot q^T (\dot M - 2C) \dot q",
        "qd' (u + (1/2 Mdot - C) qd)",
        "u' qd + 1/2 qd' (Mdot' - 2 C') qd",
    ],
)
def test_the_matrix_is_formed_in_any_dress(formed):
    assert rows("p2-E", [*BALANCE[:6], (f"= {formed}", "algebra")]) == [1, 2]


@pytest.mark.parametrize(
    "unformed",
    [
        "qd' (u - C qd - g) + 1/2 qd' Mdot qd + qd' g",
        "qd' u + 1/2 qd' Mdot qd - qd' C qd",
        "qd' (u + 1/2 Mdot qd - C qd)",
        "qd' u + 1/2 qd' Mdot qd - qd' C qd + 0 qd' (Mdot - 2 C) qd",
        "qd' u + qd' (Mdot - 2 C) qd - 1/2 qd' Mdot qd + qd' C qd",
    ],
)
def test_the_same_value_does_not_form_it(unformed):
    lines = [*BALANCE[:6], (f"= {unformed}", "algebra")]
    assert rows("p2-E", lines) == [1]
    found = marked("p2-E", [*lines, ("= qd' u", "skew-symmetry")])
    assert all(line.holds for line in found.lines)
    assert (found.done, [row.number for row in found.earned]) == (False, [1])
    assert "collected in one matrix (row 2 of the table)" in found.still


def test_christoffel_symbols_alone_do_not_show_what_is_left_of_the_energy():
    assert rows("p2-E", [*BALANCE[:6], ("= qd' u", "Christoffel symbols")]) == [1]


@pytest.mark.parametrize(
    "line",
    [
        "v1' I1 v1 + v2' I2 v2",
        "2 (1/2 v1' I1 v1 + v2' I2 v2 / 2)",
    ],
)
def test_the_energies_of_the_links_stand_there(line):
    assert rows("p1-positive", [*POSITIVE[:2], (f"= {line}", POSITIVE[2][1]), POSITIVE[3]]) == [2]


def test_a_sum_of_matrices_is_no_sum_of_energies():
    padded = ("= 1/2 qd' (2 J1' I1 J1 + 2 J2' I2 J2) qd", "algebra")
    found = marked("p1-positive", [POSITIVE[0], padded, POSITIVE[3]])
    assert all(line.holds for line in found.lines)
    assert (found.done, found.earned) == (False, ())
    assert "the energy of a link" in found.still
    grouped = ("= qd' J1' I1 J1 qd + (J2 qd)' I2 J2 qd", "algebra")
    assert rows("p1-positive", [POSITIVE[0], padded, grouped, POSITIVE[3]]) == [2]


@pytest.mark.parametrize(
    ("last", "shown"),
    [
        ("qd' (-m1 J1' g0 - m2 J2' g0)", True),
        ("-qd' (m1 J1' g0 + m2 J2' g0)", True),
        ("-m1 qd' J1' g0 - m2 qd' J2' g0", False),
    ],
)
def test_what_stands_behind_qd_is_in_one_bracket(last, shown):
    found = marked("p4-P", [*WEIGHT[:5], (f"= {last}", "algebra")])
    assert all(line.holds for line in found.lines)
    assert (found.done, [row.number for row in found.earned]) == (shown, [3] * shown)
    before = marked("p4-P", WEIGHT[:5])
    assert (before.done, before.earned) == (False, ())
    assert "all the rest in one bracket" in before.still


def test_an_end_that_is_only_worth_it_is_not_reached():
    first = ("= Mdot - (Mdot + W - W') + (Mdot - 2 C)'", "Christoffel symbols")
    second = ("= W' - W + (W' - W)'", "Christoffel symbols")
    found = marked("p2-skew", [first, second])
    assert all(line.holds for line in found.lines)
    assert (found.done, found.earned) == (False, ())
    assert found.still.endswith("Your last line still holds W.")
    assert marked("p2-skew", [first, second, ("= 0", "algebra")]).done
