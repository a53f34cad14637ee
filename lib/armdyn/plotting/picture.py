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
        return picture_bundle(encoded_png(self.figure), self.alt, size_in_pixels(self.figure))


def picture_bundle(
    png: str, alt: str, size: tuple[int, int], tag: str = ""
) -> tuple[dict[str, str], dict[str, dict]]:
    """What a notebook shows of a picture, and what it has to know of it; png in base64."""
    width, height = size
    tag = tag or image_tag(png, alt, width)
    data = {"text/html": tag, "image/png": png, "text/plain": alt}
    return data, {"image/png": {"alt": alt, "width": width, "height": height}}


def check_alt(alt: str) -> None:
    if not alt.strip():
        raise ValueError("alt: needs a sentence that says what the figure shows")


def size_in_pixels(figure: Figure) -> tuple[int, int]:
    width, height = (round(PIXELS_PER_INCH * length) for length in figure.get_size_inches())
    return width, height


def image_tag(png: str, alt: str, width: int, height: int | None = None) -> str:
    """With the height, a page knows the image's place before the image is decoded."""
    place = "" if height is None else f' height="{height}" style="height:auto"'
    return (
        f'<img src="data:image/png;base64,{png}" alt="{html.escape(alt)}" width="{width}"{place}>'
    )


def encoded_png(figure: Figure, oversampling: float = OVERSAMPLING, colours: int = 64) -> str:
    """PNG with few colours, in base64: a third of the size, which counts in a notebook in git."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=oversampling * PIXELS_PER_INCH)
    with Image.open(drawn) as image:
        return _few_colours(image.convert("RGB"), colours, optimize=True)


def quick_png(image: Image.Image) -> str:
    """The same of pixels, written at once and a little larger."""
    return _few_colours(image, 64, compress_level=1)


def _few_colours(image: Image.Image, colours: int, **how) -> str:
    file = io.BytesIO()
    image.quantize(colours, Image.Quantize.FASTOCTREE).save(file, format="png", **how)
    return base64.b64encode(file.getvalue()).decode()
