"""What a marker gives, what a second one gives beside it, and what of it counts."""

import math
from dataclasses import replace

import pytest

from autograder.marking.asked import AskedError
from autograder.marking.desk import AGAIN, MARKED, TO_MARK, ChangedError, Desk
from autograder.marking.kept import COUNTS, FIRST, Kept, counting
from tests.autograder.marking.books import PROOF, Book

AT = {"assignment": "p3", "cell": "p3-proof"}


@pytest.fixture
def book():
    return Book()


@pytest.fixture
def kept(tmp_path):
    (tmp_path / "course").mkdir()
    return Kept(tmp_path)


@pytest.fixture
def first(book, kept):
    return Desk(book, kept)


@pytest.fixture
def second(book, kept):
    return Desk(book, kept, second=True)


def seen(desk, student):
    return desk.answer(**AT, id=f"id-{student}")


def give(desk, student, *given, total=None, comment="", act="save", **more):
    said = {**AT, "id": f"id-{student}", "version": seen(desk, student)["version"]}
    said |= {"given": list(given), "total": total, "comment": comment, **more}
    return getattr(desk, act)(said)


def choose(desk, student, which, total=None):
    found = desk.differences(**AT)["papers"]
    (version,) = (one["version"] for one in found if one["id"] == f"id-{student}")
    return desk.choose(
        {**AT, "id": f"id-{student}", "version": version, "which": which, "total": total}
    )


def test_ticked_rows_become_points_and_stay_ticked(first, book):
    told = give(first, "ada", 1.0, 0.5, comment="Look at $q$.\n\nAnd the sign.")
    assert told["state"] == MARKED
    assert told["comments"] == ["Look at $q$.", "And the sign."]
    assert (book.rows["ada"].by_hand, book.rows["ada"].to_read) == (1.5, False)
    shown = seen(first, "ada")
    assert (shown["given"], shown["points"]) == ([1.0, 0.5], 1.5)
    assert shown["comment"] == "Look at $q$.\n\nAnd the sign."
    assert shown["suggested"] == [1]


def test_the_list_counts_what_is_left(first):
    assert [(one["answers"], one["left"], one["blank"]) for one in first.proofs()] == [(3, 3, 1)]
    give(first, "bob", 0.0, 0.0)
    assert [one["left"] for one in first.proofs()] == [2]
    assert first.left() == ["p3: 2 of 3 answers"]
    for student in ("ada", "cem"):
        give(first, student, 0.0, 0.0)
    assert first.left() == []


def test_points_for_the_whole_stand_in_place_of_the_sum(first, book, kept):
    give(first, "ada", 1.0, 0.0, total=2.25)
    assert book.rows["ada"].by_hand == 2.25
    assert seen(first, "ada")["given"] == [1.0, 0.0]
    assert kept.of("p3", "p3-proof")["ada"][FIRST].points == 2.25


def test_an_answer_goes_back_to_those_to_be_marked(first, book):
    give(first, "ada", 1.0, 2.0)
    assert give(first, "ada", act="take_back")["state"] == TO_MARK
    assert (book.rows["ada"].by_hand, book.rows["ada"].to_read) == (None, True)


def test_a_changed_answer_is_marked_again_and_shows_what_it_had(first, book):
    give(first, "ada", 1.0, 0.0)
    book.rows["ada"] = replace(book.rows["ada"], to_read=True)
    shown = seen(first, "ada")
    assert (shown["state"], shown["given"]) == (AGAIN, [1.0, 0.0])


def test_points_from_elsewhere_have_no_rows(first, book):
    give(first, "ada", 1.0, 0.0)
    book.record(None, "ada", 3.0, "from the formgrader")
    shown = seen(first, "ada")
    assert (shown["given"], shown["points"], shown["comment"]) == (None, 3.0, "from the formgrader")


@pytest.mark.parametrize("given", [[1.0], [1.5, 0.0], [-0.1, 0.0], [math.nan, 0.0], ["1", 0.0],
                                   [True, 0.0], [math.inf, 0.0], None])  # fmt: skip
def test_rows_that_cannot_be_are_refused_and_nothing_is_saved(first, book, kept, given):
    said = {**AT, "id": "id-ada", "version": seen(first, "ada")["version"], "comment": ""}
    with pytest.raises(AskedError, match=r"takes 0 to 1 points|table of points has changed"):
        first.save(said | {"given": given})
    assert book.rows["ada"].to_read
    assert kept.of("p3", "p3-proof") == {}


@pytest.mark.parametrize("total", [3.5, -1, "3", math.nan])
def test_a_total_that_cannot_be_is_refused(first, total):
    with pytest.raises(AskedError, match="The whole answer takes 0 to 3 points"):
        give(first, "ada", 0.0, 0.0, total=total)


def test_what_somebody_else_saved_meanwhile_is_not_written_over(first, book):
    version = seen(first, "ada")["version"]
    book.record(None, "ada", 3.0, "in the formgrader")
    with pytest.raises(ChangedError, match="nothing was saved"):
        first.save({**AT, "id": "id-ada", "version": version, "given": [0, 0], "comment": ""})
    assert book.rows["ada"].by_hand == 3.0


