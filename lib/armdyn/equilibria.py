"""Finds the equilibria of an arm, where it rests against gravity and springs without any torque."""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator, model_given
from armdyn.parameters import all_finite, real_array

STARTS = 8  # per coordinate, at first
ROUNDS = 3
ITERATIONS = 60
FULL = 20  # steps of full length after those, which lead out of the range
FARTHEST = 1e6  # from 0, in units of a range over 2π: beyond, differences are rounding
FLAT = 1e-9  # ∂g/∂q far out, of what g and the range make of it: there g only fades away
REACH = 10.0  # of the starts along a coordinate that is not an angle, either way, in its unit
# Of a turn of 2π, which stands for the whole of `within` along a coordinate that is not an angle.
LONGEST = 0.5  # step of Newton's method
DIFFERENCE = 1e-5
SAME = 1e-6
SMALL = 1e-9  # of the largest g_i
NOTHING = 1e-12  # of the largest g of all coordinates


@dataclass(frozen=True)
class Equilibrium:
    """A configuration with g(q) = 0, and what P has there.

    q: (n,), rad or m, an angle in (−π, π]. stiffness: (n,), the eigenvalues of ∂g/∂q in rising
    order, N·m/rad (with slides among the joints, in the mixed units of q). angle: (n,), which
    coordinates are angles: a full turn of one leads to the same place. kind: "minimum" (all positive:
    the arm stays near), "maximum" (all negative) or "saddle".
    """

    q: np.ndarray
    stiffness: np.ndarray
    angle: np.ndarray

    @property
    def kind(self) -> str:
        if self.stiffness[0] > 0:
            return "minimum"
        return "maximum" if self.stiffness[-1] < 0 else "saddle"

    def between(self, low: float, high: float) -> np.ndarray:
        """All q with every coordinate from low to high that are this equilibrium, (k, n)."""
        slack, turn = 1e-9, 2 * np.pi
        places = []
        for q, angle in zip(self.q, self.angle, strict=True):
            first, last = np.ceil((low - slack - q) / turn), np.floor((high + slack - q) / turn)
            turns = np.arange(first, last + 1) if angle else np.zeros(int(low <= q <= high))
            places.append(q + turn * turns)
        return np.array(list(itertools.product(*places))).reshape(-1, len(self.q))


def equilibria(model: Manipulator, within: ArrayLike | None = None) -> tuple[Equilibrium, ...]:
    """All q with g(q) = 0 of an arm, the lowest potential energy first.

    model: a Manipulator with up to 3 joints. A coordinate is an angle if a full turn of it, tried at
    some q, leaves g as it was; the q returned are then brought into (−π, π]. No other coordinate is
    wrapped, be it a slide's or a joint's with a spring.
    within: (n, 2), where to search along the coordinates that are not angles, lowest and highest;
    ±10 where not given. A q beyond is found too, however far, where g leads Newton's method to it, as
    that of a spring does.

    Newton's method, from a grid of starts that grows. If a full turn of every joint leaves P as it was
    too, until the count agrees with the Poincaré–Hopf theorem: on a torus, equilibria with an even and
    with an odd number of negative stiffnesses are equally many. Otherwise, until a finer grid finds no
    more; there may be none, and then the result is empty.
    Raises ValueError for more joints, for what is no model, for a `within` of another shape, and where
    equilibria are not isolated (no gravity, or a joint on which none acts); RuntimeError where the
    counts never agree.

    Source: J. Milnor (1965), Topology from the Differentiable Viewpoint, section 6.
    """
    model_given("model", model)
    if model.n > 3:
        raise ValueError(f"model: needs up to 3 joints, has {model.n}")
    search = _Search(model, _ranges(within, model.n))
    last: list[Equilibrium] | None = None
    for starts in (STARTS * 2**k for k in range(ROUNDS)):
        found = search.from_grid(starts)
        if search.closed:
            settled = found and sum((-1) ** int(np.sum(e.stiffness < 0)) for e in found) == 0
        else:
            settled = last is not None and len(found) == len(last)
        if settled:
            return tuple(sorted(found, key=lambda point: model.potential_energy(point.q)))
        last = found
    raise RuntimeError(f"not all equilibria of {model} were found; give a narrower `within`")


