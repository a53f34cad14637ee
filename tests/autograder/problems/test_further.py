"""What a card leads on to: a section of a lesson, and after a right answer a sentence that is true."""

import json
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import scipy.special

from autograder.problems import CHECKS
from autograder.problems.material.conventions import FAMILY
from autograder.problems.material.planar_2r import changed
from autograder.problems.p1_inertia.mistakes import EXAMPLE

ROOT = Path(__file__).parents[3]
LINK = re.compile(r"\[([^\]]+)\]\(\.\./\.\./lessons/([\w-]+)\.ipynb#cell-id=([\w-]+)\)")
WITH_SECTION = [id for id, check in CHECKS.items() if check.section]


@cache
def cells(path: Path) -> list[dict]:
    return json.loads(path.read_text(encoding="utf-8"))["cells"]


def plain(heading: str) -> str:
    """A heading without the signs of a formula."""
    return re.sub(r"[${}\\]", "", heading.replace(r"\ne", "≠").replace(r"\dot q", "q̇"))


@cache
def prepared_by() -> dict[str, tuple[str, str, str]]:
    """check → heading, lesson and cell that its part of the problem links to."""
    found, link = {}, None
    for path in sorted((ROOT / "solutions").glob("*/*.ipynb")):
        for cell in cells(path):
            source = "".join(cell["source"])
            if cell["cell_type"] == "markdown" and (match := LINK.search(source)):
                link = match.groups()
            of_nbgrader = cell["metadata"].get("nbgrader", {})
            if of_nbgrader.get("grade") and of_nbgrader["grade_id"] in CHECKS:
                assert link is not None
                found[of_nbgrader["grade_id"]] = link
    return found


def test_each_graded_check_of_a_problem_has_both():
    assert set(WITH_SECTION) == set(prepared_by()), (
        "each graded check has a section, and its part of the notebook a link to it (and no other has)"
    )
    assert [id for id, check in CHECKS.items() if not check.further] == []


@pytest.mark.parametrize("id", WITH_SECTION)
def test_the_section_is_the_one_that_the_problem_links_and_is_there(id):
    section = CHECKS[id].section
    heading, lesson, cell = prepared_by()[id]
    assert (section.lesson, section.cell) == (lesson, cell)
    assert plain(section.heading) == plain(heading)
    path = ROOT / "lessons" / section.file
    # A link may lead to a cell below the heading, where the section's own matter begins.
    headings = {}
    for one in cells(path):
        for line in "".join(one["source"]).splitlines():
            if one["cell_type"] == "markdown" and re.match("#+ ", line):
                headings[plain(re.sub("^#+ ", "", line))] = one["id"]
    assert plain(section.heading) in headings
    assert section.cell in [one["id"] for one in cells(path)]


def test_sentences_are_different_short_and_not_formulas():
    said = [check.further for check in CHECKS.values()]
    assert len(set(said)) == len(said)
    for sentence in said:
        assert sentence[-1] == "."
        assert len(sentence) < 200
        assert "$" not in sentence


Q, QD = np.array([0.4, -1.1]), np.array([0.9, -0.7])


def turned(own, angle: float) -> np.ndarray:
    """Q with the whole arm turned like one rigid body."""
    return own.angles_at(own.directions(Q) + angle)


@pytest.mark.parametrize("own", FAMILY, ids=lambda own: own.name)
def test_what_is_said_of_an_arm_is_true_of_each_member(own):
    # M depends on the angle between the links alone, and gravity would notice.
    np.testing.assert_allclose(own.M(turned(own, 0.6), EXAMPLE), own.M(Q, EXAMPLE))
    bent = own.angles_at(own.directions(Q) + np.array([0, 0.6]))
    assert not np.allclose(own.M(bent, EXAMPLE), own.M(Q, EXAMPLE))
    assert not np.allclose(own.g_vec(turned(own, 0.6), EXAMPLE), own.g_vec(Q, EXAMPLE))
    # Ṁ is 0 while the arm turns like one body, and where the links are in line.
    as_one = own.angles_at(np.array([1.0, 1.0])) - own.angles_at(np.zeros(2))
    assert not np.any(own.M_dot(Q, as_one, EXAMPLE).round(12))
    in_line = own.angles_at(np.array([0.7, 0.7]))
    assert not np.any(own.M_dot(in_line, QD, EXAMPLE).round(12))
    assert np.any(own.M_dot(Q, QD, EXAMPLE).round(3))
    # C is linear in q̇.
    np.testing.assert_allclose(own.C(Q, 2 * QD, EXAMPLE), 2 * own.C(Q, QD, EXAMPLE))

    def P(first, second):
        return own.potential_energy(own.angles_at(np.array([first, second])), EXAMPLE)

    # P has one part for each link's direction.
    assert P(0.3, 1.2) - P(0.3, 0.1) == pytest.approx(P(2.0, 1.2) - P(2.0, 0.1))
    assert len(own.equilibria()) == 2**2


def test_a_wide_swing_takes_18_percent_longer():
    period = 2 / np.pi * scipy.special.ellipk(np.sin(np.pi / 4) ** 2)
    assert round(100 * (period - 1)) == 18


def test_cholesky_alone_reads_one_triangle():
    np.linalg.cholesky(np.array([[2.0, 7.0], [0.5, 2.0]]))


def test_no_mass_and_no_inertia_stands_in_the_regressor():
    regressor = CHECKS["c6-regressor"].reference
    other = changed(EXAMPLE, m1=9.0, m2=0.3, I1=2.0, I2=3.0, lc1=0.1, lc2=0.2)
    np.testing.assert_array_equal(regressor(Q, QD, QD, other), regressor(Q, QD, QD, EXAMPLE))
