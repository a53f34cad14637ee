"""Shows a figure with a text for readers who do not see it."""

import base64
import html
import io
from dataclasses import dataclass

from matplotlib.figure import Figure
from PIL import Image

PIXELS_PER_INCH = 96
OVERSAMPLING = 1.5


@dataclass(frozen=True)
class Picture:
    """A figure with the text that stands for it; as a cell's last line it shows itself.

    `alt` says what the figure shows, for readers who do not see it: it becomes the image's
    alternative text in JupyterLab and in nbconvert's pages, and the plain text of the output.
    JupyterLab has no alternative text for image/png outputs, hence the HTML beside it. Raises
    ValueError if alt is empty.
    """

    figure: Figure
    alt: str

    def __post_init__(self):
        check_alt(self.alt)

    def _repr_mimebundle_(self, include=None, exclude=None):
        png = encoded_png(self.figure)
        width, height = size_in_pixels(self.figure)
        data = {
            "text/html": image_tag(png, self.alt, width),
            "image/png": png,
            "text/plain": self.alt,
        }
        return data, {"image/png": {"alt": self.alt, "width": width, "height": height}}


def check_alt(alt: str) -> None:
    if not alt.strip():
        raise ValueError("alt: needs a sentence that says what the figure shows")


def size_in_pixels(figure: Figure) -> tuple[int, int]:
    width, height = (round(PIXELS_PER_INCH * length) for length in figure.get_size_inches())
    return width, height


def image_tag(png: str, alt: str, width: int) -> str:
    return f'<img src="data:image/png;base64,{png}" alt="{html.escape(alt)}" width="{width}">'


def encoded_png(figure: Figure, oversampling: float = OVERSAMPLING, colours: int = 64) -> str:
    """PNG with few colours, in base64: a third of the size, which counts in a notebook in git."""
    drawn, small = io.BytesIO(), io.BytesIO()
    figure.savefig(drawn, format="png", dpi=oversampling * PIXELS_PER_INCH)
    with Image.open(drawn) as image:
        reduced = image.convert("RGB").quantize(colours, Image.Quantize.FASTOCTREE)
    reduced.save(small, format="png", optimize=True)
    return base64.b64encode(small.getvalue()).decode()
