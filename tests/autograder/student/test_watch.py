"""watch() where students call it: what it says, where a card offers it, and that grading ignores it."""

import subprocess
import sys
from dataclasses import replace

import nbclient
import nbformat
import numpy as np
import pytest

import autograder
from autograder import watch
from autograder.authoring.template import template
from autograder.judging.call_text import shown_call
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.given import Given
from autograder.judging.verdict import State
from autograder.pictures.differences import title
from autograder.pictures.motion import compared
from autograder.pictures.offers import offer
from autograder.problems import CHECKS, UnknownCheckError, known_check
from autograder.student.cell import VISIBLE_SEED, verdict_on
from autograder.student.watch import shown
from tests.autograder.pictures.wrong import COSINE, MINUS, UPWARD, function
from tests.submissions.p1_inertia import RIGHT

WITH_PICTURES = {
    *("p1-M", "p2-C", "p3-M", "p3-C", "p3-g_vec", "p4-g_vec", "p4-potential_energy"),
    *("p5-f", "p5-energy_drift", "p5-simulate", "p5-rk4_step"),
}


def right_M() -> dict:
    names = {"np": np}
    exec(RIGHT["M"], names)
    return names


def test_it_plays_from_the_worst_case_of_the_card():
    namespace = {"M": function("p1-M", MINUS)}
    check = known_check("p1-M")
    verdict = verdict_on("p1-M", namespace)
    calls = check.calls(np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)
    few = [shown_call(call, check.signature, 3) for call in calls]
    assert few.count(verdict.witness.call) == 1
    start = title(compared(check, namespace["M"], verdict.worst))
    assert start in shown(check, namespace)["text/plain"]
    assert few[0] != verdict.witness.call  # else the first would do


@pytest.mark.parametrize(
    ("id", "namespace", "said"),
    [
        ("p1-M", right_M(), "The answer is right: there is nothing to compare."),
        ("p1-M", {}, 'There are no numbers of yours: see check("p1-M").'),
        ("p1-M", {"M": lambda q, arm: None}, 'There are no numbers of yours: see check("p1-M").'),
        (
            "p1-M",
            {"M": function("p1-M", "raise NotImplementedError\nreturn")},
            "There is no answer",
        ),
        ("p1-is_spd", {}, "There is no picture of is_spd: its card says what there is to say."),
    ],
)
def test_where_there_is_nothing_to_show_it_says_so(id, namespace, said):
    bundle = shown(known_check(id), namespace)
    assert said in bundle["text/plain"]
    assert "<img" not in bundle["text/html"]
    assert "<script" not in bundle["text/html"]


def test_a_simulation_that_runs_away_still_has_its_curve():
    body = "return np.array([x0 * 10.0**(3 * k) for k in range(len(t))])"
    bundle = shown(known_check("p5-simulate"), {"simulate": function("p5-simulate", body)})
    assert "After" in bundle["text/plain"]
    assert "<img" in bundle["text/html"]


def test_an_unknown_check_is_refused_and_plain_python_prints(capsys):
    with pytest.raises(UnknownCheckError, match="did you mean 'p1-M'"):
        watch("p1-m")
    watch("p1-is_spd")
    assert "There is no picture of is_spd" in capsys.readouterr().out


@pytest.mark.parametrize("id", CHECKS)
def test_cards_of_wrong_answers_offer_what_there_is(id):
    check = known_check(id)
    rng = np.random.default_rng(VISIBLE_SEED)
    calls = check.calls(rng, VISIBLE_CASES)
    expected = check._quantities_of(check.reference, calls)
    wrong = [tuple(1.5 * part + 0.25 for part in case) for case in expected]
    nothing = len(calls) * [None]
    verdict = check.judge(calls, expected, Given.sound(wrong, nothing))
    assert verdict.state is State.INCORRECT
    offered = offer(verdict, check, {"watch": watch})
    assert all(line.text.endswith(f': watch("{id}")') for line in offered)
    assert bool(offered) == (id in WITH_PICTURES)
    bare = offer(verdict, check, {})
    assert all("from autograder import watch; " in line.text for line in bare)
    right = check.judge(calls, expected, Given.sound(expected, nothing))
    for other in (right, replace(verdict, state=State.ERROR)):
        assert offer(other, check, {}) == []


def test_offering_loads_nothing_that_a_card_has_not_loaded():
    script = (
        "import sys, autograder; "
        "print({'sympy', 'matplotlib', 'scipy', 'armdyn', 'autograder.mechanisms'} & set(sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "set()"


def test_the_sandbox_knows_every_public_name():
    stub = {}
    path = autograder.__path__[0] + "/sandbox/inside/stubs/autograder.py"
    with open(path, encoding="utf-8") as file:
        exec(file.read(), stub)
    assert set(autograder.__all__) <= stub.keys()
    assert stub["watch"]("p1-M") is None


@pytest.fixture(scope="module")
def kernel():
    """The outputs of the cells of a student who is offered the picture, and takes it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
        patch.delenv("NBGRADER_EXECUTION", raising=False)
        sources = [
            "import numpy as np\nfrom autograder import check",
            f"def g_vec(q, pend):\n    return {COSINE}\ncheck('p3-g_vec')",
            "from autograder import watch; watch('p3-g_vec')",
            "check('p3-g_vec')",
        ]
        cells = [nbformat.v4.new_code_cell(source) for source in sources]
        notebook = nbformat.v4.new_notebook(cells=cells)
        nbclient.NotebookClient(notebook, kernel_name="python3", allow_errors=True).execute()
        return [cell.outputs for cell in notebook.cells]


def test_a_kernel_shows_the_offer_and_then_the_pictures(kernel):
    _, (card, _), (output,), (again, _) = kernel
    offer = (
        'See what your g_vec does to the motion: from autograder import watch; watch("p3-g_vec")'
    )
    assert offer in " ".join(card.data["text/plain"].split())
    assert "import watch" not in again.data["text/plain"]
    assert output.output_type == "display_data"
    assert output.data["text/html"].count("<img") == 2
    assert "moved 90° to the left" in output.data["text/plain"]


def test_all_of_gravity_is_shown_for_a_mechanism_too():
    body = UPWARD.replace("-np", "0.5 * np")
    text = shown(known_check("planar-2r-g_vec"), {"g_vec": function("planar-2r-g_vec", body)})
    assert "Your curve is 0.5 times as high as the right one everywhere." in text["text/plain"]


def test_a_mechanism_of_a_courses_own_is_played(tmp_path, monkeypatch):
    (tmp_path / "sled.py").write_text(template("sled"), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    check = known_check("sled-g_vec")
    bundle = shown(check, {"g_vec": lambda q, arm: -check.reference(q, arm)})
    assert "Your curve is the right one turned upside down." in bundle["text/plain"]
    assert bundle["text/html"].count("<img") == 2