class _Search:
    """What is known of g before its zeros are looked for."""

    def __init__(self, model, ranges):
        self.model = model
        trials = _low_discrepancy(ranges)
        g, P = model.g_vec(trials), model.potential_energy(trials)
        self.size = np.max(np.abs(g), axis=0)  # of each g_i, in its own unit
        if np.min(self.size) <= NOTHING * np.max(self.size):
            raise self._not_isolated()
        self.angle = np.empty(model.n, bool)
        returns = np.empty(model.n, bool)
        for i, turn in enumerate(2 * np.pi * np.eye(model.n)):
            change = np.abs(model.g_vec(trials + turn) - g)
            self.angle[i] = np.all(change <= SMALL * self.size)
            lift = np.abs(model.potential_energy(trials + turn) - P)
            returns[i] = np.all(lift <= SMALL * self.size[i] + NOTHING * np.abs(P))
        self.closed = bool(np.all(self.angle & returns))
        self.low = np.where(self.angle, -np.pi, ranges[:, 0])
        self.span = np.where(self.angle, 2 * np.pi, ranges[:, 1] - ranges[:, 0])
        self.scale = self.span / (2 * np.pi)

    def from_grid(self, starts) -> list[Equilibrium]:
        found = []
        for q in self._roots(starts):
            H = _stiffness(self.model, q, self.scale)
            # Each coordinate in its own size and scale, so that units do not decide.
            even = np.sqrt(self.scale / self.size)
            relative = np.abs(np.linalg.eigvalsh(even[:, np.newaxis] * H * even))
            if np.min(relative) <= 1e-6 * np.max(relative):
                raise self._not_isolated()
            found.append(Equilibrium(q, np.linalg.eigvalsh(H), self.angle))
        return found

    def _roots(self, starts) -> list[np.ndarray]:
        # Not from the middle, where an arm may stand straight and a stiffness be singular.
        share = (np.arange(starts) + 0.5) / starts + 0.1 / (2 * np.pi)
        q = self.low + self.span * np.array(list(itertools.product(share, repeat=self.model.n)))
        length = np.full((len(q), 1), np.inf)
        for _ in range(ITERATIONS):
            step, length = self._newton(q)
            q = q - self.scale * step * np.minimum(1, LONGEST / np.maximum(length, SMALL))
        # Where g only fades away, as e^−q, the steps do not.
        there = length[:, 0] <= SAME
        q = np.concatenate([q[there], self._from_afar(q[~there])])
        q = np.where(self.angle, np.pi - (np.pi - q) % (2 * np.pi), q)
        # What is returned, and not only where it was found, is tried.
        q = q[np.all(np.abs(self.model.g_vec(q)) <= SMALL * self.size, axis=-1)]
        distinct: list[np.ndarray] = []
        for one in q:
            # ∂g/∂q is that of both sides: where g is flat, as of x⁴, zeros so near are one.
            if all(np.any(self._apart(one, other) > 2 * DIFFERENCE) for other in distinct):
                distinct.append(one)
        return distinct

    def _newton(self, q) -> tuple[np.ndarray, np.ndarray]:
        """A step of Newton's method, (..., n), in units of the scale, and its length, (..., 1)."""
        H = self.scale[:, np.newaxis] * _stiffness(self.model, q, self.scale) * self.scale
        # The pseudo-inverse, for starts where the stiffness is singular.
        inverse = np.linalg.pinv(H, hermitian=True)
        step = np.matvec(inverse, self.scale * self.model.g_vec(q))
        return step, np.linalg.norm(step, axis=-1, keepdims=True)

    def _from_afar(self, q) -> np.ndarray:
        """Where full steps lead those that short ones left on their way, (k, n)."""
        if self.closed or len(q) == 0:
            return q[:0]
        there = np.zeros(len(q), bool)
        with np.errstate(all="ignore"):
            for _ in range(FULL):
                step, length = self._newton(q)
                # In units of the distance, which is what rounding is relative to.
                away = np.maximum(1, np.max(np.abs(q) / self.scale, axis=-1))
                there = length[:, 0] <= SAME * away
                moved = q - self.scale * step
                good = np.all(np.isfinite(moved) & (np.abs(moved) < FARTHEST * self.scale), axis=-1)
                q, there = moved[good], there[good]
                if len(q) == 0:
                    break
            else:
                even = np.sqrt(self.scale / self.size)
                H = even[:, np.newaxis] * _stiffness(self.model, q, self.scale) * even
                there &= np.min(np.abs(np.linalg.eigvalsh(H)), axis=-1) > FLAT
        return q[there]

    def _apart(self, one, other) -> np.ndarray:
        turned = (one - other + np.pi) % (2 * np.pi) - np.pi
        away = np.where(self.angle, turned, one - other)
        return np.abs(away) / np.maximum(self.scale, np.abs(one))

    def _not_isolated(self) -> ValueError:
        return ValueError(
            f"model = {self.model}: its equilibria are not isolated; needs gravity, or a spring, "
            "that acts on every joint"
        )


def _ranges(within, n) -> np.ndarray:
    if within is None:
        return np.tile([-REACH, REACH], (n, 1))
    needs = f"a lowest and a highest value for each coordinate, ({n}, 2)"
    ranges = all_finite("within", real_array("within", within, needs))
    if ranges.shape != (n, 2):
        raise ValueError(f"within: got shape {ranges.shape}, needs {needs}")
    for i, (low, high) in enumerate(ranges):
        if low >= high:
            raise ValueError(f"within[{i}] = ({low}, {high}): needs the lower value first")
    return ranges


def _low_discrepancy(ranges) -> np.ndarray:
    """Twelve q all over the ranges, by multiples of irrational numbers."""
    n = len(ranges)
    shares = np.arange(1, 13)[:, np.newaxis] * np.sqrt([2, 3, 5])[:n] % 1
    return ranges[:, 0] + (ranges[:, 1] - ranges[:, 0]) * shares


def _stiffness(model, q, scale) -> np.ndarray:
    """∂g/∂q by central differences, symmetric, (..., n, n)."""
    steps = DIFFERENCE * scale
    columns = [
        (model.g_vec(q + step * e) - model.g_vec(q - step * e)) / (2 * step)
        for step, e in zip(steps, np.eye(model.n), strict=True)
    ]
    H = np.stack(columns, axis=-1)
    return (H + np.swapaxes(H, -1, -2)) / 2
