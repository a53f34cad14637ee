"""Puts pictures into a page, so that it needs no file beside it and no other host."""

import base64
import binascii
import io
import re
import unicodedata
import warnings
from collections.abc import Iterator, Mapping
from functools import cached_property
from html import escape, unescape
from itertools import islice
from pathlib import Path
from urllib.parse import unquote

from defusedxml import ElementTree

from autograder.protocol import one_line

MOST_FILES = 500  # that are looked at in a folder
MOST_READ = 32 << 20  # bytes of one picture's file
MOST_KEPT = 1 << 20  # bytes that go into a page as they are; a larger photo is made smaller
MOST_DRAWN = 2 << 20  # bytes of a drawing (SVG), which cannot be made smaller
MOST_PIXELS = 120_000_000
MOST_OF_A_PAGE = 24 << 20
WIDEST = 2000  # pixels: a hand-written line can still be read
SHOWN_BY_BROWSERS = {"PNG": "png", "JPEG": "jpeg", "MPO": "jpeg", "GIF": "gif", "WEBP": "webp"}
READABLE = ("PNG", "JPEG", "GIF", "WEBP", "TIFF", "BMP")
PICTURES = (".bmp", ".gif", ".heic", ".jpeg", ".jpg", ".png", ".svg", ".tif", ".tiff", ".webp")
DATA = re.compile(r"data:[\w.+/-]*(;[\w=.-]+)*;base64,", re.IGNORECASE)
ELSEWHERE = re.compile(r"https?:|//", re.IGNORECASE)
ATTACHED = "attachment:"
IN_TEXT = "the picture in the text"


class NotShownError(Exception):
    """A picture cannot be shown; the message says why, to who wrote it and to who reads it."""


class Pictures:
    """The pictures of one page, up to MOST_OF_A_PAGE.

    folder: where the notebook is, or None; its files are looked for there.
    """

    def __init__(self, folder: Path | None):
        self._folder = folder
        self._left = MOST_OF_A_PAGE
        self._shown: set[Path] = set()

    def img(
        self, url: str, alt: str, attachments: object = None, size: Mapping[str, str] | None = None
    ) -> str:
        """The picture as an <img> with everything in it, or a sentence that says why there is none.

        url: as a student wrote it. attachments: the cell's own. size: width and height, if given.
        """
        try:
            address = self._address(url.strip(), attachments)
        except (NotShownError, OSError) as error:
            return f'<em class="not-shown">(picture not shown: {escape(str(error))})</em>'
        sizes = "".join(
            f' {name}="{value}"' for name, value in (size or {}).items() if _is_size(value)
        )
        return f'<img src="{address}" alt="{escape(alt)}"{sizes}>'

    def beside(self) -> list[str]:
        """An image or a sentence for each picture of the folder that no cell shows, with its name."""
        found = []
        for path in self._files:
            if path not in self._shown and path.suffix.lower() in PICTURES:
                name = escape(one_line(path.name, 100))
                shown = self.img(str(path.relative_to(self._folder or path.parent)), path.name)
                found.append(f"<figure><figcaption>{name}</figcaption>{shown}</figure>")
        return found

    def _address(self, url: str, attachments: object) -> str:
        if ELSEWHERE.match(url):
            raise NotShownError(f"it is on another host, {_named(url)}; hand in the file itself")
        if url.lower().startswith(ATTACHED):
            data, name = _attached(url[len(ATTACHED) :], attachments), url[len(ATTACHED) :]
        elif match := DATA.match(url):
            data, name = _decoded(url[match.end() :], IN_TEXT), IN_TEXT
        else:
            path = self._file(url)
            data, name = path.read_bytes(), path.name
            self._shown.add(path)
        kind, data = _fit(data, _named(unquote(name)))
        text = base64.b64encode(data).decode()
        if len(text) > self._left:
            raise NotShownError(
                f"the pictures of a page may take {MOST_OF_A_PAGE >> 20} MB in all, and "
                f"{_named(unquote(name))} would be more"
            )
        self._left -= len(text)
        return f"data:image/{kind};base64,{text}"

    def _file(self, url: str) -> Path:
        by_key: dict[str, Path] = {}
        for path in self._files:
            by_key.setdefault(_key(str(path.relative_to(self._folder or path.parent))), path)
        without_query = re.split(r"[?#]", url, maxsplit=1)[0]
        for written in (url, unescape(url), without_query):
            for name in (written, unquote(written)):
                found = by_key.get(_key(name)) if _key(name) else None
                if found is not None and found.stat().st_size > MOST_READ:
                    raise NotShownError(f"{_named(found.name)} has more than {MOST_READ >> 20} MB")
                if found is not None:
                    return found
        raise NotShownError(f"{_named(unquote(url))} was not handed in with the notebook")

    @cached_property
    def _files(self) -> list[Path]:
        return list(islice(_plain_files(self._folder), MOST_FILES)) if self._folder else []


