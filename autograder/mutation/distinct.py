"""Mistakes that can be told apart by their numbers."""

import numpy as np

# To less than this share of the answer two mistakes give the same numbers.
SAME = 1e-7
# So many are compared.
CASES = 8


def each_once(every, numbers, right) -> list:
    """Those with numbers of their own, in their order: not the right ones, nor an earlier one's."""
    scale = np.max(np.abs(right))
    flat = numbers.reshape(len(every), -1)
    found = np.empty((len(every) + 1, flat.shape[1]))
    found[0] = right.ravel()
    kept: list[int] = []
    for i, own in enumerate(flat):
        size = max(scale, np.max(np.abs(own)))
        apart = np.max(np.abs(found[: len(kept) + 1] - own), axis=1)
        if np.all(np.isfinite(own)) and np.all(apart > SAME * size):
            kept.append(i)
            found[len(kept)] = own
    return [every[i] for i in kept]
