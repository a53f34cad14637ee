"""Finds ids that look alike, such as `ada` and `Ada`: perhaps one student with two folders."""

import unicodedata
from collections import defaultdict
from collections.abc import Iterable


def alike(students: Iterable[str]) -> dict[str, list[str]]:
    """Student → the others whose id differs only in case, in spaces, or in how Unicode writes it.

    Students without such others are left out.
    """
    groups = defaultdict(list)
    for student in students:
        groups[_read(student)].append(student)
    return {
        student: [other for other in group if other != student]
        for group in groups.values()
        if len(group) > 1
        for student in group
    }


def _read(student: str) -> str:
    folded = unicodedata.normalize("NFKC", student).casefold()
    # Folding may take a letter apart again.
    return "".join(unicodedata.normalize("NFKC", folded).split())
