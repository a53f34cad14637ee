"""Computes once what several mistakes of one answer are made of."""

from collections.abc import Callable

import numpy as np


def shared(function: Callable) -> Callable:
    """The function; its last result again, where it is called with the very same objects.

    They must not be changed meanwhile, and neither can the result, where it is an array.
    """
    last: list[tuple] = []

    def remembered(*args):
        if last:
            before, result = last[0]
            if len(before) == len(args) and all(a is b for a, b in zip(before, args, strict=True)):
                return result
        result = function(*args)
        if isinstance(result, np.ndarray):
            result.setflags(write=False)
        last[:] = [(args, result)]
        return result

    return remembered
