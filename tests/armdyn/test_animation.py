"""What a notebook stores of an animation. That it plays is tests/browser/test_animation.py's."""

import base64
import io
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

from armdyn import Manipulator, Pendulum, Planar2R, PlanarChain
from armdyn.plotting import Animation
from armdyn.simulate import simulate

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
T = np.linspace(0, 10, 501)
STARTS = np.array([[0.4, -0.7, 0.5, 1.0], [0.401, -0.7, 0.5, 1.0]])
ALT = 'A free arm tumbles; "down" is <below> & dark.'


@pytest.fixture(scope="module")
def runs():
    return simulate(ARM.state_derivative, STARTS, [0, 0], T)[..., :2]


def html_of(animation):
    return animation._repr_mimebundle_()[0]["text/html"]


def data_of(animation):
    return json.loads(re.search(r"= (\{.*\});\n", html_of(animation)).group(1))


def read(columns, frames, unit):
    """Columns as the player adds them up, each (frames,); one that stays has a single number."""
    return np.array([np.broadcast_to(np.cumsum(column), frames) for column in columns]) * unit


def angles_of(data):
    """The directions of the links, (B, frames, n), rad."""
    return np.array([read(links, data["frames"], 1e-3).T for links in data["arms"]])


def test_ten_seconds_are_under_50_kb(runs):
    one, two = (Animation(ARM, T, q, ALT) for q in (runs[0], runs))
    for animation in (one, two):
        data, metadata = animation._repr_mimebundle_()
        assert len(json.dumps({"data": data, "metadata": metadata})) < 50_000


@pytest.mark.parametrize(("motions", "seconds"), [(1, 40), (5, 20)])
def test_the_longest_and_busiest_is_under_50_kb_too(motions, seconds):
    chain = PlanarChain((0.3,) * 6, (0.15,) * 6, (1.0,) * 6, (0.02,) * 6)
    t = np.linspace(0, seconds, 2000)
    rates = np.random.default_rng(1).normal(0, 2, (motions, 1, 6))
    q = 3 * np.sin(rates * t[:, np.newaxis] + rates)
    speed = motions * seconds / 40
    animation = Animation(chain, t, q, ALT, speed=speed, names="abcde"[:motions])
    assert len(json.dumps(animation._repr_mimebundle_())) < 50_000


def test_the_frames_are_the_motion(runs):
    data = data_of(Animation(ARM, T, runs, ALT))
    angles = angles_of(data)
    assert angles.shape == (2, data["frames"], 2)
    assert data["step"] == pytest.approx(1 / 30, rel=0.01)
    assert data["step"] * (data["frames"] - 1) == pytest.approx(10)
    when = data["step"] * np.arange(data["frames"])
    for angle, q in zip(angles, runs, strict=True):
        for link, absolute in enumerate(np.cumsum(q, axis=-1).T):
            assert angle[:, link] == pytest.approx(np.interp(when, T, absolute), abs=6e-4)
    assert data["lengths"] == [1.0, 0.8]
    assert data["reach"] == pytest.approx(1.8)


def test_a_pendulum_hangs_at_zero_and_a_start_is_kept():
    pendulum = Pendulum(m=1.0, lc=0.5, I=0.3)
    t = np.array([2.0, 2.5, 4.0])
    data = data_of(Animation(pendulum, t, [[0.0], [0.5], [-1.0]], ALT, speed=0.5))
    angles = angles_of(data)[0, :, 0]
    assert angles[0] == pytest.approx(-np.pi / 2, abs=6e-4)
    assert angles[-1] == pytest.approx(-np.pi / 2 - 1, abs=6e-4)
    rod = np.sqrt(12 * (0.3 - 1.0 * 0.5**2) / 1.0)  # of the same inertia, its middle at lc
    assert (data["start"], data["speed"]) == (2.0, 0.5)
    assert data["lengths"] == pytest.approx([0.5 + rod / 2])
    # Half as fast: twice the frames per second of motion.
    assert data["step"] == pytest.approx(1 / 60, rel=0.02)


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


def test_without_scripts_there_is_the_figure_and_its_text(runs):
    data, metadata = Animation(ARM, T, runs[0], ALT)._repr_mimebundle_()
    page = Page(data["text/html"])
    assert [tag for tag, _ in page.tags] == ["div", "div", "img", "p", "script"]
    image = dict(page.tags)["img"]
    assert image["alt"] == data["text/plain"] == metadata["image/png"]["alt"] == ALT
    assert image["src"].endswith(data["image/png"])
    with Image.open(io.BytesIO(base64.b64decode(data["image/png"]))) as png:
        assert (png.width, png.height) == tuple(
            metadata["image/png"][k] for k in ("width", "height")
        )
    assert "".join(page.texts).startswith("A still figure")


