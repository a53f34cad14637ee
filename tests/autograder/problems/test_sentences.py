"""The sentences of all checks: each is typed once, in the problem that says it."""

import ast
from collections import defaultdict
from pathlib import Path

import pytest

from autograder import problems
from autograder.problems import CHECKS
from tests.autograder.course_problems import ROOT

SHORTEST = 24  # characters; a shorter text may stand in two places by chance
MISTAKES = {mistake.sentence for check in CHECKS.values() for mistake in check.mistakes}


def typed(folder: Path) -> dict[str, list[str]]:
    """The longer texts in the Python files of a folder, each with the places where it is typed."""
    places = defaultdict(list)
    for path in sorted(folder.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            text = node.value if isinstance(node, ast.Constant) else None
            if isinstance(text, str) and len(text) >= SHORTEST:
                places[text].append(f"{path.relative_to(ROOT)}:{node.lineno}")
    return places


def test_each_sentence_is_typed_once():
    said = MISTAKES | {s.text for check in CHECKS.values() for c in check.criteria for s in c.said}
    places = typed(Path(problems.__file__).parent)
    assert len(said & places.keys()) > 0.9 * len(said)  # some are made by `format`
    assert not {text: at for text, at in places.items() if text in said and len(at) > 1}


def test_no_test_types_a_mistakes_sentence():
    """It names the mistake, and `sentences` in tests/autograder/verdicts.py looks it up."""
    places = typed(ROOT / "tests")
    assert not {text: at for text, at in places.items() if text in MISTAKES}


@pytest.mark.parametrize("check_id", CHECKS)
def test_a_sentence_is_whole(check_id):
    for mistake in CHECKS[check_id].mistakes:
        assert mistake.sentence[0].isupper(), mistake.name
        assert mistake.sentence.endswith((".", "?")), mistake.name
        assert "  " not in mistake.sentence, mistake.name
