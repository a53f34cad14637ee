"""What people do wrong with single velocities: in a row of C q̇, in an entry of C, in Ṁ."""

from itertools import combinations_with_replacement

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation.answers.composition import Group
from autograder.mutation.mutant import Mutant
from autograder.mutation.whole import whole

# How often a product of two velocities is held, or a velocity, by what is wrong with it.
TIMES = {"dropped": 0.0, "of the wrong sign": -1.0, "halved": 0.5, "doubled": 2.0}


def in_coriolis(mechanism: Outline) -> Group:
    """C with a product of two velocities in a row of C q̇, or a velocity in an entry, not there once;
    or with one velocity too many in an entry.
    """
    n, right = mechanism.n, whole(mechanism)
    names = [c.rate for c in mechanism.coordinates]
    mutants, weights = [], []
    for words, times in TIMES.items():
        for i in range(n):
            for j, k in combinations_with_replacement(range(n), 2):
                product = f"{names[j]}²" if j == k else f"{names[j]} {names[k]}"
                mutants.append(Mutant(f"product {words}", entry=f"row {i + 1}", put=product))
                weights.append(np.ones((n, n, n)))
                weights[-1][i, [j, k], [k, j]] = times
        for i, j, k in np.ndindex(n, n, n) if n > 1 else ():
            entry = f"C{i + 1}{j + 1}"
            mutants.append(Mutant(f"velocity {words}", entry=entry, put=names[k]))
            weights.append(np.ones((n, n, n)))
            weights[-1][i, j, k] = times
    entries = list(np.ndindex(n, n)) if n > 1 else []
    for i, j in entries:
        entry = f"C{i + 1}{j + 1}"
        mutants += [Mutant("velocity squared", entry=entry, put=name) for name in names]
        mutants += [Mutant("velocity too many", entry=entry, put=name) for name in names]
        mutants.append(Mutant("velocity too many", entry=entry, put=" + ".join(names)))

    def numbers(q, qd, arms):
        h = right(q, qd, arms).christoffel()
        found = [*np.einsum("mijk,cijk,ck->mcij", np.array(weights), h, qd, optimize=True)]
        parts = h * qd[:, None, None, :]
        C = np.sum(parts, axis=-1)
        for i, j in entries:
            of, value = parts[:, i, j], C[:, i, j]
            there = np.sum(qd * (h[:, i, j] != 0), axis=-1)
            more = [value + of[:, k] * (qd[:, k] - 1) for k in range(n)]
            more += [value * factor for factor in (*qd.T, there)]
            for one in more:
                wrong = C.copy()
                wrong[:, i, j] = one
                found.append(wrong)
        return np.array(found)

    return Group(mutants, numbers)


def in_inertia_rate(mechanism: Outline) -> Group:
    """Ṁ with a velocity not there once, or squared: in all entries, or in one and its copy."""
    n, right = mechanism.n, whole(mechanism)
    names = [c.rate for c in mechanism.coordinates]
    pairs = [(i, j) for i in range(n) for j in range(i, n)] if n > 1 else []
    everywhere = np.ones((n, n))
    masks = {"": everywhere}
    for i, j in pairs:
        mask = np.zeros((n, n))
        mask[[i, j], [j, i]] = 1
        masks[f"Ṁ{i + 1}{j + 1}"] = mask
    places = [
        (mask, k, times)
        for times in (*TIMES.values(), None)
        for mask in masks.values()
        for k in range(n)
    ]
    mutants = [
        Mutant(f"velocity {words}", entry=entry, put=name)
        for words in (*TIMES, "squared")
        for entry in masks
        for name in names
    ]

    def numbers(q, qd, arms):
        known = right(q, qd, arms)
        parts = known.slopes * qd[:, None, None, :]
        found = []
        for mask, k, times in places:
            factor = qd[:, k, None, None] if times is None else times
            found.append(known.M_dot + mask * parts[..., k] * (factor - 1))
        return np.array(found)

    return Group(mutants, numbers)
