"""The lessons' checks as their notebooks have them, and as they run there."""

import re
import subprocess
import sys

import nbclient
import pytest

from autograder import check, hint, hints_seen, worst_case
from autograder.judging.check import Check
from autograder.lesson_checks import checks_of, known, of_lesson
from autograder.lesson_checks.choice import Choice
from autograder.lesson_checks.number import Number
from autograder.lesson_checks.typed import name_of
from autograder.problems import CHECKS, READ, UnknownCheckError
from autograder.student import failing, hint_counts
from autograder.student import worst_case as of_worst_cases
from tests.autograder.lesson_checks.answers import (
    NUMBERS,
    cell_of,
    filled,
    lesson,
    path_of,
    table,
)
from tests.notebooks import course_map

OPTION = re.compile(r"^- \*\*([a-z])\*\* (.+)$", re.MULTILINE)
EACH = [(number, id) for number in NUMBERS for id in checks_of(number)]


@pytest.fixture(params=NUMBERS)
def number(request) -> str:
    return request.param


@pytest.fixture(autouse=True)
def new_kernel(monkeypatch, tmp_path):
    """A kernel that has just started, in a folder of its own with a notebook."""
    monkeypatch.setattr(hint_counts, "_here", {})
    monkeypatch.setattr(failing, "_failing", {})
    monkeypatch.setattr(of_worst_cases, "_last", {})
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lesson.ipynb").write_text("{}")


def cell_for(asked: Number | Choice | Check) -> str:
    """A check's cell, as every lesson has it."""
    if isinstance(asked, Check):
        return f'def {asked.signature}:\n    return ...\n\n\ncheck("{asked.id}")'
    unit = f"  # {asked.unit}" if isinstance(asked, Number) and asked.unit else ""
    return f'{name_of(asked.id)} = ...{unit}\ncheck("{asked.id}")'


def said_by(asked: Number | Choice | Check) -> list[str]:
    """All that a check may say of an answer that is not right, and its hints."""
    if isinstance(asked, Choice):
        return [*asked.hints, *(option.said for option in asked.options if option.said)]
    if isinstance(asked, Number):
        return [*asked.hints, *(one.sentence for one in asked.wrong), asked.otherwise]
    return [*asked.hints, *(mistake.sentence for mistake in asked.mistakes)]


def test_a_lesson_has_three_to_five_checks(number):
    assert 3 <= len(checks_of(number)) <= 5, f"autograder/lesson_checks/lesson_{number}.py"


def test_each_goal_is_checked_here_or_in_a_problem(number):
    goals = of_lesson(number).GOALS
    stated = course_map.goals(path_of(number))
    assert list(goals) == list(range(1, len(stated) + 1))
    checks = checks_of(number)
    for goal, ids in goals.items():
        assert ids, goal
        assert set(ids) <= checks.keys() | CHECKS.keys() | set(READ), goal
    assert checks.keys() <= {id for ids in goals.values() for id in ids}


def test_the_first_choice_says_how_to_type_a_letter(number):
    """A letter without quotes is a NameError, which no card explains."""
    choices = (id for id, asked in checks_of(number).items() if isinstance(asked, Choice))
    if first := next(choices, None):
        cells = lesson(number).cells
        place = next(k for k, cell in enumerate(cells) if cell.id == first)
        asks = next(c for c in reversed(cells[:place]) if OPTION.search(c.source))
        assert 'in quotes, as in `"a"`' in asks.source, asks.id


def test_checks_stand_in_the_notebook_in_their_order(number):
    calls = [
        (cell.id, id)
        for cell in lesson(number).cells
        if cell.cell_type == "code"
        for id in re.findall(r'\bcheck\("([\w-]+)"\)', cell.source)
        if id not in CHECKS
    ]
    assert calls == [(id, id) for id in checks_of(number)]


@pytest.mark.parametrize(("number", "id"), EACH)
def test_a_cell_has_the_one_form_below_its_question(number, id):
    cells = lesson(number).cells
    place = next(k for k, cell in enumerate(cells) if cell.id == id)
    assert re.search(r"Your turn|Predict, then run", cells[place - 1].source)
    assert cells[place].source == cell_for(checks_of(number)[id])
    assert re.fullmatch(rf"{number}-[a-z][a-z0-9-]*", id)
    asked = checks_of(number)[id]
    assert not isinstance(asked, Check) or asked.name == name_of(id)


@pytest.mark.parametrize(("number", "id"), EACH)
def test_the_stored_output_is_the_card_of_no_attempt(number, id):
    (output,) = cell_of(lesson(number), id).outputs
    assert output.output_type == "display_data"
    assert output.data["text/plain"] == (
        f"{id}: not attempted\n"
        "  Type your answer in place of the three dots, then run this cell again.\n"
        f'  Stuck? Run hint("{id}") for a hint.'
    )
    assert 'data-state="not-attempted"' in output.data["text/html"]


@pytest.mark.parametrize(
    ("number", "id"), [e for e in EACH if isinstance(checks_of(e[0])[e[1]], Choice)]
)
def test_the_lesson_lists_the_options(number, id):
    cells = lesson(number).cells
    place = next(k for k, cell in enumerate(cells) if cell.id == id)
    asked = checks_of(number)[id]
    listed = {letter: option.text for letter, option in asked.by_letter.items()}
    assert dict(OPTION.findall(cells[place - 1].source)) == listed


def test_the_right_letters_are_not_all_the_same():
    choices = [c for number in NUMBERS for c in checks_of(number).values() if isinstance(c, Choice)]
    right = [next(k for k, o in c.by_letter.items() if not o.said) for c in choices]
    assert len(set(right)) > 1


