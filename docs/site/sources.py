"""Lays out what the pages are made of, in a folder of its own, so that links lead where they led before.

A problem is laid out as students get it, under `problems/`; nothing of `solutions/` is.
"""

import pkgutil
import re
import shutil
from pathlib import Path

import armdyn
from autograder.nbgrader_glue.release import write_problem
from docs import reading_order

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent
GUIDES = (
    *("instructors", "handing-out", "class-list", "platforms", "grading-rules", "marking"),
    *("corrections", "sandbox", "troubleshooting", "class-server", "workers", "containers"),
    *("own-problem", "library", "course-map", "source-errata", "references"),
)
PAGES = ("CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md")
# Files that pages link to, and a reader may fetch. The tests of the autograder hold right answers.
MAY_BE_FETCHED = ("LICENSE", "docs/", "tests/armdyn/", "tests/ports/", "tests/peers/", "lib/")
LINK = re.compile(r"\]\(([^)#\s:]+)(?:#[^)\s]*)?\)")

CONTENTS = """
```{{toctree}}
:caption: {caption}
:hidden:

{pages}
```
"""
# What a package only passes on stands with the module that has it.
MODULE = """
{level} {module}

```{{eval-rst}}
.. automodule:: {module}
   :members:
   :ignore-module-all:
```
"""


def lay_out(source: Path) -> None:
    """Write everything that Sphinx reads into the folder `source`, which is emptied first."""
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(ROOT / "lessons", source / "lessons", ignore=_hidden)
    for folder in sorted((ROOT / "solutions").iterdir()):
        if folder.is_dir():
            write_problem(ROOT, folder.name, source / "problems" / folder.name)
    (source / "docs").mkdir()
    for page in (ROOT / "docs").glob("*.md"):
        text = page.read_text(encoding="utf-8").replace("](../README.md", "](../index.md")
        (source / "docs" / page.name).write_text(text, encoding="utf-8")
    for page in PAGES:
        shutil.copy(ROOT / page, source)
    modules = _api(source / "api")
    challenges = _pages(source, "problems/c*/*.ipynb")
    problems = [page for page in _pages(source, "problems/*/*.ipynb") if page not in challenges]
    contents = {
        "Lessons": [f"lessons/{path.name}" for path in reading_order.lessons(source / "lessons")],
        "Problems": problems + challenges,
        "Guides": [f"docs/{name}" for name in (*GUIDES, "benchmarks")],
        "The library": ["api/index"],
        "The project": [*PAGES],
    }
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    trees = [
        CONTENTS.format(caption=caption, pages="\n".join(pages))
        for caption, pages in contents.items()
    ]
    (source / "index.md").write_text(readme + "".join(trees), encoding="utf-8")
    (source / "api" / "index.md").write_text(
        (HERE / "api.md").read_text(encoding="utf-8")
        + CONTENTS.format(caption="Modules", pages="\n".join(modules)),
        encoding="utf-8",
    )
    _fetched_files(source)


def _pages(source: Path, pattern: str) -> list[str]:
    return sorted(page.relative_to(source).as_posix() for page in source.glob(pattern))


def _hidden(folder: str, names: list[str]) -> list[str]:
    return [name for name in names if name.startswith(".")]


def _api(folder: Path) -> list[str]:
    """A page for armdyn and each public module or package just below it; returns the pages' names."""
    folder.mkdir()
    found = pkgutil.walk_packages(armdyn.__path__, "armdyn.")
    modules = ["armdyn", *sorted(module.name for module in found)]
    pages: dict[str, str] = {}
    for module in modules:
        page = ".".join(module.split(".")[:2])
        level = "#" if module == page else "##"
        pages[page] = pages.get(page, "") + MODULE.format(level=level, module=module)
    for page, text in pages.items():
        (folder / f"{page}.md").write_text(text, encoding="utf-8")
    return list(pages)


def _fetched_files(source: Path) -> None:
    """Copy each file that a page links to and that a reader may fetch."""
    for page in [*source.rglob("*.md"), *source.rglob("*.ipynb")]:
        for target in LINK.findall(page.read_text(encoding="utf-8")):
            place = (page.parent / target).resolve()
            if place.exists() or not place.is_relative_to(source):
                continue
            name = place.relative_to(source).as_posix()
            if name.startswith(MAY_BE_FETCHED) and (ROOT / name).is_file():
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, place)
