"""What a course's own checks are made of: checks/NAME.py imports it from here."""

from autograder.judging.check import Check, Criterion
from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.models import AtPoints, Beside
from autograder.judging.quantities import UnfitError, array, each, one_number, vector
from autograder.judging.section import Section
from autograder.judging.terms import Term
from autograder.protocol import Call, Symbol

__all__ = [
    "AtPoints", "Beside", "Call", "Check", "Claim", "Criterion", "Mistake", "Section", "Symbol",
    "Term", "UnfitError", "array", "each", "one_number", "vector",
]  # fmt: skip
