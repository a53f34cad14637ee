"""Proofs, line by line: each line of a derivation follows from the one before by its reasons, or not.

Nothing is simplified: a step holds if its two sides agree in numbers, in many random worlds where its
reasons are given and nothing else is.
"""

from autograder.proofs.derivations import DERIVATIONS
from autograder.proofs.marking import mark
from autograder.proofs.of_mechanisms import derivation_of

__all__ = ["DERIVATIONS", "derivation_of", "mark"]
