"""Hints: one more each time, three for each check, and none of them the answer."""

import dataclasses
import inspect
import re
from html.parser import HTMLParser

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from autograder import hints_seen
from autograder.problems import CHECKS
from autograder.problems.material import planar_2r
from autograder.problems.start_here.checks import CHECKS as FIRST
from autograder.student import failing, hint_counts
from autograder.student.cell import NotCorrectError, check
from autograder.student.hints import hint

LAST = "That was the last hint. The matching lesson has the rest."


@pytest.fixture(autouse=True)
def none_given(monkeypatch, tmp_path):
    """A kernel that has just started, in a folder of its own."""
    monkeypatch.setattr(hint_counts, "_here", {})
    monkeypatch.setattr(failing, "_failing", {})
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def shown(monkeypatch):
    """What the function displays under IPython, as a bundle of MIME types."""
    monkeypatch.setattr(InteractiveShell, "_instance", None)
    shell = InteractiveShell.instance()

    def run(id):
        with capture_output() as captured:
            hint(id)
        (output,) = captured.outputs
        return output.data

    yield run
    InteractiveShell.clear_instance()
    del shell


class Words(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.words, self.items = [], 0
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self.items += tag == "li"

    def handle_data(self, data):
        self.words.append(data)


def printed(capsys, id) -> list[str]:
    hint(id)
    return capsys.readouterr().out.splitlines()


@pytest.mark.parametrize("id", [id for id in CHECKS if CHECKS[id] not in FIRST])
def test_each_time_one_more_and_the_last_again(id, capsys):
    known = CHECKS[id].hints
    for count in range(1, len(known) + 3):
        given_now = min(count, len(known))
        title, *lines, left = printed(capsys, id)
        assert title == f"Hints for {id}"
        assert lines == [f"{k}. {text}" for k, text in enumerate(known[:given_now], 1)]
        more = len(known) - given_now
        again = f'Hint {given_now} of {len(known)}. For the next one, run hint("{id}") again.'
        assert left == (again if more else LAST)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.lists(st.sampled_from([id for id in CHECKS if CHECKS[id].hints]), max_size=12))
def test_each_check_counts_for_itself(asked):
    hint_counts._here.clear()
    for place, id in enumerate(asked):
        with capture_output() as captured:
            hint(id)
        known = CHECKS[id].hints
        last = known[min(asked[:place].count(id), len(known) - 1)]
        assert captured.stdout.splitlines()[-2].endswith(last)


def test_a_check_without_hints_says_so(capsys):
    ids = [id for id in CHECKS if not CHECKS[id].hints]
    assert ids == [check.id for check in FIRST]
    for id in ids:
        for _ in range(2):
            assert printed(capsys, id) == [f"Hints for {id}", "There are no hints for this check."]


@pytest.mark.parametrize("id", ["p1-Mm", "p1-m", "", "nothing like it", "p5"])
def test_an_unknown_id_is_refused_as_by_the_check(id):
    with pytest.raises(ValueError, match="there is no check") as of_check:
        check(id)
    with pytest.raises(ValueError, match="there is no check") as of_hint:
        hint(id)
    assert str(of_hint.value) == str(of_check.value)
    assert repr(id) in str(of_hint.value)
    assert not hint_counts._here


def test_under_ipython_a_card_says_what_the_text_says(shown):
    known = CHECKS["p1-M"].hints
    for count in range(1, len(known) + 1):
        data = shown("p1-M")
        assert data.keys() == {"text/plain", "text/html"}
        card = Words(data["text/html"])
        title, *lines, left = data["text/plain"].splitlines()
        assert card.words == [title, *known[:count], left]
        assert card.items == count == len(lines)
        assert f'role="group" aria-label="{title}"' in data["text/html"]


def test_a_hint_is_escaped(shown, monkeypatch):
    said = 'is a < b & "c" > <b>?'
    monkeypatch.setitem(CHECKS, "p1-M", dataclasses.replace(CHECKS["p1-M"], hints=(said,)))
    html = shown("p1-M")["text/html"]
    assert "<b>" not in html
    assert said in Words(html).words


def formulas() -> set[str]:
    """The right sides of the reference formulas, and of what the models are made of, without blanks."""
    models = [getattr(c.reference, "of", c.reference) for c in CHECKS.values()]
    models += [f for _, f in inspect.getmembers(planar_2r, inspect.isfunction)]
    sides = set()
    for model in models:
        try:
            source = inspect.getsource(model if inspect.isfunction(model) else type(model))
        except OSError:
            continue
        for line in source.splitlines():
            side = re.search(r"(?:return|[^=!<>]=|lambda[^:]*:)\s*(.+)", line.partition("#")[0])
            if side:
                sides.add(squeezed(side[1]))
    return {side for side in sides if re.search(r"[*/@+-]", side) and len(side) > 6}


