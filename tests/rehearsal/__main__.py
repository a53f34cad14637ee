"""`python -m tests.rehearsal [STUDENTS]`: a whole term, in a folder that is kept."""

import sys
import tempfile
import time
from datetime import timedelta
from pathlib import Path

from tests.rehearsal.ledger import RULES
from tests.rehearsal.story import tell
from tests.rehearsal.term import Term


def main(size: int = 200) -> int:
    begun = time.monotonic()
    folder = Path(tempfile.mkdtemp(prefix="rehearsal-"))
    term = Term(folder / "course", size)
    differences = list(tell(term))
    for what, seconds in sorted(term.seconds.items(), key=lambda one: -one[1])[:25]:
        print(f"{seconds:7.1f} s  {what}")
    took = timedelta(seconds=round(time.monotonic() - begun))
    handed_in = len(term.ledger.hand_ins)
    print(f"{size} students, {len(RULES)} assignments, {handed_in} hand-ins: {took}")
    for line in differences:
        print(f"  {line}")
    print(f"{len(differences)} differences from the ledger; the course is in {term.root}")
    return int(bool(differences))


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
