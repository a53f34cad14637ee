"""Finds the base parameters: the combinations of π that joint torques show."""

from dataclasses import dataclass

import numpy as np

from armdyn.regressor import parameter_names, regressor

# A column whose part outside the span of the others is below this share of it depends on them.
DEPENDENT = 1e-8
# A column below this share of the largest is 0, apart from rounding.
NEGLIGIBLE = 1e-12


@dataclass(frozen=True, eq=False)
class BaseParameters:
    """The combinations of π that the equation of motion contains: Y π = Y[:, independent] (K π).

    independent: the columns of Y that are kept. combination: K, (rank, len(π)): row i is the parameter
    of column independent[i] with its shares of the dropped ones. columns: those that were tried.
    names: of all entries of π.
    """

    independent: tuple[int, ...]
    combination: np.ndarray
    columns: tuple[int, ...]
    names: tuple[str, ...]

    @property
    def rank(self) -> int:
        return len(self.independent)

    @property
    def descriptions(self) -> tuple[str, ...]:
        """Each base parameter in words, such as "J1 + 0.25 m2"."""
        return tuple(
            _as_sum(own, row, self.names)
            for own, row in zip(self.independent, self.combination, strict=True)
        )

    def __str__(self):
        return f"{self.rank} base parameters: " + "; ".join(self.descriptions)


def base_parameters(model, columns=None) -> BaseParameters:
    """The base parameters of a model's geometry, numerically, from random states.

    columns: indices of the entries of π that may be other than 0, all of them by default;
    `on_link_axes(model)` gives those of a planar arm whose centres of mass lie on the links' axes.
    A column is kept if it is not a combination of those kept before it, inertias tried first, then
    first moments, masses last, so that masses move into the parameters of other links. The states
    come from a fixed seed: the same geometry gives the same base.

    Raises ValueError for columns that are not distinct indices of entries of π.

    Source: M. Gautier (1991), Numerical Calculation of the Base Inertial Parameters of Robots, for
    the idea; here orthogonalisation stands for the QR decomposition.
    """
    names = parameter_names(model)
    columns = _column_indices(columns, len(names))
    W = _random_rows(model)
    size = np.linalg.norm(W, axis=0)
    W = W / np.where(size > NEGLIGIBLE * np.max(size), size, np.inf)
    independent = _independent(W, sorted(columns, key=lambda j: (_rank_of_wish(names[j]), j)))
    shares = np.linalg.lstsq(W[:, independent], W, rcond=None)[0]
    shares[np.abs(shares) < DEPENDENT] = 0
    combination = shares * size / size[independent, np.newaxis]
    dropped = np.setdiff1d(np.arange(len(names)), columns)
    combination[:, dropped] = 0
    combination[:, independent] = np.eye(len(independent))
    return BaseParameters(tuple(independent), combination, columns, names)


def on_link_axes(model) -> tuple[int, ...]:
    """All columns of Y but those of m cy, which are not needed if the centres lie on the axes.

    Raises ValueError for a spatial chain.
    """
    names = parameter_names(model)
    if len(names) != 4 * model.n:
        raise ValueError(f"model: got {type(model).__name__}, needs a planar arm")
    return tuple(j for j, name in enumerate(names) if " cy" not in name)


def _random_rows(model) -> np.ndarray:
    """Y at random states, stacked."""
    rng = np.random.default_rng(0)
    # Several times as many equations as there are columns, 4n or 10n.
    q, qd, qdd = rng.uniform(-np.pi, np.pi, (3, 40, model.n))
    Y = regressor(model, q, qd, qdd)
    return Y.reshape(-1, Y.shape[-1])


def _independent(W, order) -> list[int]:
    """The columns that do not lie in the span of those before them in this order; sorted."""
    kept, basis = [], np.empty((len(W), 0))
    for j in order:
        rest = W[:, j]
        for _ in range(2):  # once is not orthogonal to rounding
            rest = rest - basis @ (basis.T @ rest)
        length = np.linalg.norm(rest)
        if length > DEPENDENT:
            kept.append(j)
            basis = np.column_stack([basis, rest / length])
    return sorted(kept)


def _rank_of_wish(name: str) -> int:
    return 0 if name.startswith("J") else 1 if " c" in name else 2


def _column_indices(columns, count) -> tuple[int, ...]:
    if columns is None:
        return tuple(range(count))
    given = tuple(columns)
    valid = all(isinstance(j, int | np.integer) and 0 <= j < count for j in given)
    if not valid or len(set(given)) != len(given) or not given:
        raise ValueError(f"columns = {columns!r}: needs distinct indices from 0 to {count - 1}")
    return tuple(sorted(int(j) for j in given))


def _as_sum(own, row, names) -> str:
    text = names[own]
    for j in np.flatnonzero(row):
        if j != own:
            share = abs(row[j])
            times = "" if np.isclose(share, 1, rtol=1e-9) else f"{share:.4g} "
            text += f" {'+' if row[j] > 0 else '−'} {times}{names[j]}"
    return text
