"""Plays a motion in a notebook: a canvas and its data, with a still figure beside it."""

import contextlib
import hashlib
import json
from dataclasses import dataclass
from importlib import resources
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from armdyn.parameters import all_finite, positive, real_array, state_vector
from armdyn.plotting.arm import draw_links, plane
from armdyn.plotting.balance import Balance, along, changes
from armdyn.plotting.picture import check_alt, encoded_png, image_tag, size_in_pixels
from armdyn.plotting.pose import pose, skeleton
from armdyn.plotting.style import DASHES, LINES, OKABE_ITO, figure

FRAMES_PER_SECOND = 30
# Below this the eye sees jumps, and straight lines between the angles of two frames miss the motion.
FEWEST_PER_SECOND = 12
# Numbers a notebook carries, at most: with the figure they stay under 50 KB.
LARGEST = 3000
STANDS = 5


@dataclass(frozen=True)
class Animation:
    """One moving arm or several; as a cell's last line it shows itself, with controls to play it.

    model: a Pendulum, a Planar2R or a PlanarChain. t: (T,), increasing, s. q: (T, n), rad, or
    (B, T, n) for up to 5 motions of the arm in one picture; the first n columns of the states that
    `simulate` gives. alt: a sentence that says what moves and how, for those who do not see it.
    speed: seconds of motion per second of watching. names: one short text per motion, at its tip.

    qd: the velocities, rad/s, of the shape of q. With them the player also shows M q̈, C q̇, g, f and
    u as arcs at each joint and in a table, and the energies as bars; of several motions it shows
    those of one, which is chosen. u: the torques of the motors, N·m, of a shape that broadcasts to
    that of q; 0 where it is left out. q̈ is what the equation of motion gives for q, q̇ and u.

    A notebook stores some 10 to 50 KB: the numbers at up to 30 frames a second, a player that asks
    nothing of the network, and a still figure with the path of the tip and a few postures. Where no
    script runs (a notebook not trusted, a code host, paper) only the figure remains.

    Raises ValueError, naming the argument, for shapes that do not fit, for an empty alt, for u
    without qd, and for a motion so long that its frames do not fit: show a part of it, or raise the
    speed. TypeError for another model. With qd, numpy.linalg.LinAlgError as `dynamics` does.
    """

    model: Any
    t: np.ndarray
    q: np.ndarray
    alt: str
    speed: float = 1.0
    names: tuple[str, ...] = ()
    qd: np.ndarray | None = None
    u: np.ndarray | None = None

    def __post_init__(self):
        skeleton(self.model)
        check_alt(self.alt)
        n = self.model.n
        t = all_finite("t", real_array("t", self.t))
        if t.ndim != 1 or len(t) < 2 or np.any(np.diff(t) <= 0):
            raise ValueError(f"t: got shape {t.shape}, needs two or more increasing times, (T,), s")
        q = state_vector("q", self.q, n)
        if (
            q.ndim not in (2, 3)
            or q.shape[-2] != len(t)
            or (q.ndim == 3 and not 1 <= len(q) <= len(LINES))
        ):
            raise ValueError(
                f"q: got shape {q.shape}, needs ({len(t)}, {n}), or (B, {len(t)}, {n}) with B up "
                f"to {len(LINES)}"
            )
        if self.u is not None and self.qd is None:
            raise ValueError("u: needs qd too, since the terms depend on the velocities")
        for name in ("qd", "u"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, self._like(name, q))
        motions = q if q.ndim == 3 else q[np.newaxis]
        names = tuple(self.names)
        if names and len(names) != len(motions):
            raise ValueError(f"names = {names}: needs {len(motions)}, one per motion")
        object.__setattr__(self, "t", t)
        object.__setattr__(self, "q", motions)
        object.__setattr__(self, "speed", positive("speed", self.speed, "1"))
        object.__setattr__(self, "names", names)
        self._times()

    def still(self) -> Figure:
        """The path of each tip, and the arm at a few times, from light to dark and thin to thick."""
        fig, ax = figure(3.7, 3.7)
        alone = len(self.q) == 1
        when = np.linspace(self.t[0], self.t[-1], STANDS if alone else 2)
        shades = np.linspace(0.8, 0.2, len(when))
        for k, motion in enumerate(self.q):
            color = OKABE_ITO[LINES[k]]
            tips = pose(self.model, motion).joints[:, -1]
            label = self.names[k] if self.names else "way of the tip"
            ax.plot(*tips.T, color=color, linestyle=DASHES[k], linewidth=1, label=label)
            joints = pose(self.model, along(when, self.t, self.q)[k]).joints
            for shade, stand in zip(shades, joints, strict=True):
                draw_links(ax, stand, str(shade) if alone else color, 2 + 2 * (1 - shade))
            ax.plot(*joints[0, -1], "o", color=color, markerfacecolor="white", markersize=8)
            ax.plot(*joints[-1, -1], "s", color=color, markersize=7)
        plane(ax, 1.15 * skeleton(self.model).reach)
        ax.set_title(f"from t = {self.t[0]:.3g} s (○) to {self.t[-1]:.3g} s (■)")
        if self.names:
            fig.legend(loc="outside lower center", ncols=3, frameon=False)
        return fig

    def _repr_mimebundle_(self, include=None, exclude=None):
        still = self.still()
        png = encoded_png(still, oversampling=1.0, colours=32)
        width, height = size_in_pixels(still)
        data = self._data()
        key = hashlib.sha256(data.encode()).hexdigest()[:12]
        page = (
            f'<div data-armdyn-animation="{key}" style="display:flex;flex-wrap:wrap;gap:16px">'
            f"<div>{image_tag(png, self.alt, width)}"
            "<p data-still-only>A still figure: run the cell, or trust the notebook, to see it "
            "move.</p></div></div>"
            f"<script>{_player(key, data, self.qd is not None)}</script>"
        )
        bundle = {"text/html": page, "image/png": png, "text/plain": self.alt}
        return bundle, {"image/png": {"alt": self.alt, "width": width, "height": height}}

    def _times(self) -> np.ndarray:
        """The times of the frames, s, evenly from t[0] to t[-1]."""
        watched = (self.t[-1] - self.t[0]) / self.speed
        balance = self._balance()
        columns = self.model.n + (balance.columns if balance else 0)
        most = LARGEST // (len(self.q) * columns)
        frames = min(round(watched * FRAMES_PER_SECOND) + 1, most)
        if (frames - 1) < FEWEST_PER_SECOND * watched - 1:
            longest = most / FEWEST_PER_SECOND
            raise ValueError(
                f"t: {watched:.3g} s of watching do not fit into a notebook, {longest:.3g} s do: "
                "show a part of the motion or raise speed"
            )
        return np.linspace(self.t[0], self.t[-1], max(frames, 2))

    def _data(self) -> str:
        times = self._times()
        parts = skeleton(self.model)
        angles = parts.angles(along(times, self.t, self.q))
        balance = self._balance()
        data = {
            "lengths": parts.l.tolist(),
            "arms": [[changes(column, 1e-3) for column in motion.T] for motion in angles],
            "frames": len(times),
            "start": times[0],
            "step": (times[-1] - times[0]) / (len(times) - 1),
            "speed": self.speed,
            "reach": parts.reach,
            "colours": [OKABE_ITO[name] for name in LINES],
            "names": self.names,
            "alt": self.alt,
            "torques": balance.data(times) if balance else None,
        }
        # "<" could close the script's element.
        return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")

    def _balance(self) -> Balance | None:
        if self.qd is None:
            return None
        u = np.zeros_like(self.q) if self.u is None else self.u
        return Balance(self.model, self.t, self.q, self.qd, u)

    def _like(self, name: str, q: np.ndarray) -> np.ndarray:
        """The argument in the shape of q, (B, T, n); only u may be broadcast to it."""
        values = state_vector(name, getattr(self, name), self.model.n)
        if values.shape != q.shape and name == "u" and values.ndim <= q.ndim:
            with contextlib.suppress(ValueError):
                values = np.broadcast_to(values, q.shape)
        if values.shape != q.shape:
            raise ValueError(f"{name}: got shape {values.shape}, needs that of q, {q.shape}")
        return values if q.ndim == 3 else values[np.newaxis]


def _player(key: str, data: str, torques: bool) -> str:
    """The script of a page. Its parts are named between @, and the data, which may hold such a
    name, comes last.
    """
    script = _lines("animation.js")
    script = script.replace("@CONTROLS@", _lines("controls.js"))
    script = script.replace("@TORQUES@", _lines("torques.js") if torques else "")
    script = script.replace("@STYLE@", _lines("animation.css"))
    return script.replace("@KEY@", key).replace("@DATA@", data)


def _lines(name: str) -> str:
    """A file beside this one without what only its readers need: indents, comments, blank lines."""
    text = resources.files(__package__).joinpath(name).read_text(encoding="utf-8")
    lines = (line.strip() for line in text.splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//"))
