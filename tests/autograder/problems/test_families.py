"""Every member of the family of planar arms: one arm in other words, and judged as what it is."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from autograder.judging.check import HIDDEN_CASES
from autograder.judging.verdict import State
from autograder.mutation.references import reference
from autograder.problems import CHECKS, PROBLEMS_WITH_FAMILIES, arm_card, check_for
from autograder.problems.families import ASKED
from autograder.problems.material import planar_2r, sampling
from autograder.problems.material.conventions import BOOK, FAMILY, Convention, drawn, nearest_first
from autograder.problems.material.given import code
from autograder.protocol import Reply, read, real

OF_THE_ARM = (*ASKED, "p1-singular_arm", "p2-C_other", "p4-equilibria")
OF_PROBLEMS = [id for id in CHECKS if id.partition("-")[0] in PROBLEMS_WITH_FAMILIES]
members = pytest.mark.parametrize("own", FAMILY, ids=lambda own: own.name)
others = pytest.mark.parametrize(
    "own", [own for own in FAMILY if own != BOOK], ids=lambda own: own.name
)


def verdict(id, own, answer, cases=6):
    """Of a function that gives `answer` for the arguments of the student's."""

    def ask(calls):
        return [Reply(value=read(call, answer(*map(real, call.args)))) for call in calls]

    return check_for(id, own).run(ask, np.random.default_rng(7), cases)


def state():
    rng = np.random.default_rng(11)
    return sampling.planar_2r(rng, friction=True), sampling.angles(rng), sampling.velocities(rng)


def test_there_are_enough_and_the_book_is_one_of_them():
    assert len(set(FAMILY)) == len({own.facts for own in FAMILY}) == 16
    assert BOOK in FAMILY


@members
def test_the_closed_forms_are_those_of_the_energies(own):
    arm, q, qd = state()
    for answer, args in (("M", (q, arm)), ("C", (q, qd, arm)), ("g_vec", (q, arm))):
        expected = reference(own.mechanism, answer)(*args)
        np.testing.assert_allclose(getattr(own, answer)(*args), expected, rtol=1e-9, atol=1e-12)
    P = reference(own.mechanism, "potential_energy")(q, arm)
    assert own.potential_energy(q, arm) == pytest.approx(float(P))
    step = 1e-6 * qd
    slope = (own.M(q + step, arm) - own.M(q - step, arm)) / 2e-6
    np.testing.assert_allclose(own.M_dot(q, qd, arm), slope, atol=1e-7)
    np.testing.assert_allclose(own.joints(q, arm), own.mechanism.points(q, arm), atol=1e-12)


def test_the_book_is_the_arm_of_the_problems():
    arm, q, qd = state()
    for answer, args in (("M", (q, arm)), ("C", (q, qd, arm)), ("M_dot", (q, qd, arm)),
                         ("g_vec", (q, arm)), ("potential_energy", (q, arm))):  # fmt: skip
        expected = getattr(planar_2r, answer)(*args)
        np.testing.assert_allclose(getattr(BOOK, answer)(*args), expected, atol=1e-12)


@members
def test_what_a_problem_gives_is_right_for_the_member(own):
    arm, q, qd = state()
    given = own.own_arm(code(own, "p5"))
    np.testing.assert_allclose(given.M(q, arm), own.M(q, arm), atol=1e-12)
    np.testing.assert_allclose(given.C(q, qd, arm), own.C(q, qd, arm), atol=1e-12)
    np.testing.assert_allclose(given.g_vec(q, arm), own.g_vec(q, arm), atol=1e-12)
    np.testing.assert_allclose(given.angles(given.directions(q)), q)
    np.testing.assert_allclose([own.g_vec(q, arm) for q in own.equilibria()], 0, atol=1e-12)
    # Power of gravity from the heights of the hand: the vector pulls where P falls.
    masses = SimpleNamespace(**vars(arm) | {"m1": 0.0, "lc2": arm.l2})
    low, high = (np.array(own.joints(at, arm)[-1]) for at in (q - 1e-6 * qd, q + 1e-6 * qd))
    work = arm.m2 * given.gravity(arm.g)[:2] @ (high - low) / 2e-6
    assert work == pytest.approx(-own.g_vec(q, masses) @ qd, rel=1e-6)