def squeezed(text: str) -> str:
    return re.sub(r"\s+", "", text.replace("arm.", "").replace("pend.", "").replace("np.", ""))


def test_there_are_formulas_to_look_for():
    found = formulas()
    assert squeezed("arm.I2 + arm.m2 * arm.lc2**2") in found
    assert squeezed("-arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])") in found
    assert len(found) > 20


@pytest.mark.parametrize("id", [id for id in CHECKS if CHECKS[id] not in FIRST])
def test_three_hints_a_check_none_of_which_is_the_formula(id):
    known = CHECKS[id].hints
    assert len(known) == len(set(known)) == 3
    for text in known:
        assert text == text.strip()
        assert text[-1] in ".?"
        assert "$" not in text  # JupyterLab would typeset it, plain text would not
        assert not [side for side in formulas() if side in squeezed(text)]


@pytest.fixture
def beside(tmp_path):
    """A notebook's folder."""
    (tmp_path / "p1-inertia.ipynb").write_text("{}")
    return tmp_path / hints_seen.FILE


def another_kernel(monkeypatch):
    monkeypatch.setattr(hint_counts, "_here", {})


def count_shown(capsys, id) -> int:
    return len(printed(capsys, id)) - 2


def test_the_count_outlives_the_kernel(beside, capsys, monkeypatch):
    assert [count_shown(capsys, "p1-M") for _ in range(2)] == [1, 2]
    assert hints_seen.read(beside) == {"p1-M": 2}
    another_kernel(monkeypatch)
    # First the same again, so that "Run All" gives away no more; then one more.
    assert [count_shown(capsys, "p1-M") for _ in range(2)] == [2, 3]
    assert count_shown(capsys, "p1-is_spd") == 1
    assert hints_seen.read(beside) == {"p1-M": 3, "p1-is_spd": 1}


def test_where_there_is_no_notebook_nothing_is_written(tmp_path, capsys):
    assert [count_shown(capsys, "p1-M") for _ in range(2)] == [1, 2]
    assert not list(tmp_path.iterdir())


def test_validate_counts_nothing(beside, capsys, monkeypatch):
    monkeypatch.setenv("NBGRADER_EXECUTION", "validate")
    assert count_shown(capsys, "p1-M") == 1
    assert not beside.exists()


def test_a_folder_that_nobody_may_write_to_breaks_nothing(beside, capsys, monkeypatch):
    def refused(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(hints_seen, "put_in_place", refused)
    assert [count_shown(capsys, "p1-M") for _ in range(3)] == [1, 2, 3]
    assert not beside.exists()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[1, 2]",
        "null",
        "{",
        "[" * 50_000,
        '{"p1-M": "2"}',
        '{"p1-M": true}',
        '{"p1-M": -1}',
        '{"p1-M": 1e9}',
        '{"p1-M": 1000}',
        f'{{"{"x" * 200}": 1}}',
        "\ud800",
    ],
)
def test_a_damaged_file_counts_as_none(text, beside, capsys):
    beside.write_text(text, encoding="utf-8", errors="surrogatepass")
    assert hints_seen.read(beside) == {}
    assert count_shown(capsys, "p1-M") == 1
    assert hints_seen.read(beside) == {"p1-M": 1}


def test_a_file_that_is_too_large_or_a_link_is_not_read(beside, tmp_path):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.write_text('{"p1-M": 2}')
    beside.symlink_to(elsewhere)
    assert hints_seen.read(beside) == {}
    beside.unlink()
    beside.write_text('{"p1-M": 2' + " " * hints_seen.MOST_BYTES + "}")
    assert hints_seen.read(beside) == {}


def checked(id, body):
    namespace = {"__name__": "__main__", "check": check}
    exec(f"def {CHECKS[id].signature}:\n    {body}", namespace)
    exec(f"check({id!r})", namespace)


def test_without_an_id_the_check_that_failed_last_is_served(capsys):
    with pytest.raises(ValueError, match="no check has failed since this kernel started"):
        hint()
    for id in ("p3-M", "p3-C"):
        with pytest.raises(NotCorrectError):
            checked(id, "return 7.0")
    assert printed(capsys, None)[-3] == "Hints for p3-C"
    checked("p3-C", "return 0.0")
    assert "Hints for p3-M" in printed(capsys, None)
    checked("p3-M", "return pend.I")
    with pytest.raises(ValueError, match="no check has failed since this kernel started"):
        hint()
