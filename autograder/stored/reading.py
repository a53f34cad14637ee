"""Makes Python's objects of what `autograder.bundle.describing` wrote of them."""

import base64
import importlib
from collections.abc import Callable
from functools import partial
from types import SimpleNamespace

import numpy as np


def restored(said, beside: Callable[[int], object] | None = None):
    """The object. beside: gives the stored model of this number, where there may be one."""
    if not isinstance(said, dict):
        return said
    ((kind, of),) = said.items()

    def all_of(parts) -> list:
        return [restored(part, beside) for part in parts]

    def named(parts) -> dict:
        return {name: restored(part, beside) for name, part in parts.items()}

    match kind:
        case "tuple":
            return tuple(all_of(of))
        case "list":
            return all_of(of)
        case "dict":
            return {key: restored(value, beside) for key, value in of}
        case "namespace":
            return SimpleNamespace(**named(of))
        case "array":
            dtype, shape, data = of
            return np.frombuffer(base64.b64decode(data), dtype=dtype).reshape(shape).copy()
        case "member":
            owner, name = of
            return _named(owner)[name]
        case "ref":
            return _named(of)
        case "partial":
            function, args, words = of
            return partial(restored(function, beside), *all_of(args), **named(words))
        case "make":
            owner, fields = of
            return _named(owner)(**named(fields))
        case "made":
            maker, cells = of
            return _named(maker)(*all_of(cells))
        case "beside":
            assert beside is not None
            return beside(of)
    raise ValueError(f"nothing can be made of {kind!r}")


def _named(name: str):
    module, _, of = name.partition(":")
    found = importlib.import_module(module)
    for part in of.split("."):
        found = getattr(found, part)
    return found
