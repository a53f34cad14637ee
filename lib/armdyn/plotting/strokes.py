"""Writes what an artist draws as SVG, for a page that shows it without Python."""

from functools import cache
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.textpath import TextToPath
from matplotlib.transforms import Affine2D

from armdyn.plotting.picture import PIXELS_PER_INCH, size_in_pixels

TENTHS = 10  # whole tenths of a page's pixel are fine enough, and short
HATCH_TILE = TENTHS * PIXELS_PER_INCH
LETTERS = {
    Path.MOVETO: ("m", 1),
    Path.LINETO: ("l", 1),
    Path.CURVE3: ("q", 2),
    Path.CURVE4: ("c", 3),
    Path.CLOSEPOLY: ("z", 1),
}
WRITER = TextToPath()  # it remembers the formulas that it has read
CAPS = {"projecting": "square"}


def strokes_of(artist: Artist, figure: Figure) -> str:
    """The SVG elements that the artist is on the figure, which has been laid out.

    Lengths are in tenths of a pixel of `size_in_pixels`, from the upper left corner. Text becomes
    outlines, as it is in matplotlib's own pictures. Raises NotImplementedError for an image.
    """
    pen = _Pen(figure)
    artist.draw(pen)
    return "".join(pen.elements)


class _Pen(RendererBase):
    """Writes down what matplotlib draws; all but text and images comes to `draw_path`."""

    def __init__(self, figure: Figure):
        super().__init__()
        self._text2path = WRITER
        self.elements: list[str] = []
        self._dpi = figure.get_dpi()
        self._scale = TENTHS * PIXELS_PER_INCH / self._dpi
        # matplotlib's own pictures have whole pixels, and so has the picture on the page.
        self._size = int(figure.bbox.width), int(figure.bbox.height)
        width, height = (TENTHS * length for length in size_in_pixels(figure))
        down = Affine2D().scale(width / self._size[0], -height / self._size[1])
        self._down = down.translate(0, height)

    def get_canvas_width_height(self) -> tuple[int, int]:
        return self._size

    def points_to_pixels(self, points: Any) -> Any:
        return points * self._dpi / 72

    def draw_path(self, gc: Any, path: Path, transform: Any, rgbFace: Any = None) -> None:
        box = gc.get_clip_rectangle()
        lines_only = rgbFace is None and gc.get_hatch() is None
        # Only a line may be cut: a cut outline would be filled another way.
        cut = box.extents if box is not None and lines_only else None
        drawn = path.cleaned(transform, clip=cut, curves=True, simplify=lines_only or None)
        outline = _outline(drawn.transformed(self._down))
        if not outline:
            return
        element = f'<path d="{outline}" {self._fill(gc, rgbFace)}{self._line(gc)}/>'
        if box is not None:
            element = self._clipped(element, box)
        self.elements.append(element)

    def draw_text(
        self, gc: Any, x: float, y: float, s: str, prop: Any, angle: float, ismath: Any = False,
        mtext: Any = None,
    ) -> None:  # fmt: skip
        size = self._scale * self.points_to_pixels(prop.get_size_in_points())
        letters = _letters(prop, s, bool(ismath), size, angle)
        left, top = self._down.transform((x, self._size[1] - y))
        at = f"{left:.0f} {top:.0f}"
        colour = _colour(gc.get_rgb())
        self.elements.append(f'<path d="{letters}" transform="translate({at})" fill="{colour}"/>')

    def _line(self, gc: Any) -> str:
        width = self._length(gc.get_linewidth())
        if not width:
            return ""
        cap = CAPS.get(gc.get_capstyle(), gc.get_capstyle())
        look = f' stroke="{_colour(gc.get_rgb())}" stroke-width="{width}" stroke-linecap="{cap}"'
        look += f' stroke-linejoin="{gc.get_joinstyle()}"'
        offset, dashes = gc.get_dashes()
        if dashes:
            look += f' stroke-dasharray="{" ".join(str(self._length(d)) for d in dashes)}"'
            look += f' stroke-dashoffset="{self._length(offset)}"'
        return look

    def _fill(self, gc: Any, face: Any) -> str:
        filling = "none" if face is None else _colour(face)
        if gc.get_hatch() is None:
            return f'fill="{filling}"'
        width = self._length(gc.get_hatch_linewidth())
        name, pattern = _pattern(gc.get_hatch(), filling, _colour(gc.get_hatch_color()), width)
        self.elements.append(pattern)
        return f'fill="url(#{name})"'

    def _clipped(self, element: str, box: Any) -> str:
        """The element inside the box: an inner svg shows nothing outside itself."""
        (x0, y1), (x1, y0) = self._down.transform(box.get_points()).round().astype(int)
        place = f"{x0} {y0} {x1 - x0} {y1 - y0}"
        x, y, width, height = place.split()
        at = f'x="{x}" y="{y}" width="{width}" height="{height}"'
        return f'<svg {at} viewBox="{place}">{element}</svg>'

    def _length(self, points: float) -> int:
        return round(self.points_to_pixels(points) * self._scale)