@pytest.mark.parametrize("by", ["first", "second"])
def test_no_points_are_given_to_what_was_handed_in_since_the_marker_read_it(
    by, request, book, kept
):
    desk = request.getfixturevalue(by)
    said = {**AT, "id": "id-ada", "version": seen(desk, "ada")["version"], "given": [1, 2]}
    book.text = "By Lagrange."
    with pytest.raises(ChangedError, match="handed in again"):
        desk.save(said | {"comment": ""})
    assert book.rows["ada"].to_read
    assert kept.of("p3", "p3-proof") == {}


def test_a_second_marker_sees_nothing_of_the_first_and_changes_no_score(first, second, book):
    give(first, "ada", 1.0, 2.0, comment="Fine.")
    shown = seen(second, "ada")
    assert (shown["given"], shown["points"], shown["comment"]) == (None, None, "")
    assert shown["state"] == TO_MARK
    assert second.proof(**AT)["comments"] == []
    give(second, "ada", 0.0, 2.0, comment="No reason.")
    assert (book.rows["ada"].by_hand, book.rows["ada"].comment) == (3.0, "Fine.")
    assert [one["left"] for one in second.proofs()] == [2]
    assert seen(first, "ada")["comment"] == "Fine."
    with pytest.raises(AskedError, match="does not see"):
        second.differences(**AT)


def test_what_two_markers_differ_in_is_listed_the_most_first(first, second):
    for student, mine, theirs in (("ada", 1, 1), ("bob", 0, 2), ("cem", 1, 0)):
        give(first, student, mine, 0)
        give(second, student, 0, theirs)
    found = first.differences(**AT)["papers"]
    assert [(one["number"], one["first"], one["second"], one["rows"]) for one in found] == [
        (2, 0.0, 2.0, [2]),
        (3, 1.0, 0.0, [1]),
        (1, 1.0, 1.0, [1, 2]),
    ]
    assert [one["apart"] for one in first.proofs()] == [2]


@pytest.mark.parametrize(
    ("which", "total", "points", "comment"),
    [("first", None, 1.0, "Mine."), ("second", None, 2.0, "Theirs."), ("other", 1.5, 1.5, "Mine.")],
)
def test_the_choice_counts(first, second, book, kept, which, total, points, comment):
    give(first, "ada", 1.0, 0.0, comment="Mine.")
    give(second, "ada", 0.0, 2.0, comment="Theirs.")
    assert choose(first, "ada", which, total) == {"counts": points}
    assert (book.rows["ada"].by_hand, book.rows["ada"].comment) == (points, comment)
    (found,) = first.differences(**AT)["papers"]
    assert (found["first"], found["second"], found["counts"]) == (1.0, 2.0, points)
    assert [one["apart"] for one in first.proofs()] == [0]
    entry = kept.of("p3", "p3-proof")["ada"]
    assert counting(entry, points) == entry[COUNTS]


def test_who_marks_again_opens_the_choice_again(first, second):
    give(first, "ada", 1.0, 0.0)
    give(second, "ada", 0.0, 2.0)
    choose(first, "ada", "second")
    give(first, "ada", 0.0, 0.0)
    (found,) = first.differences(**AT)["papers"]
    assert (found["first"], found["counts"]) == (0.0, None)


def test_a_first_mark_from_the_formgrader_is_compared_too(first, second, book):
    book.record(None, "ada", 3.0, "")
    give(second, "ada", 1.0, 0.0)
    (found,) = first.differences(**AT)["papers"]
    assert (found["first"], found["second"], found["rows"]) == (3.0, 1.0, [])


def test_nothing_can_be_chosen_before_two_have_marked(first):
    give(first, "ada", 1.0, 0.0)
    said = {**AT, "id": "id-ada", "version": seen(first, "ada")["version"], "which": "second"}
    with pytest.raises(AskedError, match="two people have to mark"):
        first.choose(said)


def test_points_that_nobody_typed_are_no_zero(first, second, book, monkeypatch):
    give(first, "ada", 1.0, 0.0)
    give(second, "ada", 0.0, 0.0)
    with pytest.raises(AskedError, match="Type the points"):
        choose(first, "ada", "other")
    bare = replace(PROOF, rubric=replace(PROOF.rubric, rows=()))
    monkeypatch.setattr(book, "proofs", lambda: [bare])
    with pytest.raises(AskedError, match="Type the points"):
        give(first, "bob")
    assert (book.rows["ada"].by_hand, book.rows["bob"].by_hand) == (1.0, None)


def test_names_are_hidden_unless_they_are_asked_for(book, kept):
    assert seen(Desk(book, kept), "ada")["student"] == ""
    assert seen(Desk(book, kept, names=True), "ada")["student"] == "Ada"


@pytest.mark.parametrize("at", [{"assignment": "p9"}, {"cell": "p9"}])
def test_an_answer_that_is_not_there_is_named(first, at):
    with pytest.raises(AskedError, match="p9"):
        first.proof(**(AT | at))
