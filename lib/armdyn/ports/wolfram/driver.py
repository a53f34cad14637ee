"""Answers requests, messages of numbers, in Mathics3: a program of its own, run in its folder.

What the numbers mean is said by armdyn.ports, and in driver.wl. One more request is 2 and the code
points of an expression in the Wolfram Language; the answer is the code points of the InputForm of
its value.
"""

import os
import sys

import numpy as np
from mathics.core.atoms import Integer, Number, Real
from mathics.core.evaluation import Message
from mathics.core.expression import Expression
from mathics.core.list import ListExpression
from mathics.core.load_builtin import import_and_load_builtins
from mathics.core.symbols import Symbol
from mathics.session import MathicsSession

DOUBLE = np.dtype("<f8")
TERMS, SIMULATE, EVALUATE = 0, 1, 2


class Driver:
    """A session of Mathics3 with driver.wl, which fails where Mathics would go on with a message."""

    def __init__(self):
        # MathicsSession of Mathics3 10.0.1 would load them itself, but fails before: it looks up
        # $CharacterEncoding, which is one of them, and gets a ValueError where it awaits KeyError.
        import_and_load_builtins()
        self.session = MathicsSession()
        self.evaluate('Get["driver.wl"]')
        self.n = self.length("model`q")
        self.count = self.length("model`parameters")

    def evaluate(self, text):
        return self.without_messages(self.session.evaluate(text))

    def call(self, function, *arguments):
        evaluation = self.session.evaluation
        evaluation.out.clear()
        evaluation.iteration_count = 0
        return self.without_messages(Expression(Symbol(function), *arguments).evaluate(evaluation))

    def without_messages(self, result):
        said = self.session.evaluation.out
        if messages := [m for m in said if isinstance(m, Message)]:
            sys.exit("\n".join(map(str, messages)))
        return result

    def length(self, variables):
        return self.evaluate(f"Length[{variables}]").value

    def answer(self, request):
        kind, numbers = request[0], request[1:]
        if kind == TERMS:
            rows = numbers.reshape(-1, self.count + 3 * self.n)
            return [entry for row in rows for entry in self.numbers("driver`terms", reals(row))]
        if kind == SIMULATE:
            parameters, x0, u, (dt, steps, stride) = np.split(
                numbers, np.cumsum([self.count, 2 * self.n, self.n])
            )
            held = reals(np.concatenate([parameters, u]))
            times = Real(float(dt)), Integer(int(steps)), Integer(int(stride))
            return self.numbers("driver`simulation", held, reals(x0), *times)
        text = "".join(map(chr, numbers.astype(int)))
        return [ord(letter) for letter in self.evaluate(f"ToString[{text}, InputForm]").value]

    def numbers(self, function, *arguments):
        return list(leaves(self.call(function, *arguments)))


def reals(array):
    return ListExpression(*(Real(float(x)) for x in array))


def leaves(value):
    """The numbers of nested lists, in order."""
    if isinstance(value, Number):
        yield float(value.value)
    elif isinstance(value, ListExpression):
        for element in value.elements:
            yield from leaves(element)
    else:
        sys.exit(f"{value} is not a number")


def read(count):
    found = sys.stdin.buffer.read(int(count) * DOUBLE.itemsize)
    return np.frombuffer(found, DOUBLE) if len(found) == count * DOUBLE.itemsize else None


def main():
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    driver = Driver()
    while (count := read(1)) is not None and (request := read(count[0])) is not None:
        answer = np.array(driver.answer(request), DOUBLE)
        message = b"numbers:" + np.array([answer.size], DOUBLE).tobytes() + answer.tobytes()
        sys.stdout.buffer.write(message)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
