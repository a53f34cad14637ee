"""A controller as a chain of steps, each of which sees those before it; a mistake replaces some."""

from collections.abc import Callable
from types import SimpleNamespace


def chain(right: dict[str, Callable], arguments: str, result: Callable) -> Callable:
    """law(step=…): the function of these arguments, with some of its steps replaced."""

    def law(**replaced):
        steps = right | replaced

        def answer(*given):
            w = SimpleNamespace(**dict(zip(arguments.split(), given, strict=True)))
            for name, step in steps.items():
                setattr(w, name, step(w))
            return result(w)

        return answer

    return law
