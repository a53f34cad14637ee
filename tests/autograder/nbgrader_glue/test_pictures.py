"""A student's pictures: each is in the page, whatever its name and kind, or a sentence says why not."""

import base64
import io
import re
import struct
import unicodedata
import zlib

import pytest
from PIL import Image

from autograder.nbgrader_glue import pictures
from autograder.nbgrader_glue.markdown import markdown2html, pictures_beside

SVG = b'<svg xmlns="http://www.w3.org/2000/svg"><script>forged()</script><rect width="9"/></svg>'
BOMB = b'<!DOCTYPE b [<!ENTITY a "aaaaaaaa"><!ENTITY b "&a;&a;&a;">]><svg>&b;</svg>'
HEIC = b"\0\0\0\x18ftypheic\0\0\0\0mif1heic"


def drawn(kind: str, size=(6, 4), noise: bool = False, **options) -> bytes:
    file = io.BytesIO()
    picture = (
        Image.effect_noise(size, 90).convert("RGB") if noise else Image.new("RGB", size, "red")
    )
    picture.save(file, kind, **options)
    return file.getvalue()


PNG = drawn("PNG")


def claiming(width: int, height: int) -> bytes:
    """A PNG that says that it has this size."""
    head = b"IHDR" + struct.pack(">II", width, height) + PNG[24:29]
    return PNG[:12] + head + struct.pack(">I", zlib.crc32(head)) + PNG[33:]


@pytest.fixture
def page(tmp_path):
    """Shows Markdown of a notebook in tmp_path, beside which the files are."""
    resources = {"metadata": {"path": str(tmp_path)}}

    def show(source: str, attachments=None) -> str:
        page.resources = resources
        return markdown2html({"cell": {"attachments": attachments}, "resources": resources}, source)

    page.resources = resources
    show.resources = resources
    return show


def addresses(shown: str) -> list[str]:
    return re.findall(r'<img src="([^"]*)"', shown)


@pytest.mark.parametrize(("name", "written"), [
    ("x.png", ["x.png", "./x.png", "././x.png", "X.PNG", ".\\x.png", "x.png?raw=1", "x.png#p"]),
    ("my page.png", ["my%20page.png", "<my page.png>", "my page.png", "my%C2%A0page.png"]),
    ("Shot at 9.41\u202fAM.png", ["Shot%20at%209.41%E2%80%AFAM.png", "Shot at 9.41\u202fAM.png",
                                  "Shot%20at%209.41%20AM.png", "<Shot at 9.41 AM.png>"]),
    (unicodedata.normalize("NFD", "Übung größer.png"), ["<Übung größer.png>", "Übung größer.png",
     unicodedata.normalize("NFC", "Übung%20größer.png"), "%C3%9Cbung%20gr%C3%B6%C3%9Fer.png"]),
    ("page (1).png", ["page (1).png", "page%20(1).png", "<page (1).png>", "page%20%281%29.png"]),
    ("page(1).png", ["page(1).png", "page%281%29.png"]),
    ("a,b;c.png", ["a,b;c.png"]), ("a&b.png", ["a&b.png", "a&amp;b.png", "a%26b.png"]),
    ("it's=+~@$!.png", ["it's=+~@$!.png"]), ("100%.png", ["100%.png", "100%25.png"]),
    ("#1.png", ["%231.png"]), ("p[1].png", ["p[1].png"]), ("a_b_c.png", ["a_b_c.png"]),
    ("sub/y z.png", ["sub/y%20z.png", "./sub/./y z.png", "sub\\y z.png"]), ("écran.JPG", ["écran.jpg"]),
])  # fmt: skip
def test_a_picture_is_found_however_its_name_is_written(name, written, page, tmp_path):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_bytes(PNG)
    forms = [f"![p]({one})" for one in written]
    forms += [f'<img src="{one.strip("<>")}">' for one in written]
    for form in forms:
        assert addresses(page(form)) == [
            f"data:image/png;base64,{base64.b64encode(PNG).decode()}"
        ], form


@pytest.mark.parametrize(("data", "kind"), [
    (PNG, "png"), (drawn("JPEG"), "jpeg"), (drawn("GIF"), "gif"), (drawn("WEBP"), "webp"),
    (SVG, "svg+xml"),
    (b"\xef\xbb\xbf<?xml version='1.0'?><!-- x -->" + SVG, "svg+xml"), (drawn("TIFF"), "jpeg"),
    (drawn("BMP"), "jpeg"), (drawn("JPEG", (2500, 1800), noise=True, quality=95), "jpeg"),
])  # fmt: skip
def test_kinds_of_pictures(data, kind, page, tmp_path):
    (tmp_path / "p.png").write_bytes(data)  # the name may be wrong
    (address,) = addresses(page("![p](p.png)"))
    assert address.startswith(f"data:image/{kind};base64,")
    inside = base64.b64decode(address.partition(",")[2])
    assert len(inside) < 1.5 * pictures.MOST_KEPT  # noise, which no format makes small
    if kind != "svg+xml":
        assert max(Image.open(io.BytesIO(inside)).size) <= pictures.WIDEST


