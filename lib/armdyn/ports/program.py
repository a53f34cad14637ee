"""Runs a model's program in another language: the terms at states, and simulations."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from armdyn.parameters import all_finite, positive, real_array, state_vector
from armdyn.ports.toolchain import Conversation, ProgramError

TERMS, SIMULATE = 0, 1
# The program reads a whole request before it answers, so that more states take several requests.
ROWS = 10_000


@dataclass(frozen=True)
class Terms:
    """The terms of the equation of motion at states, as a program gave them; SI units."""

    M: np.ndarray = field(metadata={"doc": "inertia matrices, (..., n, n), kg·m²"})
    C: np.ndarray = field(metadata={"doc": "Coriolis matrices, (..., n, n), kg·m²/s"})
    g_vec: np.ndarray = field(metadata={"doc": "gravity vectors, (..., n), N·m"})
    f_vec: np.ndarray = field(metadata={"doc": "friction, (..., n), N·m"})
    potential_energy: np.ndarray = field(metadata={"doc": "(...), J"})
    qdd: np.ndarray = field(metadata={"doc": "accelerations, (..., n), rad/s²"})


class Program:
    """A started program; as a context manager, it ends the program at the end of its block.

    n: the number of joints; count: of parameters. Both methods raise ValueError for arrays that
    have another shape or are not finite, and ProgramError if the program fails; it has ended then.
    """

    def __init__(self, conversation: Conversation, n: int, count: int):
        self.n, self.count = n, count
        self._conversation = conversation

    def terms(self, parameters: ArrayLike, states: ArrayLike, u: ArrayLike | None = None) -> Terms:
        """M, C, g, f, P and q̈ at states (..., 2n) = [q; q̇], for inputs u (..., n), zero if None.

        parameters: (..., count), in the program's order. Batch axes of all three broadcast.
        """
        n = self.n
        parameters = state_vector("parameters", parameters, self.count)
        states = state_vector("states", states, 2 * n)
        u = state_vector("u", np.zeros(n) if u is None else u, n)
        given = (parameters, states, u)
        try:
            batch = np.broadcast_shapes(*(a.shape[:-1] for a in given))
        except ValueError:
            shapes = ", ".join(str(a.shape) for a in given)
            raise ValueError(
                f"parameters, states, u: shapes {shapes} need batch axes that broadcast"
            ) from None
        rows = np.concatenate([np.broadcast_to(a, (*batch, a.shape[-1])) for a in given], axis=-1)
        rows = rows.reshape(-1, rows.shape[-1])
        widths = [n * n, n * n, n, n, 1, n]
        found = np.empty((len(rows), sum(widths)))
        for at in range(0, len(rows), ROWS):
            part = rows[at : at + ROWS]
            found[at : at + ROWS] = self._ask(TERMS, part, (len(part), sum(widths)))
        M, C, g, f, P, qdd = np.split(found, np.cumsum(widths)[:-1], axis=-1)
        square, vector = (*batch, n, n), (*batch, n)
        return Terms(
            M.reshape(square),
            C.reshape(square),
            g.reshape(vector),
            f.reshape(vector),
            P.reshape(batch),
            qdd.reshape(vector),
        )

    def simulate(
        self, parameters: ArrayLike, x0: ArrayLike, u: ArrayLike, t: ArrayLike, *, substeps: int = 1
    ) -> np.ndarray:
        """States (len(t), 2n) by RK4 with u held, from x0 (2n,) at t[0].

        t: (T,), s, evenly spaced; from one time to the next the program takes `substeps` steps.
        """
        n = self.n
        parameters = state_vector("parameters", parameters, self.count)
        x0, u = state_vector("x0", x0, 2 * n), state_vector("u", u, n)
        for name, array in (("parameters", parameters), ("x0", x0), ("u", u)):
            if array.ndim != 1:
                raise ValueError(f"{name}: got shape {array.shape}, needs one arm's, 1 axis")
        if isinstance(substeps, bool) or not isinstance(substeps, int) or substeps < 1:
            raise ValueError(f"substeps = {substeps!r}: needs a whole number, at least 1")
        steps, spacing = _even(t)
        request = np.concatenate(
            [parameters, x0, u, [spacing / substeps, steps * substeps, substeps]]
        )
        return self._ask(SIMULATE, request, (steps + 1, 2 * n))

    def close(self) -> None:
        """End the program."""
        self._conversation.close()

    def __enter__(self):
        self._conversation.__enter__()
        return self

    def __exit__(self, *error):
        self._conversation.__exit__(*error)

    def _ask(self, kind, numbers, shape):
        due = int(np.prod(shape))
        answer = self._conversation.ask(np.concatenate([[kind], np.ravel(numbers)]), at_most=due)
        if answer.size != due:
            raise ProgramError(f"the program gave {answer.size} numbers instead of {due}")
        return answer.reshape(shape)


def _even(t):
    """(number of steps, their length) of evenly spaced times."""
    t = all_finite("t", real_array("t", t))
    if t.ndim != 1 or len(t) < 2:
        raise ValueError(f"t: got shape {t.shape}, needs two or more increasing times, (T,), in s")
    spacing = positive("t[-1] - t[0]", float(t[-1] - t[0]), "s") / (len(t) - 1)
    even = t[0] + spacing * np.arange(len(t))
    # Rounding of t itself is all that may differ.
    off = np.abs(t - even)
    if np.max(off) > 8 * np.finfo(float).eps * max(abs(t[0]), abs(t[-1])):
        k = int(np.argmax(off))
        raise ValueError(f"t[{k}] = {t[k]}: needs evenly spaced times, here {even[k]}")
    return len(t) - 1, spacing
