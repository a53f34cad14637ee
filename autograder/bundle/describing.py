"""Writes down objects of a check so that `autograder.stored.reading` makes them again.

Numbers and texts are written as they are, and what is made of them by its fields. A function is written
by its name, which the student's package has too; one without a name, such as a lambda, by a maker that
is written for it. A right model is never written: `beside` keeps its numbers.
"""

import base64
import dataclasses
import sys
import types
from collections.abc import Mapping
from enum import Enum
from functools import partial
from types import SimpleNamespace

import numpy as np

from autograder.bundle.makers import Makers
from autograder.judging.models import Beside
from autograder.judging.quantities import each


class DescribingError(ValueError):
    """Something in a check cannot be written down; the message says what, and where."""


@dataclasses.dataclass
class Describing:
    """makers: takes the functions that have no name. names: the functions and classes that are needed,
    as "module:name". beside: the right models that were met, each once.
    """

    makers: Makers
    names: set[str] = dataclasses.field(default_factory=set)
    beside: list[Beside] = dataclasses.field(default_factory=list)

    def of(self, value):
        """What stands for the value in JSON; DescribingError where nothing can."""
        match value:
            case None | bool() | int() | str() if not isinstance(value, Enum):
                return value
            case np.generic():
                return self.of(value.item())
            case float():
                return value
            case np.ndarray():
                return {"array": _array(value)}
            case Enum():
                return {"member": [self._named(type(value)), value.name]}
            case each() if (name := _name(value.parts)) and _has_name(value, name):
                return {"ref": self._needed(name)}  # a decorated function
            case Beside():
                return {"beside": self._place(value)}
            case SimpleNamespace():
                return {"namespace": self._all(vars(value))}
            case tuple():
                return {"tuple": [self.of(part) for part in value]}
            case list():
                return {"list": [self.of(part) for part in value]}
            case Mapping():
                return {"dict": [[key, self.of(part)] for key, part in value.items()]}
            case partial():
                args = [self.of(part) for part in value.args]
                return {"partial": [self.of(value.func), args, self._all(value.keywords)]}
            case types.FunctionType() if "<" in value.__qualname__:
                name, cells = self.makers.of(value)
                return {"made": [name, [self.of(cell) for cell in cells]]}
            case type() | types.FunctionType() | types.BuiltinFunctionType():
                return {"ref": self._named(value)}
        if dataclasses.is_dataclass(value):
            return {"make": [self._named(type(value)), self._all(_fields(value))]}
        raise DescribingError(
            f"{value!r} is neither numbers nor text, nor made of them by its fields"
        )

    def _all(self, named: Mapping) -> dict:
        return {name: self.of(part) for name, part in named.items()}

    def _named(self, value) -> str:
        name = _name(value)
        if not _has_name(value, name):
            raise DescribingError(f"{name} is another object than the one that the check has")
        return self._needed(name)

    def _needed(self, name: str) -> str:
        self.names.add(name)
        return name

    def _place(self, value: Beside) -> int:
        if value not in self.beside:
            self.beside.append(value)
        return self.beside.index(value)


def _name(value) -> str:
    return f"{value.__module__}:{value.__qualname__}" if hasattr(value, "__qualname__") else ""


def _has_name(value, name: str) -> bool:
    """Whether the name stands for this very object."""
    module, _, of = name.partition(":")
    found: object = sys.modules[module]
    for part in of.split("."):
        found = getattr(found, part, None)
    return found is value


def _fields(value) -> dict:
    """A dataclass's fields, without those that are what they would be anyway."""
    return {
        field.name: own
        for field in dataclasses.fields(value)
        if field.init and (own := getattr(value, field.name)) is not field.default
    }


def _array(value: np.ndarray) -> list:
    """Its type, its shape, and its bytes: to the last bit, and short."""
    if value.dtype == object:
        raise DescribingError("an array of objects is no array of numbers")
    data = np.ascontiguousarray(value)
    return [data.dtype.str, list(value.shape), base64.b64encode(data.tobytes()).decode()]
