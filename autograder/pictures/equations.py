"""The equations of motion of a mechanism, the right ones or with a student's term in its place."""

import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from types import SimpleNamespace

import numpy as np

from autograder.judging.check import Check
from autograder.judging.partial import where_not_finite
from autograder.judging.quantities import UnfitError
from autograder.mechanisms import Mechanism
from autograder.mutation.friction import torques
from autograder.mutation.references import reference
from autograder.protocol import (
    Call,
    NotNumbersError,
    TimeLimitError,
    is_finite,
    kind_of,
    message_of,
    read,
    real,
    shortened,
    time_limit,
)

# Of the processor's time, for all calls of one picture: a check's own calls cost about as much.
BUDGET = 0.3
TOO_LONG = f"it takes more than {BUDGET:g} s of computing"
TERMS = ("M", "C", "g_vec")


class NoMotionError(Exception):
    """A student's function gives nothing to go on with; the text says why."""


class Equations:
    """M q̈ + C q̇ + g + f = u of a mechanism with its parameters, as ẋ = rate(x, u).

    put: by the name M, C, g_vec or f, a function that stands in the place of the right one; f(x, u, arm)
    gives the whole ẋ. friction: whether the parameters hold its coefficients.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        arm: SimpleNamespace,
        put: dict[str, Callable] | None = None,
        friction: bool = False,
    ):
        self.mechanism, self.arm = mechanism, arm
        self._put = dict(put or {})
        self._of = {name: reference(mechanism, name) for name in TERMS} | self._put
        self._friction = torques(mechanism) if friction and mechanism.friction else None

    def rate(self, x: np.ndarray, u: np.ndarray) -> np.ndarray:
        """ẋ = [q̇; q̈], (2n,); numpy.linalg.LinAlgError where M is singular."""
        if "f" in self._put:
            return self._put["f"](x, u, self.arm)
        q, qd = x[: self.mechanism.n], x[self.mechanism.n :]
        rest = u - self._of["C"](q, qd, self.arm) @ qd - self._of["g_vec"](q, self.arm)
        if self._friction:
            rest = rest - np.sum(self._friction(q[None], qd[None], [self.arm]), axis=0)[0]
        return np.concatenate([qd, np.linalg.solve(self._of["M"](q, self.arm), rest)])

    def term(self, name: str, x: np.ndarray) -> np.ndarray:
        """What M, C q̇ or g_vec is at a state."""
        q, qd = x[: self.mechanism.n], x[self.mechanism.n :]
        if name == "C":
            return self._of["C"](q, qd, self.arm) @ qd
        return self._of[name](q, self.arm)

    def energy(self, x: np.ndarray) -> np.ndarray:
        """K + P at states (T, 2n): (T,), J."""
        M, P = (reference(self.mechanism, name) for name in ("M", "potential_energy"))
        found = []
        for row in x:
            q, qd = np.split(row, 2)
            found.append(qd @ M(q, self.arm) @ qd / 2 + P(q, self.arm).item())
        return np.array(found)


def students(check: Check, function: Callable, shape: tuple[int, ...]) -> Callable:
    """Their function, with copies of its arguments, read as numbers of this shape.

    NoMotionError says what it did instead.
    """
    size = int(np.prod(shape))

    def value(*args):
        try:
            number = read(Call(check.name, args), function(*map(real, args)))
            if not is_finite(number):
                raise UnfitError(f"{where_not_finite(number)}, which is not a finite number")
        except (NotNumbersError, UnfitError) as error:
            raise NoMotionError(f"{check.signature} returned {shortened(str(error))}") from None
        except (Exception, SystemExit) as error:
            said = shortened(f"{kind_of(error)}: {message_of(error)}")
            raise NoMotionError(f"{check.signature} raised {said}") from None
        if np.size(number) != size:
            raise NoMotionError(
                f"{check.signature} returned an array of shape {np.shape(number)}, where the equation "
                f"needs {shape}"
            )
        return np.reshape(number, shape)

    return value


@contextmanager
def bounded() -> Iterator[Callable[[], None]]:
    """A block that calls a student's code: silent, and no longer than BUDGET; NoMotionError says so.

    It gives a function to be called now and then, for systems on which `time_limit` has no effect.
    """
    aside, end = StringIO(), time.process_time() + BUDGET

    def in_time() -> None:
        if time.process_time() > end:
            raise NoMotionError(TOO_LONG)

    try:
        with (
            redirect_stdout(aside),
            redirect_stderr(aside),
            warnings.catch_warnings(),
            np.errstate(all="ignore"),
            time_limit(BUDGET),
        ):
            warnings.simplefilter("ignore")
            yield in_time
    except TimeLimitError:
        raise NoMotionError(TOO_LONG) from None
