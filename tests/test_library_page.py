"""Each example of docs/library.md runs by itself."""

import re
from pathlib import Path

import pytest

from armdyn.codegen import NoCompilerError

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "library.md").read_text(encoding="utf-8")


def examples():
    for section in re.split(r"^## ", PAGE, flags=re.M)[1:]:
        title, text = section.split("\n", 1)
        for k, code in enumerate(re.findall(r"```python\n(.*?)```", text, re.S), start=1):
            yield pytest.param(code, id=f"{title} {k}")


@pytest.mark.parametrize("code", list(examples()))
def test_example_runs(code, monkeypatch, tmp_path):
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path))
    try:
        exec(code, {})
    except NoCompilerError as error:
        pytest.skip(str(error))


def test_the_contents_lead_to_the_sections():
    titles = re.findall(r"^## (.*)$", PAGE, flags=re.M)
    anchors = {title.lower().replace(" ", "-") for title in titles}
    assert set(re.findall(r"\(#([\w-]+)\)", PAGE)) == anchors


def test_the_readme_leads_to_the_page():
    assert "(docs/library.md)" in (ROOT / "README.md").read_text(encoding="utf-8")
