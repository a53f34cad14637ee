"""Takes one step of an energy–momentum method, which needs the model and not ẋ alone."""

import numpy as np

from armdyn.iteration import to_rounding

# ∂H/∂q_i below this, beside the energies, is rounding: the motion does not depend on q_i.
CYCLIC = 1e-10


def energy_momentum(rate, t: float, x, dt: float) -> np.ndarray:
    """Order 2, implicit, also its own inverse in time; keeps the energy of a free arm to rounding.

    Not symplectic. With an input and friction the energy changes by their work along the step,
    (u − f)ᵀ Δq, with u at the middle of the step and f at the velocity Δq/dt; so friction never adds
    energy. The momentum of a coordinate that neither M nor P depends on (joint 1, if its axis is
    vertical or there is no gravity) is kept to rounding too.

    With H(q, p) = ½ pᵀ M⁻¹ p + P and z = [q; p], p = M q̇: the step is Δz = dt J ∇̄H with
    ∇̄H = ∇H + (ΔH − ∇Hᵀ Δz) w / (wᵀ Δz), all at the middle of the step, so that ∇̄Hᵀ Δz = ΔH. Here w
    is Δz, weighted by inertias, but for the coordinates that H does not depend on; those are left
    out, and their ∇̄H is 0. By fixed-point iteration to rounding.

    Raises FloatingPointError, with the time, where the iteration does not converge: dt is too long,
    or friction jumps; numpy.linalg.LinAlgError where M is singular.

    Source: O. Gonzalez (1996), Time Integration and Discrete Hamiltonian Systems, Journal of
    Nonlinear Science 6.
    """
    model = rate.model
    n = model.n
    if dt == 0:
        return x
    q, qd = x[..., :n], x[..., n:]
    p, P = np.matvec(model.M(q), qd), model.potential_energy(q)
    H = model.kinetic_energy(q, qd) + P

    def step(change):
        """Δq and Δp as they follow from the middle of the step that they make."""
        dq, dp = change[..., :n], change[..., n:]
        middle = q + dq / 2
        M = model.M(middle)
        v = _solved(M, p + dp / 2)
        slope = model.g_vec(middle) - np.vecmat(v, model.C(middle, v))  # ∂H/∂q
        w_p = _solved(M, dp)
        kinetic = np.vecdot(v, np.matvec(M, v)) / 2
        size = CYCLIC * (kinetic + np.max(np.abs(slope), axis=-1))[..., np.newaxis]
        share = slope**2 / np.where(size > 0, slope**2 + size**2, 1)
        w_q = share * np.einsum("...ii->...i", M) / dt**2 * dq
        along = np.vecdot(w_q, dq) + np.vecdot(w_p, dp)
        H_new = _kinetic(model, q + dq, p + dp) + model.potential_energy(q + dq)
        defect = H_new - H - np.vecdot(slope, dq) - np.vecdot(v, dp)
        factor = np.where(along > 0, defect / np.where(along > 0, along, 1), 0)[..., np.newaxis]
        dq_new = dt * (v + factor * w_p)
        u = rate.input(t + dt / 2, np.concatenate([middle, v], axis=-1))
        dp_new = dt * (u - model.f_vec(dq_new / dt) - slope - factor * w_q)
        return np.concatenate(np.broadcast_arrays(dq_new, dp_new), axis=-1)

    def step_or_nan(change):
        try:
            return step(change)
        except np.linalg.LinAlgError:
            raise  # a ValueError by descent, but of the model
        except (ValueError, OverflowError, FloatingPointError):  # no longer finite on the way
            return np.full_like(change, np.nan)

    # The model says so if M is singular or u has another shape, before anything is iterated.
    qdd = rate(t, x)[..., n:]
    first = dt * np.concatenate([qd, np.matvec(model.M(q), qdd)], axis=-1)
    z = np.concatenate([q, p], axis=-1)
    new = z + to_rounding(step_or_nan, first, z, "energy_momentum", t, dt)
    if not np.isfinite(new).all():
        return np.full_like(x, np.nan)
    q_new, p_new = new[..., :n], new[..., n:]
    return np.concatenate([q_new, _solved(model.M(q_new), p_new)], axis=-1)


def _kinetic(model, q, p):
    return np.vecdot(p, _solved(model.M(q), p)) / 2


def _solved(M, right):
    return np.linalg.solve(M, right[..., np.newaxis])[..., 0]
