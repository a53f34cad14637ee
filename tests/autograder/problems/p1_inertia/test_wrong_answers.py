"""Wrong answers about the inertia matrix: what is particular to them, and what no mistake explains."""

import json
from pathlib import Path

import numpy as np
import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.judging.verdict import State
from autograder.problems.material.definiteness import MATRICES, Kind, is_symmetric, least_eigenvalue
from autograder.problems.p1_inertia import mistakes as p1_inertia
from tests.autograder.problems.p1_inertia.table import BASE, LINKS, TABLE, arm
from tests.autograder.verdicts import judged, sentences

ROOT = Path(__file__).parents[4]


def test_worst_case_of_is_spd_is_a_matrix():
    for _, body, _ in TABLE["p1-is_spd"]:
        assert judged("p1-is_spd", body).witness.call.startswith("is_spd(np.array([[")


def test_worst_case_of_a_truth_value():
    verdict = judged("p1-is_spd", "True")
    asked = "(positive definite told from indefinite)"
    shown = " ".join(str(verdict).split())
    assert f"gave True; the right answer is False {asked}. The arguments" in shown
    shown = " ".join(str(verdict.without_inputs()).split())
    assert f"Worst case: your function gave True; the right answer is False {asked}." in shown


def test_the_example_arm_is_that_of_the_notebook():
    path = ROOT / "solutions" / "p1-inertia" / "p1-inertia.ipynb"
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    setup = next("".join(cell["source"]) for cell in cells if cell["id"] == "p1-setup")
    namespace = {}
    exec(setup, namespace)
    assert namespace["cutter"] == p1_inertia.EXAMPLE


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p1-M",
            arm("M11 -= 0.1 * m1 * lc1**2"),
            "In your M11, the centre of mass of link 1 about the shoulder comes out 10 % too small.",
        ),
        (
            "p1-M",
            arm("M12 += 0.5 * c", "M21 += 0.5 * c"),
            "In your M12 and M21, the coupling of the two links comes out 50 % too large.",
        ),
        (
            "p1-M",
            arm("M22 += 0.2 * I2"),
            "In your M22, the rotation of link 2 comes out 20 % too large.",
        ),
        (
            "p1-inertia_from_links",
            "sum(J.T @ I @ J + 0.5 * J[3:].T @ I[3:, 3:] @ J[3:] for J, I in zip(jacobians, inertias))"
            " if len(jacobians) > 1 else jacobians[0].T @ inertias[0] @ jacobians[0]",
            "In your matrix of several links, the translation of the links comes out 50 % too large.",
        ),
    ],
)
@pytest.mark.parametrize("count", [6, 24])
def test_unknown_error_is_placed_in_its_term(check_id, body, said, count):
    verdict = judged(check_id, body, count=count)
    assert verdict.diagnosis == (said,)


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p1-M", arm("M11 += np.cos(q2)")),
        ("p1-inertia_from_links", f"{LINKS} + 1"),
    ],
)
def test_unknown_error_is_not_diagnosed(check_id, body):
    for seed in range(20):
        verdict = judged(check_id, body, seed=seed, count=6)
        assert verdict.state is not State.CORRECT
        assert verdict.diagnosis == ()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ("M11 += np.sin(q1)", "In your M11, the values depend on q[0]; the right ones do not."),
        (
            "M22 *= 1 + 0.3 * np.sin(q2)",
            "In your M22, the values depend on q[1]; the right ones do not.",
        ),
        (
            "M22 = M22 / l2**2",
            "In your M22, the values depend on arm.l2; the right ones do not.",
        ),
        ("M21 += np.sin(q1)", "Your M12 and M21 differ from each other. Should they?"),
    ],
)
def test_what_an_unknown_error_depends_on_is_said(changes, said):
    assert judged("p1-M", arm(changes)).diagnosis == (said,)


def test_the_numbers_of_one_example_are_noticed():
    fixed = (
        "[[1.7 + 0.4 * np.cos(q[1]), 0.6 + 0.2 * np.cos(q[1])], [0.6 + 0.2 * np.cos(q[1]), 0.6]]"
    )
    said = judged("p1-M", fixed).diagnosis
    assert said == (
        "In your M11, the values do not depend on arm at all. Did you write the numbers of one example "
        "into the function?",
    )


def test_mistake_is_named_only_where_it_matches_to_rounding():
    (sentence,) = sentences("p1-M", "dropped / the rotation of link 1")
    close = arm(f"M11 -= I1 * (1 + {200 * TOLERANCE})")
    assert sentence not in judged("p1-M", close).diagnosis
    single = arm("M11 -= I1", "return np.float32([[M11, M12], [M21, M22]])")
    assert judged("p1-M", single).diagnosis == (sentence,)


def test_shapes_that_do_not_multiply_say_where():
    verdict = judged("p1-inertia_from_links", LINKS.replace("J.T @ I @ J", "J @ I @ J.T"))
    assert verdict.state is State.ERROR
    assert "matmul" in verdict.problem


@pytest.mark.parametrize(
    ("check_id", "returned", "problem"),
    [
        ("p1-inertia_from_links", "np.zeros((6, 6))", "it must return shape (3, 3)"),
        ("p1-M", "arm.I1", "it must return shape (2, 2)"),
        ("p1-is_spd", "np.linalg.eigvalsh(A)[0] * 0 + 0.7", "0.7; it must return True or False"),
        ("p1-is_spd", "np.linalg.eigvalsh(A) > 0", "it must return one, True or False"),
        ("p1-singular_arm", "np.zeros(9)", "it must return (arm, q), with arm a dict"),
        ("p1-singular_arm", "{'l1': 1.0}, [0, 0]", "an arm without l2, lc1, lc2, m1, m2, I1, I2"),
        ("p1-singular_arm", f"{BASE}, 0", "a q that is not two angles"),
        (
            "p1-singular_arm",
            f"{BASE | {'I1': [0, 0]}}, [0, 0]",
            "an arm whose I1 is not one number",
        ),
    ],
)
def test_answers_of_the_wrong_kind(check_id, returned, problem):
    verdict = judged(check_id, returned)
    assert verdict.state is State.ERROR
    assert problem in verdict.problem


def test_no_answer_that_is_always_the_same_earns_anything():
    for returned in ("True", "False"):
        assert judged("p1-is_spd", returned).credit == 0


@pytest.mark.parametrize("seed", range(200))
def test_the_matrices_are_what_they_are_said_to_be(seed):
    """Far from both limits, and such that each half of a test is fooled by some."""
    rng = np.random.default_rng(seed)
    skewed = []
    for kind, make in MATRICES:
        A = make(rng)
        gap = np.max(np.abs(A - A.T)) / np.max(np.abs(A))
        least = least_eigenvalue(A)
        assert is_symmetric(A) == (kind is not Kind.SKEWED)
        if kind is Kind.SKEWED:
            assert gap > 0.01
            skewed.append(A)
        elif kind is Kind.ROUNDED:
            assert 0 < gap < 1e-15
            assert least > 0.1
        else:
            assert gap == 0
            if kind is Kind.DEFINITE:
                assert least > 0.1
            elif kind in (Kind.INDEFINITE, Kind.NEGATIVE_DIAGONAL):
                assert least < -0.03
            else:
                assert abs(least) < 1e-14
    assert [np.linalg.eigvalsh(A)[0] > 0 for A in skewed] == [True, False, False, True]
    assert [np.all(np.linalg.eigvals(A).real > 0) for A in skewed] == [False, True, True, True]
    assert [least_eigenvalue(A) > 0 for A in skewed] == [False, False, True, True]