def test_it_asks_nothing_of_the_network(runs):
    page = html_of(Animation(ARM, T, runs[0], ALT))
    assert not re.findall(r"(?:https?:)?//[a-z0-9.-]+\.[a-z]", page)
    assert not re.search(r"fetch|XMLHttpRequest|import\s*\(|@import|url\(|<link", page)


def test_no_text_closes_the_script():
    animation = Animation(ARM, [0, 1], np.zeros((2, 2)), "</script><b>", names=("</script>",))
    page = Page(html_of(animation))
    assert [tag for tag, _ in page.tags] == ["div", "div", "img", "p", "script"]
    assert data_of(animation)["names"] == ["</script>"]


def test_the_same_motion_is_the_same_output(runs):
    assert html_of(Animation(ARM, T, runs[0], ALT)) == html_of(Animation(ARM, T, runs[0], ALT))
    keys = [
        re.search(r'animation="(\w+)"', html_of(Animation(ARM, T, q, ALT))).group(1) for q in runs
    ]
    assert keys[0] != keys[1]


def test_the_still_figure_shows_the_way_and_both_ends(runs):
    ax = Animation(ARM, T, runs[0], ALT).still().axes[0]
    way = ax.lines[0].get_xydata()
    assert len(way) == len(T)
    first, last = (line.get_xydata() for line in (ax.lines[1], ax.lines[5]))
    assert first[-1] == pytest.approx(way[0])
    assert last[-1] == pytest.approx(way[-1])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x (m)", "y (m)")
    assert ax.get_title() == "from t = 0 s (○) to 10 s (■)"
    named = Animation(ARM, T, runs, ALT, names=("one", "two")).still()
    legend = named.legends[0]
    assert [text.get_text() for text in legend.get_texts()] == ["one", "two"]
    assert len({line.get_linestyle() for line in legend.get_lines()}) == 2


class Cart(Manipulator):
    n = 1
    M = C = g_vec = potential_energy = None


def test_only_known_models_are_animated():
    with pytest.raises(TypeError, match="got Cart"):
        Animation(Cart(), [0, 1], [[0], [1]], ALT)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"alt": " "}, "^alt: needs a sentence"),
        ({"t": [0.0]}, r"^t: got shape \(1,\)"),
        ({"t": [0.0, 1.0, 1.0]}, "^t: .*increasing"),
        ({"t": [0.0, np.nan, 1.0]}, r"^t\[1\] = nan"),
        ({"q": np.zeros((3, 3))}, r"^q: got shape \(3, 3\)"),
        ({"q": np.zeros((4, 2))}, r"^q: got shape \(4, 2\), needs \(3, 2\)"),
        ({"q": np.zeros((6, 3, 2))}, r"^q: got shape \(6, 3, 2\), .*up to 5"),
        ({"q": np.zeros((0, 3, 2))}, r"^q: got shape \(0, 3, 2\)"),
        ({"q": np.zeros(2)}, r"^q: got shape \(2,\)"),
        ({"speed": 0}, "^speed = 0"),
        ({"u": [0.0, 0.0]}, "^u: needs qd too"),
        ({"qd": np.zeros((2, 2))}, r"^qd: got shape \(2, 2\), needs that of q, \(3, 2\)"),
        ({"qd": np.zeros(2)}, r"^qd: got shape \(2,\)"),
        ({"qd": np.zeros((3, 2)), "u": np.zeros(3)}, r"^u: got shape \(3,\)"),
        ({"qd": np.zeros((3, 2)), "u": np.zeros((1, 3, 2))}, r"^u: got shape \(1, 3, 2\)"),
        ({"qd": [[0, 0], [0, np.inf], [0, 0]]}, "^qd.*inf"),
        ({"names": ("a", "b")}, r"^names = \('a', 'b'\): needs 1"),
        ({"t": [0, 1, 1000]}, "^t: 1e.03 s of watching do not fit into a notebook, 125 s do"),
        ({"t": [0, 1, 200], "speed": 0.1}, "^t: 2e.03 s of watching do not fit"),
    ],
)
def test_bad_input_is_named(changes, says):
    arguments = {"model": ARM, "t": [0.0, 1.0, 2.0], "q": np.zeros((3, 2)), "alt": ALT}
    with pytest.raises(ValueError, match=says):
        Animation(**arguments | changes)


def test_a_faster_speed_makes_room():
    t = [0.0, 1000.0]
    data = data_of(Animation(ARM, t, np.zeros((2, 2)), ALT, speed=20))
    assert data["step"] * (data["frames"] - 1) == pytest.approx(1000)
