"""derivation() where students call it, and its card."""

import re
import subprocess
import sys
from html.parser import HTMLParser

import numpy as np
import pytest
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from autograder import check, derivation, hint
from autograder.problems import UnknownCheckError
from autograder.proofs import DERIVATIONS, card, mark
from autograder.protocol import handed_in
from autograder.student import hint_counts
from tests.autograder.proofs.models import models


def test_outside_a_notebook_it_prints(capsys):
    derivation("p2-E", models()["p2-E"])
    printed = capsys.readouterr().out
    assert printed.startswith("p2-E: complete\n  ✓ Edot = d/dt (K + P)   (definition of E)\n")
    assert "Row 2 of the table (1 point): all its lines hold. The person who reads" in printed
    assert "Stuck?" not in printed


def test_in_a_notebook_it_shows_a_card_and_raises_nothing(monkeypatch):
    monkeypatch.setattr(InteractiveShell, "_instance", None)
    InteractiveShell.instance()
    with capture_output() as captured:
        derivation("p2-skew", lambda: [("= 0", "energy balance")])
    InteractiveShell.clear_instance()
    (output,) = captured.outputs
    assert "Energy does not give this." in output.data["text/html"]
    assert "hint(&quot;p2-skew&quot;)</code> for a hint." in output.data["text/html"]
    assert "✗ = 0" in output.data["text/plain"]


@pytest.mark.parametrize("id", DERIVATIONS)
def test_without_lines_it_says_what_may_be_used(capsys, id):
    derivation(id)
    printed = capsys.readouterr().out
    known = DERIVATIONS[id]
    assert f"{id}: not attempted" in printed
    assert f"Start from {known.start}." in printed
    for name in (*known.subject.meanings, *known.reason_names):
        assert f"    {name}: " in printed
    # The end of the way is said in words, and no definition is.
    texts = [known.goal, *(text for reason in known.subject.reasons for _, text in reason.defines)]
    assert not [text for text in texts if len(text) > 6 and text in printed]


@pytest.mark.parametrize("id", ["p2-e", "p2", "", None, [], 3, "p2-E" * 50])
def test_an_unknown_id_is_answered_in_one_line(id):
    with pytest.raises(
        UnknownCheckError, match=r"there is no derivation '.{0,60}'; (did|they)"
    ) as said:
        derivation(id)
    assert len(said.value._render_traceback_()) == 1


def test_check_says_that_its_lines_are_marked_elsewhere():
    with pytest.raises(UnknownCheckError, match="no check judges 'p2-E': call derivation"):
        check("p2-E")


def test_hints(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(hint_counts, "_here", {})
    monkeypatch.chdir(tmp_path)
    for _ in range(3):
        hint("p2-skew")
    printed = capsys.readouterr().out
    assert [text for text in DERIVATIONS["p2-skew"].hints if text not in printed] == []
    assert "That was the last hint. The matching lesson has the rest." in printed


class Tags(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.tags, self.labels = [], []
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.labels += [value for name, value in attributes if name == "aria-label"]


def test_what_is_typed_is_escaped_cut_and_no_formula():
    typed = "= <img src=x onerror=alert(1)>$\\href{javascript:x}{y}$" + "K" * 300
    marked = mark(
        DERIVATIONS["p2-E"], handed_in([(typed, "<script>" * 9)] * 2), np.random.default_rng(0)
    )
    html = card.html_card(marked)
    assert set(Tags(html).tags) == {
        *("div", "p", "strong", "ol", "li", "span", "code", "em", "br", "details", "summary", "ul"),
    }
    assert 'class="armdyn-derivation tex2jax_ignore mathjax_ignore"' in html
    assert "K" * 170 not in html
    assert Tags(html).labels == ["p2-E: 0 of 2 lines hold", "does not hold", "does not hold"]
    assert max(map(len, card.text(marked).splitlines())) < 400


def test_marks_are_said_and_not_only_coloured():
    lines = [*models()["p2-E"][:1], ("= Kdot", "algebra")]
    html = card.html_card(mark(DERIVATIONS["p2-E"], handed_in(lines), np.random.default_rng(0)))
    assert re.findall(r'aria-label="((?:does not )?hold\w?)"', html) == ["holds", "does not hold"]


def test_it_loads_no_symbols():
    script = (
        "import sys; from autograder import derivation; derivation('p2-E', [('Kdot', 'algebra')]); "
        "sys.stderr.write(str({'sympy', 'scipy', 'matplotlib'} & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stderr == "set()"
