"""The files that people and sites read about the project agree with it and with each other."""

import datetime
import re
import tomllib
from pathlib import Path

import pytest
import yaml

from autograder.bundle import wheel

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("[0-9]*.yml"))


def read_yaml(path: Path) -> dict:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


@pytest.fixture
def citation():
    return read_yaml(ROOT / "CITATION.cff")


@pytest.fixture
def releases():
    """The dated releases of the changelog, newest first: (version, date)."""
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    return re.findall(r"^## (\d+\.\d+\.\d+) – (\d{4}-\d\d-\d\d)$", text, re.MULTILINE)


def test_citation_has_what_its_format_requires(citation):
    assert citation["cff-version"] == "1.2.0"
    assert citation["type"] == "software"
    assert {"message", "title", "version", "date-released", "license"} <= set(citation)
    assert citation["authors"]
    for author in citation["authors"]:
        assert "name" in author or {"family-names", "given-names"} & set(author)


def test_citation_is_of_this_version_under_its_licence(citation):
    assert citation["version"] == PROJECT["version"]
    assert citation["license"] in PROJECT["license"].split(" AND ")


def test_the_newest_release_of_the_changelog_is_this_version(citation, releases):
    version, date = releases[0]
    assert version == PROJECT["version"]
    assert date == str(citation["date-released"])
    assert date == "-".join(f"{part:02}" for part in wheel.RELEASED[:3])
    assert datetime.date.fromisoformat(date)


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_an_issue_form_asks_what_a_site_can_show(path):
    form = read_yaml(path)
    assert form["name"]
    assert form["description"]
    asked = [part for part in form["body"] if part["type"] != "markdown"]
    ids = [part["id"] for part in asked]
    assert len(set(ids)) == len(ids) > 0
    assert all(part["attributes"]["label"] for part in asked)
    assert any(part.get("validations", {}).get("required") for part in asked)


def test_escapes_are_reported_in_private():
    assert len(FORMS) == 3
    for path in FORMS:
        if path.stem != "3-idea":
            assert "SECURITY.md" in path.read_text(encoding="utf-8")
    security = (ROOT / "SECURITY.md").read_text(encoding="utf-8")
    assert "Report a vulnerability" in security
    assert not re.search(r"[\w.]+@[\w.]+", security)  # nobody keeps an address for it
