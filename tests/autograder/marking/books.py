"""A gradebook in memory, with one proof of four answers."""

from dataclasses import replace

from autograder.marking.book import Paper, Proof, Written
from autograder.marking.rubric import Row, Rubric

PROOF = Proof(
    "p3", "By hand", Rubric("p3-proof", 3.0, "Show it.", "So.", (Row(1.0, "why"), Row(2.0, "how")))
)


class Book:
    def __init__(self):
        self.rows = {
            student: Paper(f"id-{student}", student, suggested, None, True, False, "")
            for student, suggested in (("ada", 1.0), ("bob", None), ("cem", None))
        }
        self.rows["nil"] = Paper("id-nil", "nil", 0.0, None, False, True, "")
        self.text = "By Newton."

    def proofs(self):
        return [PROOF]

    def papers(self, proof):
        return sorted(self.rows.values(), key=lambda one: one.id)

    def written(self, proof, student, hidden):
        return Written(answer=f"<p>{self.text}</p>", content=self.text, suggested=(1,))

    def content(self, proof, student):
        return self.text

    def shown(self, proof, markdown):
        return markdown

    def called(self, student):
        return student.title()

    def record(self, proof, student, points, comment):
        self.rows[student] = replace(
            self.rows[student], by_hand=points, to_read=points is None, comment=comment
        )
