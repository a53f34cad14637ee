"""Runs a session of Mathics3 that knows an arm: you ask in the Wolfram Language, SymPy reads."""

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.parsing.mathematica import parse_mathematica

from armdyn.derive import Derivation
from armdyn.ports import wolfram
from armdyn.ports.calls import built, by_hand
from armdyn.ports.program import Program
from armdyn.ports.toolchain import Conversation, ProgramError

EVALUATE = 2
MOST_LETTERS = 1_000_000


class Session:
    """Mathics3, started with planar_2r.wl, or with what codegen writes for a derivation.

    A context manager, at whose end Mathics3 is ended. `program`: the Program that the same session
    answers as, in numbers. seconds: the time limit of each answer; the start takes five to ten.
    Raises ValueError for a derivation that cannot be written, and MissingToolError.
    """

    def __init__(self, derivation: Derivation | None = None, *, seconds: float = 60):
        model = self._model = by_hand() if derivation is None else derivation
        folder = built("wolfram", derivation)
        command = wolfram.toolchain().started_in(folder)
        self._conversation = Conversation(command, seconds=seconds)
        self.program = Program(self._conversation, model.n, len(model.parameters))

    def evaluate(self, text: str) -> str:
        """The InputForm of the value of an expression in the Wolfram Language.

        Raises ProgramError with the messages of Mathics3, if there are any; it has ended then.
        """
        answer = self._conversation.ask([EVALUATE, *map(ord, text)], at_most=MOST_LETTERS)
        return "".join(chr(int(letter)) for letter in answer)

    def read(self, text: str):
        """The value of an expression as SymPy reads it; lists become tuples.

        Symbols are those of the derivation; by hand those of `by_hand`.
        Raises ProgramError as `evaluate`, and where the value holds what is unknown to SymPy.
        """
        said = self.evaluate(text)
        value = sp.sympify(parse_mathematica(said))
        if unknown := value.atoms(AppliedUndef):
            raise ProgramError(f"{text} gave {said}: SymPy does not know {unknown}")
        return value.xreplace(self._symbols())

    def derivation(self) -> Derivation:
        """What Mathics3 has derived: M, C, g, f and P in symbols."""
        M, C, g_vec, f_vec, P = self.read("model`terms")
        model = self._model
        return Derivation(
            model.q,
            model.qd,
            model.parameters,
            sp.ImmutableMatrix(M),
            sp.ImmutableMatrix(C),
            sp.ImmutableMatrix(g_vec),
            P,
            sp.ImmutableMatrix(f_vec),
        )

    def __enter__(self):
        self.program.__enter__()
        return self

    def __exit__(self, *error):
        self.program.__exit__(*error)

    def _symbols(self):
        return {sp.Symbol(name.name): symbol for symbol, name in wolfram.named(self._model).items()}
