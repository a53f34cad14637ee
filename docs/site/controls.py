"""The controls of the lessons, found by running the cells that lead to them.

A control is a cell with `ipywidgets.interact` over a function of `plotting.live`.
"""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ipywidgets
import nbformat
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from armdyn.plotting import Live


@dataclass(frozen=True)
class Input:
    """One slider or one box to tick: what it may be set to, and how that reads."""

    label: str
    values: tuple[Any, ...]
    texts: tuple[str, ...]
    start: int
    is_box: bool = False


@dataclass(frozen=True)
class Control:
    """A cell's id, its inputs, its function, and what the function is called with: one value each."""

    cell: str
    inputs: tuple[Input, ...]
    live: Live
    arguments: Callable[[tuple[Any, ...]], dict[str, Any]]


def has_control(lesson: Path) -> bool:
    return "ipywidgets.interact(" in lesson.read_text(encoding="utf-8")


def control_of(lesson: Path) -> Control:
    """The lesson's control. Runs, in this process, the cells up to it, but for self-tests."""
    notebook = nbformat.read(lesson, as_version=4)
    InteractiveShell.clear_instance()
    shell = InteractiveShell.instance()
    here = Path.cwd()
    os.chdir(lesson.parent)
    try:
        for cell in notebook.cells:
            if cell.cell_type == "code" and "self-test" not in cell.metadata.get("tags", []):
                with capture_output():
                    ran = shell.run_cell(cell.source)
                ran.raise_error()
                for value in shell.user_ns.values():
                    if isinstance(getattr(value, "widget", None), ipywidgets.interactive):
                        return _control(cell.id, value.widget)
    finally:
        InteractiveShell.clear_instance()
        os.chdir(here)
    raise ValueError(f"{lesson.name}: no cell made a control by ipywidgets.interact")


def _control(cell: str, shown: ipywidgets.interactive) -> Control:
    if not isinstance(shown.f, Live):
        raise TypeError(f"{cell}: its function needs @plotting.live below ipywidgets.interact")
    inputs = {widget._kwarg: list(_inputs(widget)) for widget in shown.kwargs_widgets}

    def arguments(values: tuple[Any, ...]) -> dict[str, Any]:
        rest, found = iter(values), {}
        for name, parts in inputs.items():
            own = [next(rest) for _ in parts]
            ticked = tuple(
                part.label for part, value in zip(parts, own, strict=True) if value is True
            )
            found[name] = ticked if parts[0].is_box else own[0]
        return found

    return Control(
        cell, tuple(part for parts in inputs.values() for part in parts), shown.f, arguments
    )


def _inputs(widget: ipywidgets.Widget) -> Iterator[Input]:
    name = widget.description or widget._kwarg
    match widget:
        case ipywidgets.IntSlider() | ipywidgets.FloatSlider():
            steps = round((widget.max - widget.min) / widget.step)
            whole = isinstance(widget, ipywidgets.IntSlider)
            found = (widget.min + k * widget.step for k in range(steps + 1))
            values = tuple(value if whole else round(value, 10) for value in found)
            texts = tuple(
                format(value, widget.readout_format).replace("-", "−") for value in values
            )
            start = round((widget.value - widget.min) / widget.step)
            yield Input(name, values, texts, start)
        case ipywidgets.SelectionSlider():
            texts = tuple(str(label) for label in widget._options_labels)
            yield Input(name, tuple(widget._options_values), texts, widget.index)
        case ipywidgets.SelectMultiple():
            for label in widget._options_labels:
                yield Input(
                    label, (False, True), ("off", "on"), int(label in widget.label), is_box=True
                )
        case _:
            raise TypeError(f"{name}: no way to show a {type(widget).__name__} without a kernel")
