"""A notebook as a chapter in Pandoc's Markdown: its text, open code, figures and formulas."""

import base64
import json
import re
from pathlib import Path

from docs import diagrams
from docs.site.reading import is_told

LINK = re.compile(r"(?<!!)\[((?:[^\[\]]|\[[^\[\]]*\])+)\]\(([^)\s]+)\)")
PICTURE = re.compile(r"!\[([^\]]*)\]\(([^)\s]+\.svg)\)")
MERMAID = re.compile(r"```mermaid\n(.*?)```", re.DOTALL)
TABLE = re.compile(r"^\|.+\n\|[-:| ]+\|$(?:\n\|.+)*", re.MULTILINE)
# What no index term is looked for in: code, formulas, links, headings, tables.
APART = re.compile(
    r"(```.*?```|\$\$.*?\$\$|`[^`]*`|\$[^$]+\$|\[[^\]]*\]\([^)]*\)|^[#|][^\n]*)",
    re.DOTALL | re.MULTILINE,
)


class Chapter:
    """One notebook of the book.

    path: the notebook. pictures: the folder that its figures are written to. shows_code: whether its
    code and outputs are in the book, too; of a problem only the story is.
    """

    def __init__(self, path: Path, pictures: Path, shows_code: bool):
        self.name, self.folder, self.pictures = path.stem, path.parent, pictures
        self.shows_code = shows_code
        self.cells = json.loads(path.read_text(encoding="utf-8"))["cells"]

    @property
    def labels(self) -> set[str]:
        """The ids that a link may lead to: the chapter's own, and each cell's that begins a section."""
        return {self.name} | {cell["id"] for cell in self.cells[1:] if _heading(cell)}

    def markdown(self, labels: set[str], terms: list[str]) -> str:
        """The chapter, with links to what is in the book, and each term marked once a section."""
        parts = []
        for number, cell in enumerate(self.cells):
            source = "".join(cell["source"])
            if is_told(cell):
                label = self.name if number == 0 else cell["id"]
                parts.append(
                    self._text(source, label if label in self.labels else "", labels, terms)
                )
            elif cell["cell_type"] == "code" and self.shows_code and not _folded(cell):
                parts.append(f"```python\n{source}\n```")
                shown = enumerate(cell["outputs"])
                parts += [self._output(out, f"{cell['id']}-{i}") for i, out in shown]
        return "\n\n".join(filter(None, parts))

    def _text(self, source: str, label: str, labels: set[str], terms: list[str]) -> str:
        source = PICTURE.sub(self._drawing, source)
        source = MERMAID.sub(self._diagram, source)
        source = TABLE.sub(lambda table: _in_columns(table[0]), source)
        source = LINK.sub(lambda link: _inside(link[1], link[2], labels), source)
        if label:
            source = re.sub(r"^(#+ .+)$", rf"\1 {{#{label}}}", source, count=1, flags=re.MULTILINE)
        return _marked(source, terms)

    def _diagram(self, fence: re.Match) -> str:
        title = re.search(r"accTitle: (.+)", fence[1])
        name = f"{self.name}-{fence.start()}.svg"
        (self.pictures / name).write_text(diagrams.svg(fence[1]), encoding="utf-8")
        return f"![{title[1] if title else ''}]({name}){{width=75%}}"

    def _drawing(self, picture: re.Match) -> str:
        name = f"{self.name}-{picture[2]}"
        (self.pictures / name).write_bytes((self.folder / picture[2]).read_bytes())
        return f"![{picture[1]}]({name}){{width=60%}}"

    def _output(self, output: dict, name: str) -> str:
        data = {kind: "".join(value) for kind, value in output.get("data", {}).items() if value}
        if output["output_type"] == "stream":
            return f"```text\n{''.join(output['text']).rstrip()}\n```"
        if "image/png" in data:
            (self.pictures / f"{name}.png").write_bytes(base64.b64decode(data["image/png"]))
            caption = re.sub(r"([\\`*_$\[\]<>^~|#])", r"\\\1", data["text/plain"])
            return f"![{caption}]({name}.png){{width=90%}}"
        if "text/latex" in data:
            return f"$${data['text/latex'].strip().strip('$').strip()}$$"
        if "text/markdown" in data:
            return data["text/markdown"]
        return "" if "text/html" in data or not data else f"```text\n{data['text/plain']}\n```"


def _heading(cell: dict) -> bool:
    return cell["cell_type"] == "markdown" and "".join(cell["source"]).startswith("#")


def _folded(cell: dict) -> bool:
    return bool(cell["metadata"].get("jupyter", {}).get("source_hidden"))


def _in_columns(table: str) -> str:
    """The table with columns as wide as what stands in them, if it does not say how wide they are.

    Pandoc takes the widths from the dashes.
    """
    lines = table.splitlines()
    if "----" in lines[1]:
        return table
    rows = [re.split(r"(?<!\\)\|", row.strip().strip("|")) for row in lines]
    longest = [
        max(len(LINK.sub(r"\1", cell).strip()) for cell in column)
        for column in zip(*rows[:1], *rows[2:], strict=False)
    ]
    dashes = "|".join(":" + "-" * min(max(width, 10), 40) for width in longest)
    return "\n".join([lines[0], f"|{dashes}|", *lines[2:]])


def _inside(text: str, target: str, labels: set[str]) -> str:
    """The link as one within the book, or to another host, or as its text where it leads to neither."""
    if target.startswith("http"):
        return f"[{text}]({target})"
    path, _, cell = target.partition("#cell-id=")
    label = next((name for name in (cell, Path(path).stem) if name in labels), None)
    return f"[{text}](#{label})" if label else text


def _marked(source: str, terms: list[str]) -> str:
    """The text with an index mark behind the first place of each term."""
    parts = APART.split(source)
    for term in terms:
        word = re.compile(rf"\b{re.escape(term)}\w*", re.IGNORECASE)
        for i in range(0, len(parts), 2):
            found = word.search(parts[i])
            if found:
                mark = f'`#marked("{term}")`{{=typst}}'
                parts[i] = parts[i][: found.end()] + mark + parts[i][found.end() :]
                break
    return "".join(parts)
