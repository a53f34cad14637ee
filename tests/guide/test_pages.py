"""What the pages say beside their commands: none is left out, and names, links and options are there."""

import re
from collections import Counter

import pytest
from nbgrader.apps.nbgraderapp import NbGraderApp

from autograder import roster, term_calendar
from autograder.cli import main
from autograder.lti import registration
from autograder.roster import Person
from tests.guide.document import LANGUAGES, ROOT, Page, pages
from tests.guide.not_run import REASONS

# The pages whose commands test_sessions.py runs.
FOLLOWED = {
    "README.md",
    "docs/instructors.md",
    "docs/handing-out.md",
    "docs/grading-rules.md",
    "docs/platforms.md",
    "docs/marking.md",
    "docs/own-problem.md",
    "CONTRIBUTING.md",
}


def test_the_minute_of_the_readme_is_the_guides_term_in_short():
    """So that its commands run with the guide's, in the same order and to the same end."""
    short = [one for one in Page("README.md").commands if one.text not in REASONS]
    long = iter([one for one in Page("docs/instructors.md").commands if one.text not in REASONS])
    assert len(short) > 5
    for command in short:
        found = any((one.text, one.status) == (command.text, command.status) for one in long)
        assert found, (
            f"{command.place}: {command.text} is not in docs/instructors.md, in this order"
        )


def test_the_class_list_and_the_calendar_of_the_page_are_read(tmp_path):
    page = Page("docs/class-list.md")
    (listed,), (calendar,) = page.texts("csv"), page.texts("toml")
    for name in re.findall(r"^\[([\w-]+)\]", calendar, re.M):
        (tmp_path / "solutions" / name).mkdir(parents=True)
    (tmp_path / "course").mkdir()
    (tmp_path / roster.FILE).write_text(listed, encoding="utf-8")
    (tmp_path / term_calendar.FILE).write_text(calendar, encoding="utf-8")
    people = roster.read(tmp_path / roster.FILE).people
    assert people["bob"] == Person("bob", "Doe, Jr.", "Bob", "bob@example.org", "4712")
    assert term_calendar.read_if_there(tmp_path).of("p4-gravity").penalty == term_calendar.ZERO


def test_the_registration_of_the_page_is_read(tmp_path):
    (held,) = Page("docs/platforms.md").texts("toml")
    (tmp_path / "course").mkdir()
    (tmp_path / registration.FILE).write_text(held, encoding="utf-8")
    found = registration.read(tmp_path)
    assert (found.client_id, found.issuer) == ("Zk3xQ7", "https://moodle.example.edu")
    assert found.members_url.endswith("/memberships")


def test_each_block_says_what_it_is_and_no_command_is_left_out():
    for page in pages():
        for block in page.blocks:
            assert block.language in LANGUAGES, f"{page.name}:{block.line}: name the language"
        if page.name not in FOLLOWED:
            assert page.commands == [], f"{page.name}: a session in tests/guide has to run these"


def test_the_list_of_what_is_not_run_is_no_longer_than_it_has_to_be():
    shown = Counter(command.text for page in pages() for command in page.commands)
    assert set(REASONS) - set(shown) == set()
    for name in re.findall(r"tests/[\w/]+\.py", " ".join(REASONS.values())):
        assert (ROOT / name).is_file(), name


def anchors(page: Page) -> set[str]:
    """The headings of a page, as links name them."""
    heads = re.findall(r"^#+ (.+)$", (ROOT / page.name).read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}


def test_a_link_from_page_to_page_leads_to_a_heading():
    known = {(ROOT / page.name): anchors(page) for page in pages()}
    for page in pages():
        path = ROOT / page.name
        text = path.read_text(encoding="utf-8")
        for to, anchor in re.findall(r"\]\(([^)#\s:]*\.md|)(?:#([^)\s]+))?\)", text):
            target = (path.parent / to).resolve() if to else path
            assert target.is_file(), f"{page.name}: {to}"
            if anchor and target in known:
                assert anchor in known[target], f"{page.name}: {to}#{anchor}"


def options_of_autograder(name: str, capsys) -> set[str]:
    with pytest.raises(SystemExit):
        main([name, "--help"])
    return set(re.findall(r"--[\w-]+", capsys.readouterr().out))


def options_of_nbgrader(name: str) -> set[str]:
    app = NbGraderApp.subcommands[name][0]
    known = {*app.flags, *app.aliases, "help", "debug", "student", "assignment"}
    return {f"--{one}" for group in known for one in (group if type(group) is tuple else (group,))}


def test_an_option_that_a_sentence_names_is_there(capsys):
    known: dict[tuple[str, str], set[str]] = {}
    seen = 0
    for page in pages():
        for text in page.inline:
            found = re.match(r"(nbgrader|autograder) ([a-z_-]+)\b(.*)", text, re.S)
            if (
                not found
                or found[2] == "lab"
                or not (options := re.findall(r"(?<!\S)--[\w-]+", found[3]))
            ):
                continue
            key = found[1], found[2]
            if key not in known:
                known[key] = (options_of_nbgrader(found[2]) if found[1] == "nbgrader"
                              else options_of_autograder(found[2], capsys))  # fmt: skip
            assert set(options) <= known[key], f"{page.name}: {text}"
            seen += 1
    assert seen > 3


def test_the_guide_is_a_term_from_the_class_list_to_the_next_year():
    text = (ROOT / "docs" / "instructors.md").read_text(encoding="utf-8")
    order = re.findall(r"^## (.+)$", text, re.M)
    wanted = [
        *("The class list and the calendar", "Set up an assignment", "Release", "The deadline"),
        *("Collect", "Grade", "Mark the proofs", "Feedback", "Export", "Corrections", "Next year"),
    ]
    assert [heading for heading in order if heading in wanted] == wanted
    assert len(text.splitlines()) < 320
