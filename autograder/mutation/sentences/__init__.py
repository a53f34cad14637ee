"""What a student reads of a mistake. A new sentence goes

- into `of_terms` for what was done to a term, or to all of them alike,
- into `of_steps` for what went wrong on the way to the answer,
- into `of_columns` for columns of a regressor that were taken for each other,
- into `rows` for one answer, mechanism, term or entry alone, where you know a better one.

A sentence says what is seen, then where to look; it never holds a formula. `choice` picks it, and
`notation` writes the names in it as the lessons do.
"""

from autograder.mutation.sentences.choice import GENERAL, sentence
from autograder.mutation.sentences.of_columns import OF_A_TERM, OF_COLUMNS
from autograder.mutation.sentences.of_terms import THROUGHOUT
from autograder.mutation.sentences.rows import ROWS, Row

__all__ = ["GENERAL", "OF_A_TERM", "OF_COLUMNS", "ROWS", "THROUGHOUT", "Row", "sentence"]