@cache
def _pattern(hatch: str, filling: str, ink: str, width: int) -> tuple[str, str]:
    """The name of a filling with a hatch, and its element; the same one may stand in a page twice."""
    name = f"hatch-{hatch.encode().hex()}-{filling[1:]}-{ink[1:]}-{width}"
    tile = Affine2D().scale(HATCH_TILE, -HATCH_TILE)
    lines = _outline(Path.hatch(hatch).transformed(tile))
    return name, (
        f'<pattern id="{name}" width="{HATCH_TILE}" height="{HATCH_TILE}" '
        'patternUnits="userSpaceOnUse">'
        f'<path d="m0 0h{HATCH_TILE}v{HATCH_TILE}h-{HATCH_TILE}z" fill="{filling}"/>'
        f'<path d="{lines}" transform="translate(0 {HATCH_TILE})" fill="{ink}" stroke="{ink}" '
        f'stroke-width="{width}"/></pattern>'
    )


@cache
def _letters(font: FontProperties, text: str, is_math: bool, size: float, angle: float) -> str:
    """The outline of the text, which begins at the origin; size: of an em, in tenths of a pixel."""
    vertices, codes = WRITER.get_text_path(font, text, ismath=is_math)
    outline = Path(vertices, codes)
    scale = size / WRITER.FONT_SCALE
    return _outline(outline.transformed(Affine2D().scale(scale, -scale).rotate_deg(-angle)))


def _outline(path: Path) -> str:
    """The path's data, each point from the one before it, in whole numbers."""
    vertices = np.asarray(path.vertices)
    if path.codes is None:
        path = Path(vertices, [Path.MOVETO] + [Path.LINETO] * (len(vertices) - 1))
    written: list[str] = []
    last, start, k = (0, 0), (0, 0), 0
    points = np.rint(vertices).astype(int).tolist()
    codes = np.asarray(path.codes).tolist()
    while k < len(codes) and codes[k] != Path.STOP:
        letter, length = LETTERS[codes[k]]
        x, y = last
        numbers = [(px - x, py - y) for px, py in points[k : k + length]]
        if letter == "z":
            written.append("z")
            last = start
        elif letter != "l" or numbers != [(0, 0)]:
            written.append(letter + " ".join(f"{dx} {dy}" for dx, dy in numbers))
            last = tuple(points[k + length - 1])
            start = last if letter == "m" else start
        k += length
    return "".join(written)


def _colour(rgb: Any) -> str:
    """#rrggbb, and aa where it is not opaque."""
    parts = [round(255 * value) for value in rgb]
    if len(parts) == 4 and parts[3] == 255:
        parts.pop()
    return "#" + "".join(f"{part:02x}" for part in parts)
