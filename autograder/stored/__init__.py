"""Checks in numbers: what a student's package has in place of right answers and wrong models.

A visible check tries the same calls each time. So what the right answer, its terms and each mistake give
for these calls is computed when the package is made (`autograder.bundle`), and no formula is needed to
judge. The code that judges is the same.
"""

from autograder.stored import checks, files

__all__ = ["checks", "files"]
