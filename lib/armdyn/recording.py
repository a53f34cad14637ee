"""Reads recorded motion of a robot, and makes of it the samples that `armdyn.identify` needs.

A recording has angles and torques, but no q̇ and no q̈, and its angles are rounded by the encoder.
`motion` smooths angles and torques by the same filter and differentiates. Files are read by
`armdyn.recording_file.read`.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import make_interp_spline
from scipy.signal import butter, sosfiltfilt

# Over a gap of more steps than this, an interpolation would invent a motion.
GAP = 10
# At each end a filter knows one side only; this many periods of the cutoff are left out.
ENDS = 3
# Of the Butterworth filter, which runs forwards and backwards.
ORDER = 4


@dataclass(frozen=True, eq=False)
class Recording:
    """What was measured: the times t, (T,), s, which increase; q, u, (T, n), rad and N·m.

    For a prismatic joint q is in m and u in N. Raises ValueError where the arrays do not have these
    shapes, or where a number is not finite.
    """

    t: np.ndarray
    q: np.ndarray
    u: np.ndarray

    def __init__(self, t: ArrayLike, q: ArrayLike, u: ArrayLike):
        for name, given, axes in (("t", t, 1), ("q", q, 2), ("u", u, 2)):
            array = np.array(given, dtype=float)
            if array.ndim != axes or array.shape[0] != len(np.atleast_1d(t)):
                needs = "(T,)" if axes == 1 else "(T, n), one row per time"
                raise ValueError(f"{name}: got shape {array.shape}, needs {needs}")
            if not np.all(np.isfinite(array)):
                row = int(np.argwhere(~np.isfinite(array))[0, 0])
                raise ValueError(f"{name}: sample {row} is not finite")
            object.__setattr__(self, name, array)
        if self.q.shape != self.u.shape:
            raise ValueError(f"u: got shape {self.u.shape}, needs that of q, {self.q.shape}")
        if len(self.t) < 2:
            raise ValueError(f"t: got {len(self.t)} samples, needs at least 2")
        late = np.flatnonzero(np.diff(self.t) <= 0)
        if late.size:
            k = int(late[0]) + 1
            raise ValueError(
                f"t: sample {k} is {self.t[k]:g} s, after {self.t[k - 1]:g} s; needs increasing times"
            )

    @property
    def rate(self) -> float:
        """Samples per second, by the median step."""
        return float(1 / np.median(np.diff(self.t)))


class Motion(NamedTuple):
    """Evenly spaced samples: t, (T,), s; q, qd, qdd, u, (T, n), in the units of `identify`."""

    t: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    u: np.ndarray


def resample(recording: Recording, delay: float = 0.0) -> Recording:
    """The recording at even steps, the median of its own, by cubic splines.

    delay: by how much later than the angle of the same moment a torque is recorded, s; negative where
    it is earlier. What is left is the time in which both are known.

    Raises ValueError for a gap of more than 10 steps, and where less than 4 samples are left.
    """
    t, step = recording.t, 1 / recording.rate
    steps = np.diff(t)
    widest = int(np.argmax(steps))
    if steps[widest] > GAP * step:
        raise ValueError(
            f"t: a gap of {steps[widest]:.3g} s at {t[widest]:.6g} s, where most steps are "
            f"{step:.3g} s; cut the recording there"
        )
    first, last = max(t[0], t[0] - delay), min(t[-1], t[-1] - delay)
    count = int(np.floor((last - first) / step + 1e-6)) + 1
    if len(t) < 4 or count < 4:
        raise ValueError(
            f"t: {len(t)} samples in {t[-1] - t[0]:.3g} s, with a delay of {delay:g} s; too short"
        )
    even = first + step * np.arange(count)
    q = make_interp_spline(t, recording.q)(np.clip(even, t[0], t[-1]))
    u = make_interp_spline(t, recording.u)(np.clip(even + delay, t[0], t[-1]))
    return Recording(even, q, u)


def motion(recording: Recording, cutoff: float, delay: float = 0.0) -> Motion:
    """The recording at even steps, smoothed, with q̇ and q̈.

    cutoff: Hz. Angles and torques pass the same filter, a Butterworth low-pass of order 4 that runs
    forwards and backwards, so it delays nothing; what is faster than the cutoff is lost in all of
    them. It has to be above the frequencies of the motion, and far below half the sampling rate.
    delay: as for `resample`. At both ends 3 periods of the cutoff are left out.

    Raises ValueError for a cutoff that is not between 0 and half the sampling rate, for a recording
    that is too short for it, and as `resample` does.
    """
    even = resample(recording, delay)
    if not 0 < cutoff < even.rate / 2:
        raise ValueError(
            f"cutoff = {cutoff!r}: needs a number of Hz between 0 and {even.rate / 2:.4g}, half of the "
            "sampling rate"
        )
    ends = int(np.ceil(ENDS * even.rate / cutoff))
    if len(even.t) < 3 * ends:
        raise ValueError(
            f"t: the recording lasts {even.t[-1] - even.t[0]:.3g} s, too short for a cutoff of "
            f"{cutoff:g} Hz, which needs {3 * ends / even.rate:.3g} s"
        )
    low_pass = butter(ORDER, cutoff, fs=even.rate, output="sos")
    q, u = (sosfiltfilt(low_pass, x, axis=0) for x in (even.q, even.u))
    spline = make_interp_spline(even.t, q, k=5)
    inner = slice(ends, -ends)
    t = even.t[inner]
    return Motion(t, q[inner], spline(t, 1), spline(t, 2), u[inner])
