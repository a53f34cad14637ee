"""The lessons as files: what they must be to read well in JupyterLab, on a code host and in print.

That their code runs and gives the stored outputs is nbval's part: `pytest --nbval lessons`.
"""

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import nbformat
import pytest

LESSONS = sorted((Path(__file__).parents[2] / "lessons").glob("*.ipynb"))
LARGEST = 1_500_000  # bytes
IMAGES = ("image/png", "image/jpeg", "image/svg+xml")
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
MACHINE_PATH = re.compile(r"(/(home|Users|root|tmp|work|mnt|opt|var)/|[A-Z]:\\\\)\w")


@pytest.fixture(params=LESSONS, ids=[path.stem for path in LESSONS])
def path(request) -> Path:
    return request.param


@pytest.fixture
def lesson(path):
    return nbformat.read(path, as_version=nbformat.NO_CONVERT)


def code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def outputs(notebook):
    return [(cell.id, output) for cell in code_cells(notebook) for output in cell.outputs]


class AltTexts(HTMLParser):
    """The alternative texts of a page's images; None for an image without."""

    def __init__(self, page):
        super().__init__()
        self.alts = []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        if tag == "img":
            self.alts.append(dict(attrs).get("alt"))


def described(data, metadata) -> bool:
    """Whether each image of an output has alternative text, where JupyterLab and nbconvert look."""
    in_html = AltTexts("".join(data.get("text/html", ""))).alts
    if any(not alt for alt in in_html):
        return False
    # JupyterLab has no alternative text for a bare image: one in HTML must go with it.
    return all(in_html and metadata.get(kind, {}).get("alt") for kind in IMAGES if kind in data)


def test_there_are_lessons():
    assert [path.name[:2] for path in LESSONS] == [f"{i:02}" for i in range(len(LESSONS))]
    assert len(LESSONS) >= 2


def test_format_kernel_and_metadata(lesson):
    nbformat.validate(lesson)
    assert (lesson.nbformat, lesson.nbformat_minor) == (4, 5)
    kernel = lesson.metadata.kernelspec
    assert (kernel.name, kernel.display_name) == ("python3", "Python 3 (ipykernel)")
    # Versions and widget states are those of whoever ran it last.
    assert set(lesson.metadata) == {"kernelspec", "language_info"}, (
        "remove other notebook metadata after a run (widget states, above all)"
    )
    assert lesson.metadata.language_info == {"name": "python"}


def test_cell_ids_are_unique_and_readable(path, lesson):
    ids = [cell.id for cell in lesson.cells]
    assert len(ids) == len(set(ids))
    for name in ids:
        assert re.fullmatch(rf"{path.name[:2]}-[a-zA-Z0-9-]+", name), name


def test_run_from_top_to_bottom_without_errors(lesson):
    counts = [cell.execution_count for cell in code_cells(lesson)]
    assert counts == list(range(1, len(counts) + 1))
    for name, output in outputs(lesson):
        assert output.output_type != "error", name
        assert output.get("name") != "stderr", name
    for cell in lesson.cells:
        assert "execution" not in cell.metadata, f"{cell.id}: remove the timing"


def test_figures_have_alternative_text(lesson):
    for name, output in outputs(lesson):
        if "data" in output:
            assert described(output.data, output.metadata), f"{name}: use plotting.Picture"
    for cell in lesson.cells:
        if cell.cell_type == "markdown":
            assert "![](" not in cell.source, f"{cell.id}: an image without alternative text"
            assert cell.source.count("```mermaid") == cell.source.count("accDescr"), cell.id


@pytest.mark.parametrize(
    ("data", "metadata", "good"),
    [
        ({"text/html": '<img src="x" alt="a line">'}, {}, True),
        ({"text/html": '<img src="x">'}, {}, False),
        ({"text/html": '<img src="x" alt="">'}, {}, False),
        ({"image/png": "x"}, {"image/png": {"alt": "a line"}}, False),
        ({"image/png": "x", "text/html": '<img alt="a line">'}, {}, False),
        (
            {"image/png": "x", "text/html": '<img alt="a line">'},
            {"image/png": {"alt": "a line"}},
            True,
        ),
        ({"text/plain": "42"}, {}, True),
    ],
)
def test_a_figure_without_description_is_noticed(data, metadata, good):
    assert described(data, metadata) is good


def test_controls_leave_no_dead_widget(lesson):
    """A stored view has no kernel behind it: JupyterLab would show an error in its place."""
    for cell in code_cells(lesson):
        views = [o for o in cell.outputs if WIDGET_VIEW in o.get("data", {})]
        assert not views, f"{cell.id}: keep a line of text in place of the widget's view"
        if "interact" in cell.source:
            assert "nbval-ignore-output" in cell.metadata.get("tags", []), cell.id


def test_nothing_of_the_machine_it_ran_on(path):
    found = MACHINE_PATH.search(path.read_text(encoding="utf-8"))
    assert not found, found.group()


@pytest.mark.parametrize("text", ["/home/ann/x.py", "/tmp/a", "/Users/ann", r'"C:\\Users"'])
def test_a_machine_path_is_noticed(text):
    assert MACHINE_PATH.search(text)


def test_size(path):
    assert path.stat().st_size <= LARGEST


def test_every_lesson_asserts_and_ends_with_a_summary(lesson):
    assert sum("assert " in cell.source for cell in code_cells(lesson)) >= 3
    text = "\n".join(cell.source for cell in lesson.cells if cell.cell_type == "markdown")
    for part in ("you can**", "Predict, then run", "## Summary", "### References"):
        assert part in text, part


def test_links_between_lessons_lead_somewhere(path, lesson):
    for cell in lesson.cells:
        if cell.cell_type == "markdown":
            for target in re.findall(r"\]\(((?!https?:|#|\.\./problems/)[^)\s]+)\)", cell.source):
                file = target.partition("#")[0]
                assert (path.parent / file).exists(), f"{cell.id}: {target}"


def test_problems_named_in_a_lesson_have_a_source(path, lesson):
    """`make lab` makes problems/x/y.ipynb from solutions/x/y.ipynb."""
    solutions = path.parents[1] / "solutions"
    targets = re.findall(r"\.\./problems/([^)\s\\]+)\)", json.dumps(lesson))
    for target in targets:
        assert (solutions / target).is_file(), target