def test_no_other_cell_uses_the_students_names(number):
    own = {id: name_of(id) for id in checks_of(number)}
    for cell in lesson(number).cells:
        if cell.cell_type == "code" and cell.id not in own:
            assert not re.search(r"\bmy_\w", cell.source), cell.id


def shown(value: float) -> re.Pattern:
    """The number as a text may have it, with two digits or more of it."""
    texts = {f"{value:.{digits}g}" for digits in (3, 4, 5)}
    return re.compile("|".join(rf"(?<![\d.]){re.escape(t.lstrip('-'))}(?![\d.]?\d)" for t in texts))


@pytest.mark.parametrize(
    ("number", "id"), [e for e in EACH if isinstance(checks_of(e[0])[e[1]], Number)]
)
def test_the_right_number_is_shown_nowhere_before(number, id):
    asked = checks_of(number)[id]
    looked_for = shown(asked.right)
    for text in said_by(asked):
        assert not looked_for.search(text), text
    for cell in lesson(number).cells:
        if cell.id == id:
            break
        if abs(asked.right) < 10 and asked.right == int(asked.right):
            continue  # a whole number of one digit stands in every text
        assert not looked_for.search(cell.source), cell.id
        for output in cell.get("outputs", []):
            text = output.get("text") or output.data.get("text/plain", "")
            assert not looked_for.search(text), cell.id


@pytest.mark.parametrize(("number", "id"), EACH)
def test_what_a_check_says(number, id):
    asked = checks_of(number)[id]
    texts = [*said_by(asked), asked.further]
    assert len(asked.hints) >= 2
    for text in texts:
        assert re.fullmatch(r"[A-Z].*[.?]", text), text
        assert "  " not in text
        assert "$" not in text  # plain text would not typeset it
        assert len(text) < 240


def card_of(number: str, id: str, typed: str, capsys) -> str:
    """What the check's cell prints with this answer in it."""
    source = filled(cell_of(lesson(number), id).source, typed)
    exec(source, {"__name__": "__main__", "check": check, **used_in(typed)})
    return capsys.readouterr().out


def used_in(typed: str) -> dict:
    import numpy as np

    return {"np": np} if "np." in typed else {}


@pytest.mark.parametrize(("number", "id"), EACH)
def test_no_answer_raises(number, id, capsys):
    answers = table(number)[id]
    typed = [*answers.wrong.values(), *answers.other, "None", "'<b>'"]
    assert card_of(number, id, "...", capsys).startswith(f"{id}: not attempted\n")
    for wrong in (one for one in typed if "arm" not in one):
        card = card_of(number, id, wrong, capsys)
        assert re.match(f"{id}: (incorrect|error in your code)\n", card), card
        assert f'Run hint("{id}")' in card


def test_hint_serves_a_lessons_check_and_writes_nothing(tmp_path, capsys):
    with pytest.raises(UnknownCheckError, match="no check has failed"):
        hint()
    exec('my_sag = ...\ncheck("05-sag")', {"check": check})
    with pytest.raises(UnknownCheckError, match="no check has failed"):
        hint()  # what is not attempted has not failed
    exec('my_sag = 1.0\ncheck("05-sag")', {"check": check})
    capsys.readouterr()
    hint()
    hint("05-sag")
    first, second = known("05-sag").hints
    printed = capsys.readouterr().out
    assert printed.count(first) == 2
    assert printed.count(second) == 1
    assert not (tmp_path / hints_seen.FILE).exists()


def test_worst_case_serves_a_lessons_function(capsys):
    source = 'def my_power(qd, u, f):\n    return qd @ u\n\n\ncheck("04-power")'
    exec(source, {"check": check})
    qd, u, f = worst_case("04-power")
    assert len(qd) == len(u) == len(f)
    with pytest.raises(LookupError, match="has not run yet"):
        worst_case("05-sag")


@pytest.mark.parametrize(
    ("id", "said"),
    [
        ("05-sga", "there is no check '05-sga' in this lesson; did you mean '05-sag'"),
        ("05-", f"they are {', '.join(checks_of('05'))}"),
        ("98-sag", "there is no check '98-sag'; "),
    ],
)
def test_an_unknown_id_is_answered(id, said):
    for function in (check, hint, worst_case):
        with pytest.raises(UnknownCheckError) as refused:
            function(id)
        assert said in str(refused.value)


def test_a_lesson_loads_its_own_checks_and_nothing_heavy():
    script = """
import sys
from autograder import check, hint
before = {name for name in sys.modules if "lesson_checks.lesson_" in name}
my_sag = 3.9
check("05-sag")
heavy = {"sympy", "scipy", "matplotlib", "armdyn"} & set(sys.modules)
lessons = {name[-2:] for name in sys.modules if "lesson_checks.lesson_" in name}
print(before, heavy, lessons)
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1] == "set() set() {'05'}"


@pytest.mark.long
def test_with_all_answers_in_it_a_lesson_runs_and_every_check_is_right(number):
    notebook = lesson(number)
    for id, answers in table(number).items():
        cell_of(notebook, id).source = filled(cell_of(notebook, id).source, answers.right[0])
    resources = {"metadata": {"path": str(path_of(number).parent)}}
    nbclient.NotebookClient(notebook, timeout=300, resources=resources).execute()
    for id in table(number):
        (output,) = cell_of(notebook, id).outputs
        assert output.data["text/plain"].startswith(f"{id}: correct\n"), id
