"""python -m docs.book FILE.pdf: writes the course as one PDF, without TeX."""

import sys
import tempfile
from pathlib import Path

import pypandoc
import typst

from autograder.nbgrader_glue.release import write_problem
from docs import reading_order
from docs.book.chapters import Chapter

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent
FORMAT = "markdown-yaml_metadata_block-citations-auto_identifiers+lists_without_preceding_blankline"


def chapters(folder: Path) -> list[Chapter]:
    """The lessons, then the stories of the problems as students get them, challenges last."""
    for path in ROOT.glob("solutions/*/*.ipynb"):
        write_problem(ROOT, path.stem, folder / "problems" / path.stem)
    stories = folder.glob("problems/*/*.ipynb")
    lessons = [Chapter(path, folder, True) for path in reading_order.lessons(ROOT / "lessons")]
    problems = sorted(stories, key=lambda path: (path.stem[0] == "c", path.stem))
    return lessons + [Chapter(path, folder, False) for path in problems]


def book(folder: Path) -> str:
    """The whole book as Typst; its figures are written into the folder."""
    terms = (HERE / "terms.txt").read_text(encoding="utf-8").splitlines()
    parts = chapters(folder)
    labels = set().union(*(part.labels for part in parts))
    text = [part.markdown(labels, terms) for part in parts]
    settings = ["--syntax-highlighting=idiomatic", "--wrap=preserve"]
    body = pypandoc.convert_text("\n\n".join(text), "typst", format=FORMAT, extra_args=settings)
    head, index = ((HERE / name).read_text(encoding="utf-8") for name in ("book.typ", "index.typ"))
    return "\n".join([head, body, index])


def main(pdf: Path) -> None:
    pdf.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        source = Path(work) / "book.typ"
        source.write_text(book(Path(work)), encoding="utf-8")
        typst.compile(source, output=pdf)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