def test_a_problem_gives_no_other_function():
    given = BOOK.own_arm(code(BOOK, "p2"))
    with pytest.raises(AttributeError, match="this problem gives no C; it gives M"):
        given.C  # noqa: B018


@members
@pytest.mark.parametrize("id", OF_PROBLEMS)
def test_the_right_answer_of_the_member_is_correct(own, id):
    check = check_for(id, own)
    plain = CHECKS[id]
    assert check.id == plain.id
    assert check.signature == plain.signature
    assert [c.share for c in check.criteria] == [c.share for c in plain.criteria]
    if id in OF_THE_ARM:
        assert verdict(id, own, check.reference).state is State.CORRECT
    else:
        assert check == plain


@pytest.mark.parametrize("id", [id for id in ASKED if id != "p5-energy_drift"])
def test_the_links_stand_as_in_the_check_of_the_book(id):
    """So that no sine or cosine of theirs nearly vanishes, and each arm is at rest where one is."""
    own = Convention("crossed", "hanging")
    plain, moved = (
        [call.args[0] for call in check_for(id, one).calls(np.random.default_rng(3), 6)]
        for one in (None, own)
    )
    np.testing.assert_allclose(
        own.directions([x[:2] for x in moved]), BOOK.directions([x[:2] for x in plain]), atol=1e-12
    )
    np.testing.assert_array_equal([x[2:] for x in moved], [x[2:] for x in plain])


@pytest.mark.parametrize("id", [id for id in OF_THE_ARM if id not in ("p1-singular_arm", "p5-f")])
def test_a_copied_answer_is_named_for_what_it_is(id):
    """Of each member, what is right for one that shares most with it and for one that shares least."""
    for own in (BOOK, *FAMILY[1::3]):
        for other in (nearest_first(own)[0], nearest_first(own)[-1]):
            copied = verdict(id, own, check_for(id, other).reference)
            said = copied.diagnosis[:1]
            if id == "p4-equilibria" and said and said[0].startswith("At your configurations"):
                continue  # others leave the same torques
            if copied.state is not State.CORRECT and id != "p5-energy_drift":
                assert copied.diagnosis[0].startswith("Your answer is right for an arm wh"), own
                assert "Yours is another" in copied.diagnosis[0]


def test_it_says_how_the_other_arm_differs():
    own = Convention("relative", "level")
    said = verdict("p1-M", own, Convention("absolute").M).diagnosis
    assert said == (
        "Your answer is right for an arm whose q2 is measured from the x axis. Yours is another: look "
        "at the table and the picture below the set-up cell.",
    )
    other = Convention("absolute", "hanging", slope=True)
    (said,) = verdict("p4-g_vec", own, other.g_vec).diagnosis
    assert (
        "whose q1 is measured from the −y axis and q2 is measured from the −y axis, where" in said
    )
    assert "where gravity pulls at 30° to the −y axis, towards the x axis." in said


def test_a_drift_with_the_weights_of_another_arm_is_named():
    own, other = Convention("absolute"), BOOK

    def mixed(x, arm):
        E = [
            0.5 * row[2:] @ own.M(row[:2], arm) @ row[2:] + other.potential_energy(row[:2], arm)
            for row in x
        ]
        return np.array(E) - E[0]

    (said,) = verdict("p5-energy_drift", own, mixed).diagnosis
    assert said.startswith(
        "Your P is right for an arm whose q2 is measured from the line of link 1."
    )


def rate(own, sign):
    def f(x, u, arm):
        q, qd = x[:2], x[2:]
        torque = u - own.C(q, qd, arm) @ qd - sign * own.g_vec(q, arm) - planar_2r.f_vec(qd, arm)
        return np.concatenate([qd, np.linalg.solve(own.M(q, arm), torque)])

    return f


def without_P(own):
    def drift(x, arm):
        K = np.array([0.5 * row[2:] @ own.M(row[:2], arm) @ row[2:] for row in x])
        return K - K[0]

    return drift


def without_I2(own):
    return lambda q, arm: own.M(q, planar_2r.changed(arm, I2=0.0))


