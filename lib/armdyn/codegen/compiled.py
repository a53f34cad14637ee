"""Compiles a derivation to C callables: for one state, many states, and a whole RK4 loop."""

import math
import operator
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import ArrayLike

from armdyn.codegen import build, c_code, c_module, straight_line
from armdyn.codegen.numpy_code import SUSPECT, NumpyModel, generated_terms
from armdyn.derive import Derivation
from armdyn.manipulator import ROUNDING, Manipulator
from armdyn.parameters import finite, state_vector, vectors


def c_model(derivation: Derivation, values: Mapping[str, float]) -> "CompiledModel":
    """The derivation with numbers for its parameters, its dynamics compiled from C.

    The code depends on the derivation alone: other values use the same compiled module, which is
    kept in the user's cache folder, or in $ARMDYN_CACHE if that is set. Where the processor has
    vectors of several widths, the first build tries which is fastest, in about 0.3 s, and keeps the
    answer there too. The results do not depend on it.
    Raises `NoCompilerError`, saying what to install, if there is no C compiler, and ValueError as
    `numpy_model`.
    """
    return CompiledModel(derivation, values)


@dataclass(frozen=True, eq=False)
class CompiledModel(NumpyModel):
    """A `NumpyModel` whose q̈ and RK4 loop run in C.

    Raises `NoCompilerError` when made, if there is no C compiler. M, C, g, f and P stay NumPy's. Where
    M is close to singular, or an input not finite, the C code says so and `Manipulator.dynamics`
    decides: the answers and the errors are the same.
    """

    def __post_init__(self):
        super().__post_init__()
        _ = self._compiled, self._k

    def dynamics(self, q: ArrayLike, qd: ArrayLike, u: ArrayLike) -> np.ndarray:
        """q̈ = M⁻¹ (u − C q̇ − g − f), (n,); raises as `Manipulator.dynamics`.

        A subclass with another M, C, g or f moves by its own, here and in the other calls; what the
        model has when it first moves counts.
        """
        found = self._one(self._k, q, qd, u)
        return self._checked_dynamics(q, qd, u) if found is None else found

    def dynamics_many(
        self, q: ArrayLike, qd: ArrayLike, u: ArrayLike, out: np.ndarray | None = None
    ) -> np.ndarray:
        """q̈ of many states, (..., n), as `dynamics`; into `out` if given.

        out: float64, C-contiguous, of the shape of the result; ValueError for another.
        """
        # C sees what is not finite as it reads it: a look ahead would read all of it twice.
        states = vectors(self.n, q=q, qd=qd, u=u)
        shape = np.broadcast_shapes(*(s.shape for s in states))
        if out is None:
            out = np.empty(shape)
        elif not (
            isinstance(out, np.ndarray)
            and out.dtype == float
            and out.shape == shape
            and out.flags.c_contiguous
            and out.flags.writeable
        ):
            raise ValueError(f"out: needs a C-contiguous, writable float64 array of shape {shape}")
        if not _generated(self):
            out[...] = self.dynamics(*states)
        elif not self._run_many(states, out):
            out[...] = Manipulator.dynamics(self, *states)
        return out

    @cached_property
    def dynamics_floats(self):
        """q̈ from 3n plain numbers q1, …, q̇1, …, u1, …: a tuple of n floats. The quickest call.

        Raises TypeError for another number of arguments or what is no number, and otherwise as
        `dynamics`.
        """
        if not _generated(self):
            return self._checked_floats
        return partial(self._compiled.of_floats, self._k, self._checked_floats)

    def rk4(
        self, x0: ArrayLike, u: ArrayLike, dt: float, steps: int, final: bool = False
    ) -> np.ndarray:
        """States by the classical Runge–Kutta method, `steps` steps of `dt` s with constant input.

        x0: (2n,), the coordinates, then the velocities. u: (n,), N·m. Leading batch axes are many
        arms at once. Gives (steps + 1, 2n) from x0 on, or with `final` the last state only, (2n,).
        Raises ValueError, naming the argument; numpy.linalg.LinAlgError where M is singular to
        rounding on the way; FloatingPointError, saying when, where the state stops being finite.

        Source: W. Kutta (1901), Beitrag zur näherungsweisen Integration totaler
        Differentialgleichungen.
        """
        n = self.n
        x0, u = state_vector("x0", x0, 2 * n), state_vector("u", u, n)
        dt = finite("dt", dt, "s")
        try:
            steps = operator.index(steps)
        except TypeError:
            steps = -1
        if steps < 0:
            raise ValueError(
                f"steps = {steps!r}: needs a number of steps, an integer of at least 0"
            )
        try:
            batch = np.broadcast_shapes(x0.shape[:-1], u.shape[:-1])
        except ValueError:
            raise ValueError(
                f"x0 {x0.shape}, u {u.shape}: needs batch axes that broadcast to one shape"
            ) from None
        states = np.empty((*batch, 2 * n) if final else (*batch, steps + 1, 2 * n))
        if states.size == 0:
            return states
        if not _generated(self):
            return self._rk4_in_python(x0, u, dt, steps, states, final)
        stopped = self._compiled.rk4(
            self._k,
            n * ROUNDING,
            _rows(x0, batch, 2 * n),
            _rows(u, batch, n),
            dt,
            steps,
            not final,
            states.reshape(math.prod(batch), -1),
        )
        if stopped >= 0:
            self._explain(x0, u, batch, dt, *divmod(stopped, steps + 1))
        return states

    def _rk4_in_python(self, x, u, dt, steps, states, final):
        """The same loop by `state_derivative`, for a model with terms or dynamics of its own."""
        for step in range(steps + 1):
            if step:
                try:
                    with np.errstate(all="ignore"):
                        x = self._one_step(x, u, dt)
                except np.linalg.LinAlgError:
                    raise
                except ValueError:  # no longer finite on the way
                    x = np.full_like(x, np.nan)
                if not np.isfinite(x).all():
                    raise FloatingPointError(
                        f"the state stopped being finite at t = {step * dt:.6g} s"
                    )
            if not final:
                states[..., step, :] = x
        if final:
            states[...] = x
        return states

    @cached_property
    def _program(self):
        return straight_line.forward_dynamics(self._written)

    @cached_property
    def _compiled(self):
        code = c_code.source(self._program, self.n)
        return build.compiled(c_module.source(code, SUSPECT))

    @cached_property
    def _k(self):
        return np.array(self._constants(self._program), dtype=float)

    @cached_property
    def _one(self):
        return self._compiled.one if generated_terms(self) else lambda *_: None

    def _checked_floats(self, *numbers):
        states = np.array(numbers, dtype=float).reshape(3, self.n)
        found = self._checked_dynamics(*states) if _generated(self) else self.dynamics(*states)
        return tuple(found.tolist())

    def _checked_dynamics(self, q, qd, u):
        states = vectors(self.n, q=q, qd=qd, u=u)
        if not generated_terms(self):
            return Manipulator.dynamics(self, *states)
        found = np.empty(np.broadcast_shapes(*(s.shape for s in states)))
        return found if self._run_many(states, found) else Manipulator.dynamics(self, *states)

    def _run_many(self, states, out) -> bool:
        """q̈ of all states into `out`; False where C leaves one of them to `Manipulator`."""
        if out.size == 0:
            return True
        rows = [_rows(s, out.shape[:-1], self.n) for s in states]
        return self._compiled.many(self._k, *rows, out.reshape(-1, self.n))

    def _explain(self, x0, u, batch, dt, arm, step):
        """Raises what stopped the RK4 loop of one arm at one step."""
        n = self.n
        x = np.broadcast_to(x0, (*batch, 2 * n)).reshape(-1, 2 * n)[arm]
        torque = np.broadcast_to(u, (*batch, n)).reshape(-1, n)[arm]
        at = tuple(int(i) for i in np.unravel_index(arm, batch)) if batch else ()
        where = f" (state {', '.join(map(str, at))} of the batch)" if at else ""
        for _ in range(step):
            try:
                with np.errstate(all="ignore"):
                    x = self._one_step(x, torque, dt)
            except np.linalg.LinAlgError:
                raise
            except ValueError:  # no longer finite
                break
        raise FloatingPointError(f"the state stopped being finite at t = {step * dt:.6g} s{where}")

    def _one_step(self, x, u, dt):
        slopes = [self.state_derivative(x, u)]
        for reach in (dt / 2, dt / 2, dt):
            slopes.append(self.state_derivative(x + reach * slopes[-1], u))
        return x + dt / 6 * (slopes[0] + 2 * slopes[1] + 2 * slopes[2] + slopes[3])


_DYNAMICS, _SLOPE = CompiledModel.dynamics, CompiledModel.state_derivative


def _generated(model) -> bool:
    """Whether the compiled loops do what the model does by its methods."""
    cls = type(model)
    return (
        generated_terms(model)
        and cls.dynamics is _DYNAMICS
        and cls.state_derivative is _SLOPE
        and vars(model).keys().isdisjoint(("dynamics", "state_derivative"))
    )


def _rows(array, batch, width):
    """The array's rows, (N, width), contiguous; (1, width) where all rows are one."""
    if array.size == width:
        return np.ascontiguousarray(array).reshape(1, width)
    if array.shape[:-1] != batch:
        array = np.broadcast_to(array, (*batch, width))
    return np.ascontiguousarray(array).reshape(-1, width)
