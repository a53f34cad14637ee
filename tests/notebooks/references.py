"""What the lessons cite, in one file by key, and the page that is made of it.

    python -m tests.notebooks.references docs/references.md

`make lessons` runs it. docs/references.toml is written by hand; a lesson's list at its end has the same
authors, year and title, and may add to them what to read there.
"""

import re
import sys
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import nbformat

ROOT = Path(__file__).parents[2]
LESSONS = sorted((ROOT / "lessons").glob("*.ipynb"))
LISTED = re.compile(r"^- (?P<authors>[^(]+) \((?P<year>\d{4})(?: on)?\), \*(?P<title>[^*]+)\*")
# Spong 1987; Slotine and Li (1987); Luh, Walker and Paul (1980); Ortega et al. 2002.
CITED = re.compile(
    r"(?P<name>[A-Z][\w'’-]+)(?:(?:, [A-Z][\w-]+)* (?:and|&) [A-Z][\w-]+| et al\.)?,? "
    r"\(?(?P<year>(?:18|19|20)\d\d)\b"
)
HEAD = """# References

Made from [references.toml](references.toml) by `make lessons`; do not edit it. The lessons cite by the
first author's name and the year. A DOI stands here only if it was confirmed.

| key | reference | lessons |
|---|---|---|
"""


@dataclass(frozen=True)
class Reference:
    """One book, paper or program."""

    key: str
    authors: str
    title: str
    where: str
    doi: str = ""

    @property
    def year(self) -> str:
        return self.key.split()[-1]

    @property
    def text(self) -> str:
        doi = (
            f" [doi:{self.doi}](https://doi.org/{self.doi.replace('(', '%28').replace(')', '%29')})"
        )
        said = f"{self.authors} ({self.year}), *{self.title}*, {self.where}."
        return said + (doi if self.doi else "")


def references() -> list[Reference]:
    """All of docs/references.toml. Raises TypeError for an entry with other fields."""
    text = (ROOT / "docs" / "references.toml").read_text(encoding="utf-8")
    return [Reference(key, **entry) for key, entry in tomllib.loads(text).items()]


@cache
def parts(lesson: Path) -> tuple[str, str]:
    """A lesson's text before its list of references, without its code; and this list."""
    notebook = nbformat.read(lesson, as_version=nbformat.NO_CONVERT)
    text = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    before, _, listed = text.partition("### References\n")
    return before, listed.partition("\n## ")[0]  # an appendix may follow


def listed_in(lesson: Path) -> list[str]:
    """The lines of a lesson's list."""
    return [line for line in parts(lesson)[1].splitlines() if line.strip()]


def entry_of(line: str, among: list[Reference]) -> Reference | None:
    """The reference that a line of a lesson's list is about."""
    found = LISTED.match(line)
    if not found:
        return None
    said = found["authors"], found["year"], found["title"]
    return next((r for r in among if (r.authors, r.year, r.title) == said), None)


def cited_in(text: str) -> list[str]:
    """The keys that a text cites: "Ortega 2002" of "Ortega et al. 2002"."""
    # Of several names the first one is the key's.
    return [f"{found['name']} {found['year']}" for found in CITED.finditer(text)]


def page() -> str:
    every = references()
    lessons = {r.key: [] for r in every}
    for path in sorted((ROOT / "lessons").glob("*.ipynb")):  # also one that has just been written
        for line in listed_in(path):
            entry = entry_of(line, every)
            if entry:
                link = f"[{path.name[:2]}](../lessons/{path.name})"
                lessons[entry.key].append(link)
    rows = [f"| {r.key} | {r.text} | {', '.join(lessons[r.key])} |\n" for r in every]
    return HEAD + "".join(rows)


def main(path: str) -> None:
    Path(path).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
