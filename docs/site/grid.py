"""Chooses the settings of a control of which a page holds the pictures."""

import itertools
from collections.abc import Iterator

from docs.site.controls import Input

# A step that a reader can follow: of every second value, every third …
STRIDES = (1, 2, 3, 5, 10, 20, 30, 50, 100)
FEWEST = 5  # values of a slider, or all that it has


def choose(inputs: tuple[Input, ...], most: int) -> tuple[list[list[int]], int]:
    """The values of each input, as indices, and how many inputs may be away from their start.

    The start is always among the values, and zero where the input has it. There are at most `most`
    settings: as many inputs as possible may move together, then the steps are as fine as possible.
    Where even single inputs have too many values, they have as few as their strides allow.
    """
    for together in range(len(inputs), 0, -1):
        strides = [0] * len(inputs)
        while _count(kept := _kept(inputs, strides), together) > most:
            coarser = [
                i
                for i, part in enumerate(inputs)
                if strides[i] + 1 < len(_strides(part))
                and (together == 1 or len(_values(part, strides[i] + 1)) >= FEWEST)
            ]
            if not coarser:
                break
            strides[max(coarser, key=lambda i: len(kept[i]))] += 1
        else:
            return kept, together
    return kept, 1


def settings(kept: list[list[int]], starts: list[int], together: int) -> Iterator[tuple[int, ...]]:
    """Each setting, as a place in the values of each input, with at most `together` off their start."""
    moved = [
        [k for k in range(len(values)) if k != s] for values, s in zip(kept, starts, strict=True)
    ]
    for count in range(together + 1):
        for which in itertools.combinations(range(len(kept)), count):
            for places in itertools.product(*(moved[i] for i in which)):
                setting = list(starts)
                for i, place in zip(which, places, strict=True):
                    setting[i] = place
                yield tuple(setting)


def _kept(inputs: tuple[Input, ...], strides: list[int]) -> list[list[int]]:
    return [_values(part, stride) for part, stride in zip(inputs, strides, strict=True)]


def _values(part: Input, stride: int) -> list[int]:
    every = _strides(part)[stride]
    return list(range(part.start % every, len(part.values), every))


def _strides(part: Input) -> list[int]:
    zero = part.values.index(0) if 0 in part.values else part.start
    far = max(part.start, len(part.values) - 1 - part.start)
    return [s for s in STRIDES if (zero - part.start) % s == 0 and s <= max(far, 1)]


def _count(kept: list[list[int]], together: int) -> int:
    """Σ over the sets of up to `together` inputs of the product of their values but the start."""
    by_size = [1] + [0] * together
    for values in kept:
        for size in range(together, 0, -1):
            by_size[size] += by_size[size - 1] * (len(values) - 1)
    return sum(by_size)