@pytest.mark.parametrize(("source", "said"), [
    ("![p](lost.png)", "lost.png was not handed in"), ("![p](../up.png)", "up.png was not handed in"),
    ("![p](/etc/hostname)", "was not handed in"), ("![p](file:///etc/hostname)", "was not handed in"),
    ("![p](link.png)", "link.png was not handed in"), ("![p](.hidden.png)", "was not handed in"),
    ("![p](https://h.org/x.png)", "it is on another host, https://h.org/x.png"),
    ('<img src="//h.org/x.png">', "it is on another host"), ("![p](heic.jpg)", "save it as JPEG"),
    ("![p](p.pdf)", "p.pdf is a PDF"), ("![p](text.png)", "text.png is no picture"),
    ("![p](cut.png)", "cut.png is "), ("![p](bomb.svg)", "the drawing bomb.svg is damaged"),
    ("![p](wide.png)", "megapixels"), ("![p](attachment:no.png)", "does not hold no.png"),
    ("![p](attachment:odd.png)", "not as a picture"), ("![p](attachment:none.png)", "not as a picture"),
    ("![p](attachment:bad.png)", "bad.png is damaged"), ("![p](data:image/png;base64,@@)", "is damaged"),
    ("![p](javascript:forged())", "was not handed in"),
    ("![p](data:text/html,<b>x</b>)", "was not handed in"),
    ("![p](data:text/html;base64,PGI+)", "is no picture"), ('<img alt="p">', "was not handed in"),
])  # fmt: skip
def test_what_cannot_be_shown_says_so_at_its_place(source, said, page, tmp_path):
    (tmp_path.parent / "up.png").write_bytes(PNG)
    (tmp_path / "link.png").symlink_to(tmp_path.parent / "up.png")
    for name, data in {
        ".hidden.png": PNG, "heic.jpg": HEIC, "p.pdf": b"%PDF-1.7", "text.png": b"words",
        "bomb.svg": BOMB, "cut.png": PNG[:-20], "wide.png": claiming(20_000, 7_000),
    }.items():  # fmt: skip
        (tmp_path / name).write_bytes(data)
    own = {"odd.png": 3, "none.png": {}, "bad.png": {"image/png": "@@"}}
    shown = page(f"before {source} after **bold** $x$", own)
    assert addresses(shown) == []
    assert said in shown
    assert "picture not shown: " in shown
    assert re.search("(?s)^<p>before .* after <strong>bold</strong> <math", shown)


def test_attachments_are_shown_in_markdown_and_in_html(page):
    text = base64.b64encode(PNG).decode()
    own = {"a b.png": {"image/png": text}, "list.png": {"image/png": [text[:40], text[40:]]},
           "d.svg": {"image/svg+xml": SVG.decode()}, "odd": None}  # fmt: skip
    source = '![p](attachment:a%20b.png) <img src="attachment:a b.png" width="40%">'
    source += " ![](attachment:list.png)"
    shown = page(f"{source} ![d](attachment:d.svg) ![o](attachment:odd)", own)
    assert len(addresses(shown)) == 4
    assert 'width="40%"' in shown
    assert "odd" in shown


def test_a_picture_that_stands_in_the_text_is_shown(page):
    large = base64.b64encode(drawn("JPEG", (1500, 900), noise=True)).decode()
    shown = page(f"![p](data:image/jpeg;base64,{large})\n\n`data:image/jpeg;base64,{large}`")
    assert len(addresses(shown)) == 1
    assert len(shown) < len(large) + 2000


def test_pictures_of_a_page_have_a_limit_together(page, tmp_path, monkeypatch):
    monkeypatch.setattr(pictures, "MOST_OF_A_PAGE", 3 * len(base64.b64encode(PNG)))
    for number in range(5):
        (tmp_path / f"{number}.png").write_bytes(PNG)
    shown = page(" ".join(f"![p]({number}.png)" for number in range(5)))
    assert len(addresses(shown)) == 3
    assert shown.count("may take") == 2


def test_pictures_that_no_cell_shows_are_below_the_notebook(page, tmp_path):
    for name in ("shown.png", "forgotten <b>.png", "photo.heic"):
        (tmp_path / name).write_bytes(HEIC if name.endswith("heic") else PNG)
    (tmp_path / "notes.txt").write_text("notes")
    page("![p](shown.png)")
    beside = pictures_beside(page.resources)
    assert len(beside) == 2
    assert "<figcaption>forgotten &lt;b&gt;.png</figcaption><img" in beside[0]
    assert "save it as JPEG" in beside[1]


def test_no_word_of_a_student_makes_an_element(page):
    shown = page('![" onerror=forged() x="](" onerror=forged().png) <img alt="<b>" src="<i>.png">')
    assert "<b>" not in shown
    assert "<i>" not in shown
    assert not re.search(r"<[^>]*onerror=forged[^>]*>", re.sub(r'"[^"]*"', '""', shown))


def test_much_text_is_cut_and_quick(page):
    assert "…" in page("x" * 300_000) or len(page("x" * 300_000)) < 210_000
    assert len(page("![](" * 40_000)) < 2_000_000
