"""What each answer to a lesson's check gets: the right ones, each known mistake, and anything else."""

import numpy as np
import pytest

from autograder.judging.check import Check
from autograder.judging.verdict import State, Verdict
from autograder.lesson_checks import checks_of
from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice
from autograder.lesson_checks.number import DEGREES, FACTORS, SIGN, Number
from autograder.student.lesson import verdict_on
from tests.autograder.lesson_checks.answers import NUMBERS, cell_of, filled, lesson, table

ANSWERS = {id: answers for number in NUMBERS for id, answers in table(number).items()}
CHECKS = {id: check for number in NUMBERS for id, check in checks_of(number).items()}


@pytest.fixture(scope="module")
def opened():
    """Each lesson's notebook, with what its first cell defines, by number."""
    found = {}
    for number in NUMBERS:
        notebook = lesson(number)
        first = next(cell for cell in notebook.cells if cell.cell_type == "code")
        namespace = {"__name__": "__main__"}
        exec(first.source, namespace)
        found[number] = notebook, namespace
    return found


@pytest.fixture
def verdict(opened):
    def of(id: str, typed: str) -> Verdict:
        """The verdict on an answer in the lesson's own cell."""
        notebook, first = opened[id[:2]]
        namespace = dict(first)
        namespace["check"] = lambda asked: asked == id or pytest.fail(f"{id} checks {asked}")
        exec(filled(cell_of(notebook, id).source, typed), namespace)
        return verdict_on(CHECKS[id], namespace)

    return of


def sentence_of(check: Number | Choice | Check, name: str) -> str:
    """What the check says of a mistake, or of a wrong option."""
    if isinstance(check, Choice):
        return check.by_letter[name].said
    mistakes = check.wrong if isinstance(check, Number) else check.mistakes
    return next(one.sentence for one in mistakes if one.name == name)


def names_of(check: Number | Choice | Check) -> set[str]:
    if isinstance(check, Choice):
        return {letter for letter, option in check.by_letter.items() if option.said}
    return {one.name for one in (check.wrong if isinstance(check, Number) else check.mistakes)}


def test_each_check_and_each_mistake_has_its_answers():
    assert ANSWERS.keys() == CHECKS.keys()
    for id, answers in ANSWERS.items():
        assert answers.right, id
        assert answers.wrong.keys() == names_of(CHECKS[id]), id
        assert answers.other or isinstance(CHECKS[id], Choice), id


@pytest.mark.parametrize("id", ANSWERS)
def test_right_answers_are_right(id, verdict):
    for typed in ANSWERS[id].right:
        found = verdict(id, typed)
        assert found.state is State.CORRECT, f"{typed}: {found}"
        assert (found.diagnosis, found.problem, found.next_step) == ((), "", "")
        assert found.further == CHECKS[id].further != ""


@pytest.mark.parametrize("id", ANSWERS)
def test_a_known_mistake_is_named_and_no_other(id, verdict):
    for name, typed in ANSWERS[id].wrong.items():
        found = verdict(id, typed)
        assert found.state is State.INCORRECT, f"{typed}: {found}"
        assert found.diagnosis == (sentence_of(CHECKS[id], name),), name


@pytest.mark.parametrize("id", [id for id in ANSWERS if ANSWERS[id].other])
def test_no_mistake_is_named_of_another_wrong_answer(id, verdict):
    known = {sentence_of(CHECKS[id], name) for name in names_of(CHECKS[id])}
    for typed in ANSWERS[id].other:
        found = verdict(id, typed)
        assert found.state is State.INCORRECT, f"{typed}: {found}"
        assert not known & set(found.diagnosis), typed
        if isinstance(CHECKS[id], Number):
            said = CHECKS[id].otherwise
            factors = (f"{factor} {said}" for _, factor in FACTORS)
            assert found.diagnosis[0] in (said, SIGN, DEGREES, *factors)


@pytest.mark.parametrize("id", ANSWERS)
def test_dots_are_no_attempt(id, verdict):
    found = verdict(id, "...")
    assert found.state is State.NOT_ATTEMPTED
    assert found.next_step == (
        "Type your answer in place of the three dots, then run this cell again."
    )


def test_the_arm_is_the_lessons(opened):
    for number, (_, namespace) in opened.items():
        if "arm" in namespace:
            own = {name: getattr(namespace["arm"], name) for name in vars(ARM)}
            assert own == vars(ARM), number


def test_the_numbers_of_lesson_02_are_those_of_euler_lagrange():
    """The input of a constant velocity, by differences of the momentum and of the energy."""

    def needed(M, q, qd, step=1e-5):
        q, qd = np.array(q), np.array(qd)
        momentum = [M(q + s * step * qd) @ qd for s in (-1, 1)]
        energies = [[qd @ M(q + s * e) @ qd / 2 for s in (-1, 1)] for e in step * np.eye(len(q))]
        return (np.subtract(*momentum[::-1]) - [b - a for a, b in energies]) / (2 * step)

    sliding = needed(lambda q: np.diag([0.7 + 2.0 * q[1] ** 2, 2.0]), [0.3, 0.6], [3.0, 0.4])
    assert np.isclose(CHECKS["02-slide"].right, sliding[1])
    other = next(w for w in CHECKS["02-slide"].wrong if w.name == "the other joint")
    assert np.isclose(other.number, sliding[0])
    cranked = needed(lambda q: np.array([[0.8 + 0.3 * np.sin(q[0])]]), [0.0], [8.0])
    assert np.isclose(CHECKS["02-crank"].right, cranked[0])


