"""A student's package says the same of every answer as the course's, to the letter of the card."""

import json
from pathlib import Path

import pytest

from autograder.bundle.left_to_grader import WHY, why_left_out
from autograder.lesson_checks import numbers
from autograder.problems import CHECKS
from autograder.problems.families import OF_THE_ARM
from autograder.problems.material.conventions import FAMILY
from tests.autograder.bundle import judged
from tests.autograder.lesson_checks.answers import cell_of, filled, lesson, table
from tests.autograder.problems.tables import ROWS, gathered
from tests.autograder.verdicts import function_of
from tests.submissions.own_arms import _functions

LEFT_OUT = {id for id, check in CHECKS.items() if why_left_out(check)}
CHILD = str(Path(judged.__file__))


def task(id, code, arm=""):
    return {"id": id, "code": code, "arm": arm}


def of_problems():
    """Every answer of the problems' tables: right, wrong in a known way, in another way, and none."""
    bodies = [(row.check, row.body) for row in ROWS]
    for kind, names in (
        ("right", ("RIGHT", "DELICATE")),
        ("unknown", ("TRACED", "UNEXPLAINED", "NEARLY", "UNFIT")),
    ):
        for name in names:
            for id, entries in gathered(kind, name).items():
                bodies += [(id, own if isinstance(own, str) else own[0]) for own in entries
                           if isinstance(own, str | tuple | list)]  # fmt: skip
    return [task(id, function_of(id, body)) for id, body in bodies if id not in LEFT_OUT]


def of_lessons():
    found = []
    for number in numbers():
        for id, answers in table(number).items():
            typed = [*answers.right, *answers.wrong.values(), *answers.other, "..."]
            first = next(cell for cell in lesson(number).cells if cell.cell_type == "code").source
            source = cell_of(lesson(number), id).source.split("\ncheck(")[0]
            found += [task(id, f"{first}\n{filled(source, one)}") for one in typed]
    return found


def of_arms():
    """What is right for each arm, for the next one, and what is wrong for all."""
    found = []
    for own, other in zip(FAMILY, [*FAMILY[1:], FAMILY[0]], strict=True):
        mine, theirs = _functions(own), _functions(other)
        for id in OF_THE_ARM:
            name = CHECKS[id].name
            if id in LEFT_OUT or name not in mine:
                continue
            given = "\n\n".join(mine[needed] for needed in ("M", "C", "g_vec"))
            for functions in (mine, theirs):
                found.append(task(id, f"{given}\n\n{functions[name]}", own.name))
    wrong = [row for row in ROWS if row.check in OF_THE_ARM and row.check not in LEFT_OUT]
    return found + [
        task(row.check, function_of(row.check, row.body), FAMILY[place % len(FAMILY)].name)
        for place, row in enumerate(wrong)
    ]


def apart(installed, tasks) -> list:
    """The tasks of which the two packages do not say the same."""
    done = installed.run(CHILD, input=json.dumps(tasks), env={"PYTHONWARNINGS": "ignore"})
    theirs = json.loads(done.stdout)
    assert len(theirs) == len(tasks) > 0
    return [
        (one, mine, their)
        for one, their in zip(tasks, theirs, strict=True)
        if (mine := judged.judged(one)) != their
    ]


@pytest.fixture(autouse=True)
def patient(monkeypatch):
    for module, name in (("protocol.calls", "CALL_SECONDS"), ("student.cell", "SLOW")):
        monkeypatch.setattr(f"autograder.{module}.{name}", 60.0)
    monkeypatch.setattr("autograder.judging.check.SLOW", judged.SLOW)
    monkeypatch.setattr("autograder.student.cell.SLOW", judged.SLOW)


KINDS = {"problems": of_problems, "lessons": of_lessons, "arms": of_arms}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "part", [pytest.param(12, id="some"), pytest.param(1, id="all", marks=pytest.mark.long)]
)
def test_verdicts_and_cards_are_the_same(installed, kind, part):
    tasks = KINDS[kind]()[::part]
    assert not apart(installed, tasks)


def left_to_grader(installed, answers):
    """What the cards say of these answers to checks that are left to the grader."""
    done = installed.run(CHILD, input=json.dumps([task(id, code) for id, code in answers]))
    return [shown.replace("\n  ", " ") for _, shown, _ in json.loads(done.stdout)]


def test_what_is_left_to_the_grader_says_so(installed):
    """Each of them, and no other check."""
    bodies = dict.fromkeys(CHECKS, "None") | FORMED
    tasks = [task(id, function_of(id, body)) for id, body in bodies.items()]
    done = installed.run(CHILD, input=json.dumps(tasks))
    said = {
        one["id"]: shown for one, (_, shown, _) in zip(tasks, json.loads(done.stdout), strict=True)
    }
    left = {id for id, shown in said.items() if "judged when you hand it in" in shown}
    assert left == LEFT_OUT == {*WHY, "c8-gravity_compensation", "c8-slotine_li"}
    for id in left:
        assert "not in this package" in said[id].replace("\n  ", " ")


# An answer of the right form to each check that is left to the grader, right or wrong.
ARM = "dict.fromkeys(('l1', 'l2', 'lc1', 'lc2', 'm1', 'm2', 'I1', 'I2', 'g'), 1.0)"
FORMED = {
    "p1-singular_arm": f"({ARM}, [0.0, 1.0])",
    "p4-equilibria": "[[0.0, 0.0], [1.0, 0.0]]",
    "c8-gravity_compensation": "[0.0, 1.0]",
    "c8-slotine_li": "np.zeros(8)",
}


UNFIT = {
    "None": "returned None. Is the return statement missing?",
    "gone": "raised NameError: name 'gone' is not defined",
    "np.zeros((7, 3))": "it must return",
}


def test_what_is_left_to_the_grader_has_to_be_something_that_it_can_judge(installed):
    answers = [(id, body) for body in UNFIT for id in sorted(LEFT_OUT)]
    shown = left_to_grader(installed, [(id, function_of(id, body)) for id, body in answers])
    assert len(shown) == 4 * len(UNFIT)
    for (id, body), card in zip(answers, shown, strict=True):
        assert "error in your code" in card, (id, body)
        assert UNFIT[body] in card, (id, body)


def test_what_is_left_to_the_grader_may_not_be_left_as_it_was(installed):
    codes = [(id, f"def {CHECKS[id].signature}:\n    raise NotImplementedError")
             for id in sorted(LEFT_OUT)]  # fmt: skip
    missing = [(id, "pass") for id in sorted(LEFT_OUT)]
    shown = left_to_grader(installed, [*codes, *missing])
    assert all("not attempted" in card for card in shown[: len(codes)])
    assert all("does not define" in card for card in shown[len(codes) :])


def test_an_arm_without_a_number_is_seen_before_it_is_handed_in(installed):
    (card,) = left_to_grader(
        installed, [("p1-singular_arm", "def singular_arm():\n    return {'l1': 1.0}, [0, 0]")]
    )
    assert "returned an arm without l2, lc1" in card