def _plain_files(folder: Path) -> Iterator[Path]:
    """The files of a folder and of those in it, without links and hidden ones, in order."""
    if not folder.is_dir() or folder.is_symlink():
        return
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or path.is_symlink():
            continue
        if path.is_dir():
            yield from _plain_files(path)
        elif path.is_file():
            yield path


def _key(name: str) -> str:
    """The same for all ways in which systems and editors write one file's name; "" for no name of a
    file beside the notebook.
    """
    parts = unicodedata.normalize("NFC", name.replace("\\", "/")).casefold().split("/")
    if not parts[0]:
        return ""
    # A narrow space, as macOS puts it into names, is a space like any other.
    return "/".join(" ".join(part.split()) for part in parts if part not in ("", "."))


def _attached(name: str, attachments: object) -> bytes:
    """A cell's attachment. NotShownError if the notebook does not hold it, or not as a picture."""
    held = attachments if isinstance(attachments, Mapping) else {}
    by_key = {_key(str(known)): bundle for known, bundle in held.items()}
    bundle = held.get(name, by_key.get(_key(name), by_key.get(_key(unquote(name)))))
    if bundle is None:
        raise NotShownError(f"the notebook does not hold {_named(unquote(name))}; insert it again")
    texts = bundle.values() if isinstance(bundle, Mapping) else ()
    for text in texts:
        text = "".join(map(str, text)) if isinstance(text, list) else text
        if not isinstance(text, str):
            continue
        if text.lstrip().startswith("<"):  # some editors store a drawing as it is
            return text.encode()
        return _decoded(text, _named(unquote(name)))
    raise NotShownError(f"the notebook holds {_named(unquote(name))}, but not as a picture")


def _decoded(text: str, name: str) -> bytes:
    try:
        return base64.b64decode("".join(unquote(text).split()), validate=True)
    except (ValueError, binascii.Error):
        raise NotShownError(f"{name} is damaged") from None


def _fit(data: bytes, name: str) -> tuple[str, bytes]:
    """The kind, and bytes that a browser shows. NotShownError, which says what is wrong with them."""
    head = data[:2000].lstrip(b"\xef\xbb\xbf \t\r\n")
    if head[:1] == b"<" and b"<svg" in data[:20_000]:
        return _drawing(data, name)
    if head[4:12] in (b"ftypheic", b"ftypheix", b"ftypmif1", b"ftyphevc"):
        raise NotShownError(f"{name} is a HEIC photo, which browsers do not show; save it as JPEG")
    if head.startswith(b"%PDF"):
        raise NotShownError(f"{name} is a PDF; it lies beside the notebook")

    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with (
            warnings.catch_warnings(action="ignore"),  # of large or of odd pictures
            Image.open(io.BytesIO(data), formats=READABLE) as image,
        ):
            if image.width * image.height > MOST_PIXELS:
                raise NotShownError(f"{name} has more than {MOST_PIXELS // 1_000_000} megapixels")
            kind = SHOWN_BY_BROWSERS.get(image.format or "")
            if kind and len(data) <= MOST_KEPT:
                image.verify()
                return kind, data
            image.draft("RGB", (WIDEST, WIDEST))  # a JPEG is read at a fraction of its size
            upright = ImageOps.exif_transpose(image)
            upright.thumbnail((WIDEST, WIDEST))
            drawn = io.BytesIO()
            is_clear = upright.mode in ("RGBA", "LA", "PA", "P")
            upright = upright.convert("RGBA" if is_clear else "RGB")
            if is_clear and kind == "png":
                upright.save(drawn, "PNG")
                return "png", drawn.getvalue()
            paper = Image.new("RGB", upright.size, "white")
            paper.paste(upright, mask=upright if is_clear else None)
            paper.save(drawn, "JPEG", quality=80)
            return "jpeg", drawn.getvalue()
    except NotShownError:
        raise
    except (UnidentifiedImageError, Image.DecompressionBombError):
        raise NotShownError(f"{name} is no picture that can be read") from None
    except Exception:  # a decoder may raise anything where a file is damaged
        raise NotShownError(f"{name} is damaged") from None


def _drawing(data: bytes, name: str) -> tuple[str, bytes]:
    """An SVG. As an <img> it runs nothing and loads nothing, whatever it holds."""
    if len(data) > MOST_DRAWN:
        raise NotShownError(f"the drawing {name} has more than {MOST_DRAWN >> 20} MB")
    try:
        ElementTree.fromstring(data)
    except Exception:  # no XML, or XML that unfolds itself without end
        raise NotShownError(f"the drawing {name} is damaged") from None
    return "svg+xml", data


def _named(name: str) -> str:
    return one_line(name, 100)


def _is_size(value: str) -> bool:
    return re.fullmatch(r"\d{1,4}(px|%)?", value) is not None
