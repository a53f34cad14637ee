"""Pictures and sentences as a notebook's output: an image where no script runs, else SVG that plays."""

import base64
import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from importlib import resources

SLOWER = 4  # times slower than the motion
STILL = "A still picture: run the cell, or trust the notebook, to see it move."


@dataclass(frozen=True)
class Shown:
    """A picture with what is said of it. svg: "" for none. alt: what is seen, in a sentence. motion:
    what the player moves, {} for a picture that stands still.
    """

    title: str
    said: Sequence[str]
    svg: str = ""
    alt: str = ""
    motion: dict = field(default_factory=dict)


def mimebundle(heading: str, pictures: Sequence[Shown]) -> dict[str, str]:
    """The pictures for a notebook's output: plain text, and HTML."""
    lines = [heading]
    for shown in pictures:
        lines += [f"  {line}" for line in (shown.title, *shown.said) if line]
    inside = "".join(_section(shown) for shown in pictures)
    html = (
        f'<div class="armdyn-watch" role="group" aria-label="{escape(heading)}"'
        ' style="border-left: 5px solid #0072B2; padding: 0.4em 0.9em; max-width: 46em">'
        f'<p style="margin: 0.2em 0"><strong>{escape(heading)}</strong></p>{inside}</div>'
    )
    return {"text/plain": "\n".join(lines), "text/html": html}


def _section(shown: Shown) -> str:
    # A sentence may quote a student's error. As a formula, the quote could be a link that runs code.
    said = "".join(
        f'<p class="tex2jax_ignore mathjax_ignore" style="margin: 0.3em 0">{escape(sentence)}</p>'
        for sentence in shown.said
    )
    title = (
        f'<p style="margin: 0.6em 0 0.2em"><em>{escape(shown.title)}</em></p>'
        if shown.title
        else ""
    )
    return f"{title}{said}{_picture(shown) if shown.svg else ''}"


def _picture(shown: Shown) -> str:
    image = base64.b64encode(shown.svg.encode()).decode()
    # "<" could close the script's element.
    data = json.dumps({"slower": SLOWER, **shown.motion}, separators=(",", ":")).replace(
        "<", "\\u003c"
    )
    key = hashlib.sha256((shown.svg + data).encode()).hexdigest()[:12]
    player = _script("autograder", "pictures/player.js")
    # By its file: importing armdyn.plotting would bring Matplotlib into the student's kernel.
    player = player.replace("@CONTROLS@", _script("armdyn", "plotting/controls.js"))
    still = f"<p data-still-only>{STILL}</p>" if shown.motion else ""
    return (
        f'<div data-armdyn-picture="{key}">'
        f'<img alt="{escape(shown.alt)}" style="max-width: 100%; height: auto"'
        f' src="data:image/svg+xml;base64,{image}">{still}</div>'
        f"<script>{player.replace('@KEY@', key).replace('@DATA@', data)}</script>"
    )


def _script(package: str, path: str) -> str:
    return resources.files(package).joinpath(path).read_text(encoding="utf-8")
