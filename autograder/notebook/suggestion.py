"""What the marked lines suggest to the person who reads an answer: points, and a comment.

It travels in the metadata of the answer's cell, to where nbgrader's rows are written. Whatever a
submission has there is removed first.
"""

from dataclasses import dataclass

from nbformat import NotebookNode

from autograder.proofs.marks import Marked

KEY = "armdyn_suggestion"


@dataclass(frozen=True)
class Suggestion:
    """points: of the answer, until a person gives others. comment: no word of it is the student's.
    of_lines: its part that stays true whatever the person gives. rows: of the table of points, from 1.
    """

    points: float
    comment: str
    of_lines: str = ""
    rows: tuple[int, ...] = ()

    def without_points(self, comment: str) -> str:
        """What is left of a comment that holds the suggestion, when a person has given the points."""
        return comment.replace(self.comment, self.of_lines).strip()


def suggest(cell: NotebookNode, marks: list[Marked]) -> None:
    """Write into a cell what the marks suggest; nothing where no line was handed in."""
    cell.metadata.pop(KEY, None)
    if any(marked.lines for marked in marks):
        most = float(cell.metadata["nbgrader"]["points"])
        points = min(sum(marked.points for marked in marks), most)
        said = " ".join(f"{_said(marked)}." for marked in marks if marked.lines)
        cell.metadata[KEY] = {
            "points": points,
            "comment": f"{said} {_suggested(marks, points, most)}",
            "of_lines": said,
            "rows": _rows(marks),
        }


def suggestion_of(cell: NotebookNode) -> Suggestion | None:
    said = cell.metadata.get(KEY)
    if not said:
        return None
    # A notebook that an earlier version graded has no of_lines, or no rows.
    of_lines, rows = str(said.get("of_lines", "")), tuple(map(int, said.get("rows", ())))
    return Suggestion(float(said["points"]), str(said["comment"]), of_lines, rows)


def _rows(marks: list[Marked]) -> list[int]:
    return sorted({row.number for marked in marks for row in marked.earned})


def _suggested(marks: list[Marked], points: float, most: float) -> str:
    rows = _rows(marks)
    which = f": row{'s' if len(rows) > 1 else ''} {_listed(rows)} of the table" if rows else ""
    return f"The lines suggest {points:g} of {most:g} points{which}."


def _said(marked: Marked) -> str:
    wrong = [number for number, line in enumerate(marked.lines, 1) if not line.holds]
    if not wrong:
        one = len(marked.lines) == 1
        end = "" if marked.done else f", and {'does' if one else 'do'} not show the whole yet"
        hold = "its line holds" if one else f"all {len(marked.lines)} lines hold"
        return f"{marked.derivation.id}: {hold}{end}"
    plural = len(wrong) > 1
    return (
        f"{marked.derivation.id}: line{'s' if plural else ''} {_listed(wrong)} of {len(marked.lines)} "
        f"{'do' if plural else 'does'} not hold"
    )


def _listed(numbers: list[int]) -> str:
    *first, last = map(str, numbers)
    return f"{', '.join(first)} and {last}" if first else last