@pytest.mark.parametrize(
    ("id", "answer"),
    [
        ("p1-M", without_I2),
        ("p4-g_vec", lambda own: lambda q, arm: -own.g_vec(q, arm)),
        ("p2-C", lambda own: lambda q, qd, arm: own.C(q, qd, arm).T),
        ("p2-M_dot", lambda own: own.C),
        ("p5-f", lambda own: rate(own, sign=-1.0)),
        ("p5-energy_drift", lambda own: without_P(own)),
    ],
)
@pytest.mark.parametrize("own", [FAMILY[5], FAMILY[-1]], ids=lambda own: own.name)
def test_mistakes_of_a_member_follow_from_its_energies(own, id, answer):
    found = verdict(id, own, answer(own))
    assert found.diagnosis
    assert not found.diagnosis[0].startswith("Your answer is right for")
    assert not found.diagnosis[0].startswith("With your C the matrix")


def test_part_of_a_drawn_answer_is_projected_on_the_terms_of_the_member():
    own = Convention("absolute", "hanging")

    def heavier(q, arm):
        extra = own.M(q, planar_2r.changed(arm, I1=0.0, I2=0.0, m1=0.0, l1=0.0))
        return own.M(q, arm) + 0.37 * extra

    (said, *_) = verdict("p1-M", own, heavier, HIDDEN_CASES).diagnosis
    assert "the centre of mass of link 2 about the elbow" in said


@members
def test_arms_that_cannot_be_simulated_are_told_in_every_member(own):
    arm = {"l1": 1, "l2": 1, "lc1": 0, "lc2": 0.5, "m1": 1, "m2": 1, "I1": 0, "I2": 0, "g": 9.81}
    folded, bent = own.angles_at([0.3, 0.3 + np.pi]), own.angles_at([0.3, 1.5])
    assert verdict("p1-singular_arm", own, lambda: (arm, folded)).state is State.CORRECT
    found = verdict("p1-singular_arm", own, lambda: (arm, bent))
    assert found.state is not State.CORRECT
    assert found.diagnosis


# What is true of the arm of the book alone.
BOOK_ALONE = re.compile(
    r"q1 \+ q2|q2 is measured from link 1|angle from link 1|cos q2|∂q2|M changes with q2|"
    r"straight up|level|C11|h, −h|q̇1 q̇2 (in|between)"
)


@others
@pytest.mark.parametrize("id", OF_THE_ARM)
def test_no_hint_or_sentence_is_true_of_the_arm_of_the_book_alone(own, id):
    check = check_for(id, own)
    said = [
        *check.hints,
        *(s.text for c in check.criteria for s in c.said),
        *(c.text for c in check.criteria),
    ]
    said += [
        mistake.sentence for mistake in check.mistakes if "Yours is another" not in mistake.sentence
    ]
    assert [text for text in said if BOOK_ALONE.search(text)] == []
    assert len(check.hints) == 3
    written = {mistake.sentence for mistake in CHECKS[id].mistakes}
    if id not in ("p1-singular_arm", "p4-equilibria"):  # what these share is true of every member
        assert written.isdisjoint(mistake.sentence for mistake in check.mistakes)


def test_what_is_true_of_the_book_alone_is_found():
    said = [hint for id in OF_THE_ARM for hint in CHECKS[id].hints]
    assert len([hint for hint in said if BOOK_ALONE.search(hint)]) >= 8


def test_the_arm_is_drawn_from_the_name_alone():
    assert drawn("ada", 2026) == drawn("  ADA ", 2026) == drawn("ada", 2026)
    assert all(
        drawn("maria lopez", year) == drawn("Maria  Lopez\t", year) for year in range(2020, 2030)
    )
    names = [f"s{number}" for number in range(400)]
    counts = {own: sum(drawn(name, 2026) == own for name in names) for own in FAMILY}
    assert min(counts.values()) >= 8  # 25 on average
    assert any(drawn(name, 2026) != drawn(name, 2027) for name in names[:5])


@members
def test_the_card_says_all_and_holds_nothing_that_runs(own):
    arm = SimpleNamespace(l1=0.45, lc1=0.2, m1=2.4, I1=0.045, g=9.81, coulomb=np.array([0.4, 0.25]))
    shown = arm_card.mimebundle(own, "the arm of <b>&", arm, code(own, "p5"))
    for text in (*own.zero_at, "0.45 m", "0.2 m", "2.4 kg", "0.045 kg·m²", "9.81 m/s²", "N·m"):
        assert text in shown["text/plain"]
        assert text in shown["text/html"]
    assert "<b>" not in shown["text/html"]
    assert ("<svg" in shown["text/html"]) == (own != BOOK)
