"""Sweeps in which one whole joint, link or vector is not what it should be."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np

from autograder.problems.c7_recursive.sweeps import RIGHT, Sweeps, changed


@dataclass(frozen=True)
class AlwaysDown(Sweeps):
    """Gravity of Earth along −z, also where there is none."""

    def __call__(self, q, qd, qdd, chain):
        down = np.full_like(chain.gravity, [0.0, 0.0, -9.81])
        return super().__call__(q, qd, qdd, changed(chain, gravity=down))


@dataclass(frozen=True)
class FirstLeftOut(Sweeps):
    """Nothing at the first joint."""

    def __call__(self, q, qd, qdd, chain):
        u = super().__call__(q, qd, qdd, chain)
        u[..., 0] = 0.0
        return u


@dataclass(frozen=True)
class LastLeftOut(Sweeps):
    """Nothing of the last link."""

    def __call__(self, q, qd, qdd, chain):
        return super().__call__(q, qd, qdd, _without_the_last(chain))

    def for_calls(self, calls):
        return RIGHT.for_calls(
            [
                replace(call, args=(*call.args[:-1], _without_the_last(call.args[-1])))
                for call in calls
            ]
        )


@dataclass(frozen=True)
class Reversed(Sweeps):
    """The torques from the tip to the base."""

    def __call__(self, q, qd, qdd, chain):
        return super().__call__(q, qd, qdd, chain)[..., ::-1]

    def for_calls(self, calls):
        return [u[::-1] for u in RIGHT.for_calls(calls)]


def _without_the_last(chain) -> SimpleNamespace:
    left = {name: np.array(getattr(chain, name)) for name in ("m", "I", "viscous")}
    for values in left.values():
        values[-1] = 0.0
    return changed(chain, **left)