@pytest.mark.parametrize("typed", ["h @ qd", "(h @ qd) * qd"])
def test_a_matrix_is_no_torque(typed, verdict):
    found = verdict("02-torque", typed)
    assert found.state is State.ERROR
    assert "as C has; it must return shape" in found.problem


def test_the_numbers_of_lesson_03_are_the_models(opened):
    _, of = opened["03"]
    arm, checks = of["arm"], CHECKS
    spatial = of["rigid_inertia"](2.0, np.array([0.3, 0.0, 0.0]), np.diag([0.7, 0.9, 0.1]))
    velocity = np.array([0.0, 0.0, 2.0, 0.0, 1.0, 0.0])
    assert np.isclose(checks["03-energy"].right, velocity @ spatial @ velocity / 2)
    turned = np.linalg.qr(np.arange(4.0).reshape(2, 2) + 1).Q
    M = turned @ np.diag([checks["03-ellipse"].right, 0.32]) @ turned.T
    ellipse = of["plotting"].draw_inertia_ellipse(of["plotting"].figure()[1], M)
    sizes = np.linalg.norm(ellipse, axis=-1)
    assert np.allclose([sizes.max(), sizes.min()], [2.5, 0.4], rtol=1e-3)
    assert np.linalg.eigvalsh(arm.M([0.3, 0.0]))[0] > 0.1  # "03-hand": the stretched arm


def test_the_numbers_of_lesson_05_are_the_models(opened):
    """The right ones once more, by `armdyn` in place of a formula."""
    _, of = opened["05"]
    arm, checks = of["arm"], CHECKS
    pose = np.radians([50.0, -50.0])
    loaded = of["Planar2R"](
        **of["numbers"] | {"m2": 4.0, "lc2": (2.0 * 0.4 + 2.0 * 0.8) / 4.0}
    )  # link 2 and 2 kg in the hand
    assert np.isclose(checks["05-lever"].right, (loaded.g_vec(pose) - arm.g_vec(pose))[0])
    sagging = arm.g_vec(np.array([0.0, -np.radians(2)]))[1]
    assert np.isclose(checks["05-sag"].right, sagging / np.radians(2))

    def hessian(q, step=1e-5):
        turns = step * np.eye(2)
        return np.array([(arm.g_vec(q + d) - arm.g_vec(q - d)) / (2 * step) for d in turns])

    H = hessian(np.array([-np.pi / 2, np.pi]))
    for factor, stable in ((0.999, False), (1.001, True)):
        spring = np.diag([0.0, factor * checks["05-spring"].right])
        assert bool(np.all(np.linalg.eigvalsh(H + spring) > 0)) == stable


def test_the_number_of_lesson_04_is_the_models(opened):
    arm = opened["04"][1]["arm"]
    up, down = (arm.potential_energy([q1, 0.0]) for q1 in (np.pi / 2, -np.pi / 2))
    assert np.isclose(CHECKS["04-upright"].right, up - down)


def test_the_numbers_of_lesson_01_are_the_models(opened):
    of = opened["01"][1]
    arm = of["Planar2R"](**vars(ARM))
    q, qd = np.radians([30.0, 45.0]), np.array([-4.0, -6.0])
    assert np.isclose(CHECKS["01-twice"].right, (arm.C(q, qd) @ qd)[0])

    hangs = np.array([-np.pi / 2, 0.0])
    held = arm.g_vec(np.zeros(2))
    assert np.allclose(arm.g_vec(hangs), 0)
    # The program takes an angle from the x axis for one from hanging down.
    assert np.allclose(arm.g_vec(hangs + hangs), -held)
    assert np.allclose(held, [42.2, 7.8], atol=0.05)

    mass, radius = 2.0, 0.3
    ring = of["Pendulum"].from_com(m=mass, lc=radius, I_com=mass * radius**2)
    small = 1e-4
    right = -ring.dynamics([small], [0.0], [0.0])[0] / small
    wrong = mass * ring.g * radius / (mass * radius**2)
    assert np.isclose(CHECKS["01-ring"].right, np.sqrt(wrong / right))


def test_the_numbers_of_lesson_07_are_the_models(opened):
    of = opened["07"][1]
    arm, q, qd = of["arm"], np.array([0.0, np.pi / 2]), np.array([1.0, 2.0])
    step = 1e-6
    moved = of["plotting"].tip(arm, q + step * qd) - of["plotting"].tip(arm, q - step * qd)
    assert np.isclose(CHECKS["07-hand"].right, np.linalg.norm(moved) / (2 * step))

    # Link 2 and 1 kg in the hand as one body.
    centre = (2.0 * 0.4 + 1.0 * 0.8) / 3.0
    inertia = 0.11 + 2.0 * (centre - 0.4) ** 2 + 1.0 * (0.8 - centre) ** 2
    loaded = of["Planar2R"](**vars(ARM) | {"m2": 3.0, "lc2": centre, "I2": inertia})
    assert np.isclose(CHECKS["07-load"].right, (loaded.M(q) - arm.M(q))[0, 0])

    in_degrees = arm.kinetic_energy(q, np.radians([1.0, 0.0]))
    assert np.isclose(CHECKS["07-degrees"].right, 2 * in_degrees)
