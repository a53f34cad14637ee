"""What a marker sees and does, as values that can be sent to a page: lists, one answer, its points."""

from collections import Counter
from dataclasses import replace
from datetime import UTC, datetime

from autograder.digest import digest
from autograder.marking.asked import AskedError, asked_comment, asked_points, asked_rows
from autograder.marking.book import Book, Paper, Proof
from autograder.marking.kept import COUNTS, FIRST, SECOND, Entry, Given, Kept, counting

MOST_COMMENTS = 40  # that are offered again
TO_MARK, AGAIN, MARKED, BLANK = "to be marked", "changed since it was marked", "marked", "blank"


class ChangedError(Exception):
    """Somebody else has marked the answer since it was shown."""


class Desk:
    """One marker's. second: whose points are kept beside the first marker's, and do not count. names:
    whether students are named.
    """

    def __init__(self, book: Book, kept: Kept, second: bool = False, names: bool = False):
        self._book, self._kept = book, kept
        self._second, self._names = second, names
        self._by = SECOND if second else FIRST

    def proofs(self) -> list[dict]:
        """Each proof, with how many answers there are and how many are left."""
        found = []
        for proof in self._book.proofs():
            states = Counter(state for _, state in self._in_order(proof))
            count = states.total() - states[BLANK]
            told = {"assignment": proof.assignment, "cell": proof.cell, "second": self._second}
            told |= {"title": self._book.shown(proof, proof.title), "points": proof.rubric.points}
            told |= {"answers": count, "blank": states[BLANK], "left": count - states[MARKED]}
            told["apart"] = 0 if self._second else len(self._open_differences(proof))
            found.append(told)
        return found

    def proof(self, assignment: str, cell: str) -> dict:
        """What is asked, the model answer, the rubric, the answers in order and comments used before."""
        proof = self._find(assignment, cell)
        rubric = proof.rubric
        papers = [{"id": paper.id, "state": state} for paper, state in self._in_order(proof)
                  if state != BLANK]  # fmt: skip
        return {
            "title": self._book.shown(proof, proof.title),
            "points": rubric.points,
            "task": self._book.shown(proof, rubric.task),
            "model": self._book.shown(proof, rubric.model) if rubric.model else "",
            "rows": [
                {"points": row.points, "text": self._book.shown(proof, row.text)}
                for row in rubric.rows
            ],
            "fault": rubric.fault,
            "papers": papers,
            "comments": self._comments(proof),
            "second": self._second,
        }

    def answer(self, assignment: str, cell: str, id: str) -> dict:
        """One answer, and what this marker has given it."""
        proof, paper = self._paper(assignment, cell, id)
        written = self._book.written(proof, paper.student, not self._names)
        entry = self._kept.of(assignment, cell).get(paper.student, {})
        given, points = self._given(proof, paper, entry)
        comment, state = paper.comment, self._state(paper, entry)
        if self._second:
            before = entry.get(SECOND)
            comment = before.comment if before else ""
            if before and written.content and before.answer != written.content:
                state = AGAIN
        return {
            "answer": written.answer,
            "rest": written.rest,
            "beside": written.beside,
            "fault": written.fault,
            "suggested": list(written.suggested),
            "given": given,
            "points": points,
            "comment": comment,
            "state": state,
            "student": self._named(paper) if self._names else "",
            "version": self._version(paper, entry, written.content),
        }

    def save(self, said: dict) -> dict:
        """Give an answer points: `given`, for each row, or `total` in place of their sum; a comment.

        AskedError if something is no number, or too much. ChangedError unless `version` is the answer's.
        """
        proof, paper, content = self._read(said)
        rows = asked_rows(said.get("given"), proof.rubric.rows)
        points = asked_points(said.get("total"), proof.rubric.points, rows)
        comment = asked_comment(said.get("comment"))
        when = datetime.now(UTC).isoformat(timespec="seconds")
        given = Given(tuple(rows), points, comment, content, when)
        if not self._second:
            self._book.record(proof, paper.student, points, comment)
        self._kept.change(
            proof.assignment,
            proof.cell,
            paper.student,
            lambda entry: (
                {by: one for by, one in entry.items() if by != COUNTS} | {self._by: given}
            ),
        )
        return self._told(proof, paper)

    def take_back(self, said: dict) -> dict:
        """Put an answer back to those to be marked."""
        proof, paper, _ = self._read(said)
        if not self._second:
            self._book.record(proof, paper.student, None, paper.comment)
        self._kept.change(
            proof.assignment,
            proof.cell,
            paper.student,
            lambda entry: {by: one for by, one in entry.items() if by not in (self._by, COUNTS)},
        )
        return self._told(proof, paper)

    def differences(self, assignment: str, cell: str) -> dict:
        """The answers that both have marked, those first on which they are furthest apart."""
        proof = self._find(assignment, cell)
        if self._second:
            raise AskedError("A second marker does not see the first one's points.")
        found: list[dict] = []
        kept = self._kept.of(assignment, cell)
        readable = [one for one in self._in_order(proof) if one[1] != BLANK]
        for number, (paper, state) in enumerate(readable, 1):
            entry = kept.get(paper.student, {})
            if SECOND not in entry or state != MARKED:
                continue
            mine, theirs = self._first(paper, entry), entry[SECOND]
            chosen = entry[COUNTS].points if COUNTS in entry else None
            found.append(
                {
                    "number": number,
                    "id": paper.id,
                    "student": self._named(paper) if self._names else "",
                    "first": mine.points,
                    "second": theirs.points,
                    "comment": theirs.comment,
                    "rows": _rows_apart(mine, theirs),
                    "changed": bool(mine.answer) and mine.answer != theirs.answer,
                    "counts": chosen if chosen == paper.points else None,
                    "version": self._version(paper, entry),
                }
            )
        found.sort(key=lambda one: -abs(one["first"] - one["second"]))
        title = self._book.shown(proof, proof.title)
        return {"title": title, "points": proof.rubric.points, "papers": found}

    def choose(self, said: dict) -> dict:
        """Let the first or the second marker's points count, or others."""
        proof, paper, entry = self._asked(said)
        if self._second or SECOND not in entry or paper.points is None:
            raise AskedError(
                "There is nothing to choose: two people have to mark the answer first."
            )
        self._refuse_unless_seen(said, paper, entry)
        mine, theirs = self._first(paper, entry), entry[SECOND]
        if (which := said.get("which")) not in (FIRST, SECOND, "other"):
            raise AskedError("Choose the first points, the second, or give others.")
        chosen = theirs if which == SECOND else mine
        if which == "other":
            chosen = replace(
                chosen, points=asked_points(said.get("total"), proof.rubric.points, [])
            )
        comment = chosen.comment or mine.comment
        self._book.record(proof, paper.student, chosen.points, comment)
        self._kept.change(
            proof.assignment,
            proof.cell,
            paper.student,
            lambda entry: entry | {FIRST: mine, COUNTS: replace(chosen, comment=comment)},
        )
        return {"counts": chosen.points}

    def left(self) -> list[str]:
        """How many answers are left, in a line for each assignment in which somebody waits."""
        lines = []
        for one in self.proofs():
            if one["left"]:
                lines.append(f"{one['assignment']}: {one['left']} of {one['answers']} answers")
        return lines

    def _find(self, assignment: str, cell: str) -> Proof:
        for proof in self._book.proofs():
            if (proof.assignment, proof.cell) == (assignment, cell):
                return proof
        raise AskedError(f"No answer that a person reads is called {cell} in {assignment}.")

    def _paper(self, assignment: str, cell: str, id: str) -> tuple[Proof, Paper]:
        proof = self._find(assignment, cell)
        for paper in self._book.papers(proof):
            if paper.id == id:
                return proof, paper
        raise AskedError("This submission is no longer in the gradebook: go back to the list.")

    def _asked(self, said: dict) -> tuple[Proof, Paper, Entry]:
        """The answer that a request is about, and what is kept of it."""
        wanted = (str(said.get(name)) for name in ("assignment", "cell", "id"))
        proof, paper = self._paper(*wanted)
        return proof, paper, self._kept.of(proof.assignment, proof.cell).get(paper.student, {})

    def _read(self, said: dict) -> tuple[Proof, Paper, str]:
        """The answer that a request is about, and a name for its content. ChangedError unless it is the
        one that the marker has read.
        """
        proof, paper, entry = self._asked(said)
        content = self._book.content(proof, paper.student)
        self._refuse_unless_seen(said, paper, entry, content)
        return proof, paper, content

    def _refuse_unless_seen(
        self, said: dict, paper: Paper, entry: Entry, content: str = ""
    ) -> None:
        """ChangedError unless the answer is as the marker saw it."""
        if said.get("version") != self._version(paper, entry, content):
            raise ChangedError(
                "Since you opened this answer, somebody has marked it, here or in the Formgrader, or it "
                "was handed in again. Open it again to see what it has now; nothing was saved."
            )

    def _told(self, proof: Proof, paper: Paper) -> dict:
        """What the page needs after a change."""
        _, paper = self._paper(proof.assignment, proof.cell, paper.id)
        entry = self._kept.of(proof.assignment, proof.cell).get(paper.student, {})
        content = self._book.content(proof, paper.student)
        told = {"state": self._state(paper, entry), "version": self._version(paper, entry, content)}
        return told | {"comments": self._comments(proof)}

    def _in_order(self, proof: Proof) -> list[tuple[Paper, str]]:
        kept = self._kept.of(proof.assignment, proof.cell) if self._second else {}
        return [(paper, self._state(paper, kept.get(paper.student, {})))
                for paper in self._book.papers(proof)]  # fmt: skip

    def _state(self, paper: Paper, entry: Entry) -> str:
        if paper.blank:
            return BLANK
        if self._second:
            return MARKED if SECOND in entry else TO_MARK
        if not paper.to_read:
            return MARKED
        return TO_MARK if paper.by_hand is None else AGAIN

    def _given(
        self, proof: Proof, paper: Paper, entry: Entry
    ) -> tuple[list[float] | None, float | None]:
        """The points for each row of the rubric, None where they are not known, and those in all."""
        if self._second:
            given = entry.get(SECOND)
            points = given.points if given else None
        else:
            points = paper.by_hand if paper.to_read else paper.points
            given = counting(entry, points)
        if given is None:
            return None, points
        of = {met.text: met.given for met in given.rows}
        return [min(of.get(row.text, 0.0), row.points) for row in proof.rubric.rows], points

    def _first(self, paper: Paper, entry: Entry) -> Given:
        """What the first marker gave; without rows where it was not here."""
        given = entry.get(FIRST)
        if given and counting(entry, paper.points):
            return given
        return Given((), paper.points or 0.0, paper.comment, "", "")

    def _open_differences(self, proof: Proof) -> list[dict]:
        papers = self.differences(proof.assignment, proof.cell)["papers"]
        return [one for one in papers if one["first"] != one["second"] and one["counts"] is None]

    def _comments(self, proof: Proof) -> list[str]:
        """The paragraphs of this marker's comments, the most used first."""
        if self._second:
            kept = self._kept.of(proof.assignment, proof.cell).values()
            texts = [entry[SECOND].comment for entry in kept if SECOND in entry]
        else:
            texts = [paper.comment for paper in self._book.papers(proof)]
        parts = Counter(part.strip() for text in texts for part in text.split("\n\n"))
        return [text for text, _ in parts.most_common() if text][:MOST_COMMENTS]

    def _version(self, paper: Paper, entry: Entry, content: str = "") -> str:
        """content: a name for it, where the marker has the answer itself in view."""
        seen = (entry.get(SECOND),) if self._second else (paper, entry)
        return digest(repr((seen, content)))

    def _named(self, paper: Paper) -> str:
        return self._book.called(paper.student)


def _rows_apart(mine: Given, theirs: Given) -> list[int]:
    """The rows, from 1, for which two people gave different points."""
    if len(mine.rows) != len(theirs.rows):
        return []
    pairs = zip(mine.rows, theirs.rows, strict=True)
    return [number for number, (one, other) in enumerate(pairs, 1) if one.given != other.given]
