"""Computes the pictures of the lessons' controls, each control as a piece of HTML for its page."""

import base64
import json
import zlib
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from armdyn.plotting.picture import image_tag, quick_png, size_in_pixels
from docs.site.controls import Control, control_of, has_control
from docs.site.grid import choose, settings

# A page with its text and its figures then stays below 2 MB.
LARGEST = 1_500_000


def write_controls(lessons: Path, folder: Path, most: int) -> None:
    """Write a file, CELL.html, into the folder for each control.

    most: its pictures, at most; fewer, where they would be more than a page may hold.
    """
    folder.mkdir()
    paths = sorted(filter(has_control, lessons.glob("*.ipynb")))
    # A process a lesson: the names that one defines are not another's.
    with ProcessPoolExecutor(mp_context=get_context("spawn"), max_tasks_per_child=1) as pool:
        list(pool.map(_write, paths, [folder] * len(paths), [most] * len(paths)))


def _write(lesson: Path, folder: Path, most: int) -> None:
    control = control_of(lesson)
    (folder / f"{control.cell}.html").write_text(fitting(control, most), encoding="utf-8")


def fitting(control: Control, most: int, largest: int = LARGEST) -> str:
    """The control's element, with half as many pictures until it is no longer than `largest`."""
    while len(text := element(control, most)) > largest and most > 1:
        most //= 2
    return text


def element(control: Control, most: int) -> str:
    """The still picture, and the data that controls.js makes a control of, deflated.

    Raises ValueError where the axes change with the inputs: a page holds them once.
    """
    kept, together = choose(control.inputs, most)
    starts = [values.index(part.start) for values, part in zip(kept, control.inputs, strict=True)]

    def arguments(setting: tuple[int, ...]) -> dict:
        places = zip(control.inputs, kept, setting, strict=True)
        return control.arguments(tuple(part.values[values[k]] for part, values, k in places))

    still = control.live(**arguments(tuple(starts)))
    background = quick_png(control.live.background())
    width, height = size_in_pixels(control.live.figure)
    parts: dict[str, int] = {}
    frames = {}
    for setting in settings(kept, starts, together):
        drawn, alt = control.live.strokes(**arguments(setting))
        numbers = [parts.setdefault(part, len(parts)) for part in drawn]
        frames[",".join(map(str, setting))] = [alt, *numbers]
        if control.live.background_changed:
            raise ValueError(f"{control.cell}: its axes change with its inputs; set their limits")
    data = {
        "size": [width, height],
        "inputs": [
            {
                "label": part.label,
                "texts": [part.texts[k] for k in values],
                "start": start,
                "box": part.is_box,
            }
            for part, values, start in zip(control.inputs, kept, starts, strict=True)
        ],
        "coarser": any(
            len(v) < len(part.values) for v, part in zip(kept, control.inputs, strict=True)
        ),
        "together": together,
        "background": background,
        "parts": list(parts),
        "frames": frames,
    }
    packed = zlib.compress(json.dumps(data, separators=(",", ":")).encode(), 9)
    return (
        f'<div class="armdyn-control" data-control="{control.cell}">'
        f"{image_tag(still.png, still.alt, width, height)}"
        f'<script type="text/plain">{base64.b64encode(packed).decode()}</script></div>'
    )
