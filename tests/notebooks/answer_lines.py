"""What students may not be shown: the lines of answers, as a page or a book must not have them."""

import json
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
SOLUTION = re.compile(r"### BEGIN (SOLUTION|HIDDEN TESTS)\n(.*?)### END \1", re.DOTALL)
LONG = 25  # letters: a line of an answer that is shorter may stand elsewhere by chance


def flat(text: str) -> str:
    return " ".join(text.split())


def cells(pattern: str) -> list[tuple[str, str]]:
    """Of each cell of the notebooks, what students are shown, and what they are not."""
    parts = []
    for path in ROOT.glob(pattern):
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            source = "".join(cell["source"])
            solution = cell["metadata"].get("nbgrader", {}).get("solution")
            if solution and cell["cell_type"] == "markdown":
                parts.append(("", source))
            else:
                hidden = "\n".join(match[2] for match in SOLUTION.finditer(source))
                parts.append((SOLUTION.sub("", source), hidden))
    return parts


def answer_lines() -> set[str]:
    """Lines of worked answers, hidden tests and model proofs that nothing public shares with them."""
    texts = [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("lib/**/*.py")]
    told = [path.read_text(encoding="utf-8") for path in texts]
    problems = cells("solutions/*/*.ipynb")
    told += [shown for shown, _ in [*problems, *cells("lessons/*.ipynb")]]
    known = flat("\n".join(told))
    lines = {flat(line) for _, hidden in problems for line in hidden.splitlines()}
    return {line for line in lines if len(line) >= LONG and line not in known}
