"""A term that is missing, turned round or counted wrongly; or that stands where it does not belong."""

from collections.abc import Iterator

import sympy as sp

from autograder.mutation.operators.rewriting import Rewriting, times


def dropped(term, mechanism):
    yield Rewriting("dropped", times(0, term))


def wrong_sign(term, mechanism):
    yield Rewriting("wrong sign", times(-1, term))


def doubled(term, mechanism):
    yield Rewriting("doubled", times(2, term))


def halved(term, mechanism):
    yield Rewriting("halved", times(sp.Rational(1, 2), term))


def astray(
    entries: sp.Tuple, names: list[str], copies: list[int], moves: bool
) -> Iterator[Rewriting]:
    """What a term contributes to one entry, in another to which it contributes nothing.

    names: of the entries. copies: for each entry the place of the one that equals it by symmetry.
    moves: also where it then lacks in the entry to which it belongs.
    """
    for target, old in enumerate(entries):
        if old != 0 or target > copies[target]:
            continue
        for source, value in enumerate(entries):
            if value == 0 or value in entries[:source]:
                continue
            wrong = list(entries)
            wrong[target] = wrong[copies[target]] = value
            yield Rewriting("astray", sp.Tuple(*wrong), names[source], "", names[target])
            if moves:
                wrong[source] = sp.S.Zero
                yield Rewriting("moved", sp.Tuple(*wrong), names[source], "", names[target])
