"""What a notebook stores of two motions. That they play is tests/browser/test_watch.py's."""

import base64
import json
import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest

from autograder.mechanisms import MECHANISMS
from autograder.pictures.motion import FRAMES, compared
from autograder.pictures.page import Shown, mimebundle
from autograder.pictures.side_by_side import picture
from autograder.problems import known_check
from autograder.student.watch import shown
from tests.autograder.pictures.wrong import CART, MINUS, first_call, function, played

SVG = "{http://www.w3.org/2000/svg}"
ALT = 'Two arms; "one" is <below> & dark.'


def columns(part, frames: int) -> np.ndarray:
    """x, y, turn and stretch of a part, (frames, 4)."""
    return np.column_stack([np.broadcast_to(column, frames) for column in part])


def test_the_frames_are_the_motions():
    both = played("p1-M", MINUS)
    made = picture(both, ALT)
    assert made.motion["step"] == pytest.approx(0.5 / FRAMES)
    assert made.motion["frames"] == FRAMES + 1
    scales = []
    for motion, parts in zip((both.right, both.theirs), made.motion["panels"], strict=True):
        link_1, link_2, tip, elbow = (columns(part, FRAMES + 1) for part in parts)
        q = motion.x[:, :2]
        # Degrees clockwise, as y points down.
        np.testing.assert_allclose(np.radians(-link_1[:, 2]), _wound(q[:, 0], link_1), atol=2e-3)
        np.testing.assert_allclose(np.radians(-link_2[:, 2]), _wound(q.sum(1), link_2), atol=2e-3)
        np.testing.assert_array_equal(link_1[:, 3], 1.0)
        np.testing.assert_array_equal(link_2[:, :2], elbow[:, :2])
        px, metres = tip[:, :2] - tip[0, :2], both.tips(motion) - both.tips(motion)[0]
        scale = np.sum(px * metres * [1, -1]) / np.sum(metres**2)
        np.testing.assert_allclose(px, scale * metres * [1, -1], atol=0.11)
        scales.append(scale)
    assert scales[0] == pytest.approx(scales[1], rel=1e-3)


def _wound(angle, part):
    """The angle in the turns in which the picture counts it."""
    return angle + 2 * np.pi * np.round((np.radians(-part[0, 2]) - angle[0]) / (2 * np.pi))


def test_the_still_picture_shows_the_end_and_faintly_the_start():
    both = played("cart-pole-M", CART)
    made = picture(both, ALT)
    root = ElementTree.fromstring(made.svg)
    assert root.get("aria-label") == ALT
    panels = [panel for panel in root.iter(f"{SVG}svg") if panel.get("data-panel")]
    for panel, parts in zip(panels, made.motion["panels"], strict=True):
        now = [g for g in panel.iter(f"{SVG}g") if g.get("data-moves") is not None]
        faint = [g for g in panel.find(f"{SVG}g") if g.get("transform")]
        assert len(now) == len(faint) == len(parts) == 5  # cart, pole, mass, and two joints
        for group, frame in ((now, -1), (faint, 0)):
            for g, part in zip(group, parts, strict=True):
                x, y, turn, stretch = columns(part, FRAMES + 1)[frame]
                exact = f"translate({x:.1f} {y:.1f}) rotate({turn:.1f}) scale({stretch:.3f} 1)"
                assert g.get("transform").replace("-0.0", "0.0") == exact.replace("-0.0", "0.0")


def test_a_motion_that_stops_has_fewer_frames():
    start = first_call("p1-M").args[0][0]
    body = f"if abs(q[0] - {start!r}) > 0.05: raise ValueError\nreturn np.eye(2)"
    both = played("p1-M", body)
    assert 1 < both.common < FRAMES
    lengths = [
        {len(column) for part in panel for column in part if isinstance(column, list)}
        for panel in picture(both, ALT).motion["panels"]
    ]
    assert lengths == [{FRAMES + 1}, {both.common}]


@pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=lambda m: m.name)
def test_every_mechanism_is_drawn_in_less_than_50_kb(mechanism):
    rng = np.random.default_rng(4)
    check = known_check(f"{mechanism.name}-g_vec")
    call = check.calls(rng, 6)[0]

    def flipped(q, arm):
        return -check.reference(q, arm)

    bundle = shown(check, {"g_vec": flipped})
    assert len(json.dumps(bundle)) < 50_000
    images = re.findall(r'src="data:image/svg\+xml;base64,([^"]+)"', bundle["text/html"])
    assert len(images) == 2
    for image in images:
        root = ElementTree.fromstring(base64.b64decode(image))
        numbers = re.findall(r"(?<![\w#])-?\d+\.?\d*", " ".join(_written(root)))
        assert np.all(np.abs(np.array(numbers, dtype=float)) < 5000)
        assert "nan" not in "".join(_written(root))
    both = compared(check, flipped, call)
    for panel, motion in zip(
        picture(both, ALT).motion["panels"], (both.right, both.theirs), strict=True
    ):
        assert panel  # something moves
        for part in panel:
            assert np.all(np.isfinite(columns(part, len(motion.t))))


def _written(root):
    for element in root.iter():
        yield from (element.get(name, "") for name in ("d", "transform", "x", "y", "cx", "cy"))


class Page(HTMLParser):
    """A page as one without scripts sees it."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.texts, self.inside = [], [], None
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self.inside = tag

    def handle_data(self, data):
        if self.inside != "script":
            self.texts.append(data)


def test_without_scripts_there_are_the_picture_and_its_text():
    both = played("p1-M", MINUS)
    made = picture(both, ALT)
    page = Page(
        mimebundle("p1-M", [Shown("0.5 s", ["It falls."], made.svg, ALT, made.motion)])["text/html"]
    )
    image = dict(page.tags)["img"]
    assert image["alt"] == ALT
    assert base64.b64decode(image["src"].partition(",")[2]).decode() == made.svg
    assert {"0.5 s", "It falls."} <= set(page.texts)
    assert any("A still picture" in text for text in page.texts)


def test_what_a_student_raises_is_quoted_as_text():
    body = "raise ValueError('</script><img src=x onerror=alert(1)> $x$' + 'long' * 1000)"
    html = shown(known_check("p1-M"), {"M": _right_once(body)})["text/html"]
    page = Page(html)
    assert [tag for tag, _ in page.tags].count("img") == 1
    (quoting,) = [attrs for tag, attrs in page.tags if "mathjax_ignore" in attrs.get("class", "")]
    assert "tex2jax_ignore" in quoting["class"]
    assert any("raised ValueError: </script><img" in text for text in page.texts)
    assert len(" ".join(page.texts)) < 1500


def _right_once(body):
    """Wrong numbers for the check, and then the error."""
    asked = []
    raising = function("p1-M", f"{body}\nreturn 0")

    def M(q, arm):
        asked.append(q)
        # More calls than the check makes.
        return np.eye(2) if len(asked) <= 12 + 40 else raising(q, arm)

    return M


def test_it_asks_nothing_of_the_network():
    page = shown(known_check("p1-M"), {"M": function("p1-M", MINUS)})["text/html"]
    page = page.replace("http://www.w3.org/2000/svg", "")
    assert not re.findall(r"(?:https?:)?//[a-z0-9.-]+\.[a-z]", page)
    assert not re.search(r"fetch|XMLHttpRequest|import\s*\(|@import|url\(|<link", page)
