"""The term, event by event, each by the command that the guide gives for it."""

import random
import re
import shutil
import time
from collections.abc import Iterable
from datetime import UTC, timedelta
from pathlib import Path

import nbformat
from nbgrader.api import Gradebook

from autograder.marking.desk import Desk
from autograder.marking.kept import Kept
from autograder.nbgrader_glue.by_hand import ByHand
from tests.autograder import courses
from tests.autograder.course_problems import without_plots
from tests.autograder.lms.platforms import canvas_name, moodle_folder, moodle_sheet, zipped
from tests.rehearsal.hand_ins import DAMAGED, Problem, hand_in, problem
from tests.rehearsal.ledger import BERLIN, DAY, RULES, HandIn, Ledger, calendar, drawn
from tests.rehearsal.mistakes import MISTAKES, made_in
from tests.rehearsal.people import class_list, class_of

ROOT = Path(__file__).parents[2]
P1, P2, P3, P4 = "p1-inertia", "p2-energy-skew", "p3-pendulum", "p4-gravity"
SEED = "rehearsed"
# A lecturer's own test that asks too much: rows in a list, which students return, have no shape.
OWN_TEST = (
    "\n### BEGIN HIDDEN TESTS\nassert M(np.zeros(2), cutter).shape == (2, 2)\n### END HIDDEN TESTS"
)
ITS_CELL = "p1-M"


class Term:
    """A course in the folder `root`, which is made; its ledger; and how long each event took."""

    def __init__(self, root: Path, size: int, names: Iterable[str] = RULES, dice=20261130):
        self.root, self.names = root, list(names)
        self.dice = random.Random(dice)
        self.students = class_of(size, self.dice)
        self.ledger = Ledger()
        self.problems: dict[str, Problem] = {}
        self.seconds: dict[str, float] = {}
        self.said: dict[str, str] = {}

    def run(self, *command: str, status: int = 0) -> str:
        """One command of the kit or of nbgrader; it must end with this status."""
        begun = time.monotonic()
        said = self.said[" ".join(command[1:])] = courses.run(self.root, *command, status=status)
        what = " ".join(command[:3])
        self.seconds[what] = self.seconds.get(what, 0.0) + time.monotonic() - begun
        return said

    def set_up(self) -> None:
        self.root.mkdir()
        shutil.copy(ROOT / "nbgrader_config.py", self.root)
        for name in self.names:
            shutil.copytree(ROOT / "solutions" / name, self.root / "solutions" / name)
            self._give_all_the_same_arm(name)
        if P3 in self.names:  # its figures take most of its time, and are not what is graded
            path = self.root / "solutions" / P3 / f"{P3}.ipynb"
            nbformat.write(without_plots(nbformat.read(path, as_version=4)), path)
        if P1 in self.names:
            self._edit(P1, ITS_CELL, lambda cell: cell.update(source=cell.source + OWN_TEST))
        for name in self.names:
            self.run("nbgrader", "generate_assignment", name)
            self.problems[name] = problem(self.root, name)
        course = self.root / "course"
        (course / "seed").write_text(SEED)
        (course / "class.csv").write_text(class_list(self.students), encoding="utf-8")
        self._write_calendar()

    def hand_in(self, name: str) -> None:
        """Everybody's hand-in: by Moodle's archive for p3, by Canvas's for p4, else as collected."""
        of = self.problems[name]
        self.ledger.points[name] = {test: of.points[test] for test in of.tests}
        mistakes = made_in(name, self.dice)
        texts = {}
        for student in self.students:
            one = drawn(self.dice, name, len(of.tests), student.id, mistakes)
            if one is not None:
                self.ledger.hand_ins[student.id, name] = one
                texts[student.id] = self._text(name, one)
        unlucky = self.dice.sample(sorted(texts), min(len(DAMAGED), len(texts) // 4))
        for id, text in zip(unlucky, DAMAGED, strict=False):
            self.ledger.hand_ins[id, name].damaged = True
            texts[id] = text
        take = {P3: self._from_moodle, P4: self._from_canvas}.get(name, self._as_collected)
        take(name, texts)

    def grade(self, name: str) -> None:
        broken = sum(one.damaged for (_, of), one in self.ledger.hand_ins.items() if of == name)
        said = self.run("autograder", "grade", name, "--jobs", "2", status=int(broken > 0))
        assert said.count(" could not be graded  ") == broken, said

    def read_proofs(self, name: str) -> None:
        """A person reads most of the proofs, and gives half points, too: some of p2's on the page of
        `autograder mark`, the others in the formgrader.
        """
        most = self.problems[name].points[self.problems[name].proof]
        marks = {}
        for (student, of), one in self.ledger.hand_ins.items():
            if of == name and one.unread and not one.damaged and self.dice.random() < 0.95:
                one.read = marks[student] = self.dice.randint(0, int(2 * most)) / 2
                one.to_read_again = False
        on_the_page = sorted(marks)[:40] if name == P2 else []
        self._mark_at_the_desk(name, {student: marks.pop(student) for student in on_the_page})
        self._mark(name, marks)

    def settle(self) -> None:
        """What being late costs, of proofs that were read in the formgrader, which does not say so."""
        self.run("autograder", "export")

    def mend_the_own_test(self) -> None:
        """All of p1 is judged again; what a person gave is kept."""
        self._edit(
            P1, ITS_CELL, lambda cell: cell.update(source=cell.source.removesuffix(OWN_TEST))
        )
        self.run("nbgrader", "generate_assignment", P1, "--force")
        self.grade(P1)

    def change_points(self, name: str, test: str, points: int) -> None:
        self._edit(name, test, lambda cell: cell.metadata.nbgrader.update(points=points))
        self.run("nbgrader", "generate_assignment", name, "--force")
        self.ledger.points[name][test] = points
        self.grade(name)

    def hand_in_again(self, name: str) -> tuple[str, str]:
        """After a person's marks: one with the same proof, whose mark stands, and one with another,
        which is to be read.
        """
        read = sorted(student for (student, of), one in self.ledger.hand_ins.items()
                      if of == name and one.read is not None and not one.damaged)  # fmt: skip
        same, other = self.dice.sample(read, 2)
        for student in (same, other):
            one = self.ledger.hand_ins[student, name]
            one.answered, one.wrong = len(self.problems[name].tests), None
            if student == other:
                one.proof += " And so on."
                one.to_read_again = True
            text = self._text(name, one, "again")
            hand_in(self.root, student, name, text, self._time(name, one))
        self.grade(name)
        return same, other

    def extend(self, name: str, student: str, long: timedelta) -> None:
        self.ledger.extensions[student, name] = long
        self._write_calendar()

    def withdraw(self, student: str) -> None:
        self.run("autograder", "forget", student, "--yes")
        self.students = [one for one in self.students if one.id != student]
        self.ledger.withdrawn.add(student)
        for key in [key for key in self.ledger.hand_ins if key[0] == student]:
            del self.ledger.hand_ins[key]

    def late_ones(self, name: str) -> list[str]:
        """Whose hand-in was read and is late by less than a week."""
        return sorted(student for (student, of), one in self.ledger.hand_ins.items()
                      if of == name and 0 < one.late < 7 * 86_400 and not one.damaged)  # fmt: skip

    def think_again(self, name: str) -> None:
        """Before the deadline and after a first look at the marks, some hand in once more: three have
        mended what was wrong, and one has spoilt what was right. The last hand-in counts.
        """
        early = [(student, one) for (student, of), one in sorted(self.ledger.hand_ins.items())
                 if of == name and one.late < 0 and not one.damaged]  # fmt: skip
        mended = [(student, one) for student, one in early if one.wrong][:3]
        spoilt = [(student, one) for student, one in early if not one.wrong][:1]
        for student, one in mended + spoilt:
            one.wrong = None if one.wrong else MISTAKES[name][0]
            one.answered, one.late = len(self.problems[name].tests), one.late // 2
            hand_in(self.root, student, name, self._text(name, one), self._time(name, one))

    def gradebook(self) -> Gradebook:
        return Gradebook(courses.database(self.root))

    def _text(self, name: str, one: HandIn, note: str = "") -> str:
        return self.problems[name].notebook(one.answered, one.proof, note, one.wrong)

    def _mark(self, name: str, marks: dict[str, float]) -> None:
        with self.gradebook() as gradebook:
            for student, points in marks.items():
                grade = gradebook.find_grade(self.problems[name].proof, name, name, student)
                grade.manual_score, grade.needs_manual_grade = points, False
            gradebook.db.commit()

    def _mark_at_the_desk(self, name: str, marks: dict[str, float]) -> None:
        if not marks:
            return
        book = ByHand(self.root)
        desk = Desk(book, Kept(self.root))
        (proof,) = (one for one in book.proofs() if one.assignment == name)
        id_of = {paper.student: paper.id for paper in book.papers(proof)}
        worth = [row.points for row in proof.rubric.rows]
        for at, (student, points) in enumerate(marks.items()):
            where = name, proof.cell, id_of[student]
            said = dict(zip(("assignment", "cell", "id"), where, strict=True))
            # Row by row, as far as the points go; or, every other time, as one number.
            given = [min(most, max(0.0, points - sum(worth[:k]))) for k, most in enumerate(worth)]
            said |= {"given": given, "total": None, "comment": ""}
            if at % 2:
                said |= {"given": [0] * len(worth), "total": points}
            desk.save(said | {"version": desk.answer(*where)["version"]})

    def _give_all_the_same_arm(self, name: str) -> None:
        """The ledger knows the answers for the arm of the book alone."""
        path = self.root / "solutions" / name / f"{name}.ipynb"
        text = path.read_text(encoding="utf-8")
        path.write_text(
            re.sub(r"(own_arm\(.*?)\)", r"\1, same_for_all=True)", text), encoding="utf-8"
        )

    def _edit(self, name: str, id: str, change) -> None:
        path = self.root / "solutions" / name / f"{name}.ipynb"
        notebook = nbformat.read(path, as_version=4)
        (cell,) = (one for one in notebook.cells
                   if one.metadata.get("nbgrader", {}).get("grade_id") == id)  # fmt: skip
        change(cell)
        nbformat.write(notebook, path)

    def _write_calendar(self) -> None:
        given = {key: long for key, long in self.ledger.extensions.items()
                 if key[0] not in self.ledger.withdrawn and key[1] in self.names}  # fmt: skip
        text = calendar(given, self.names)
        (self.root / "course" / "calendar.toml").write_text(text, encoding="utf-8")

    def _time(self, name: str, one: HandIn, zone=UTC) -> str:
        when = RULES[name].due.astimezone(UTC) + timedelta(seconds=one.late)
        return f"{when.astimezone(zone):%Y-%m-%d %H:%M:%S %Z}"

    def _as_collected(self, name: str, texts: dict[str, str]) -> None:
        for student, text in texts.items():
            time = self._time(name, self.ledger.hand_ins[student, name])
            hand_in(self.root, student, name, text, time)

    def _from_moodle(self, name: str, texts: dict[str, str]) -> None:
        """Two archives: one downloaded two days before the deadline, and one after it. Some who had
        handed in by then, with a mistake, do so again: in time, which counts, or late, which does not.
        """
        when = {id: self.ledger.hand_ins[id, name] for id in texts}
        for one in when.values():
            one.late -= one.late % 60  # Moodle's sheet has no seconds
        readable = {id: one for id, one in when.items() if not one.damaged}
        again = [id for id, one in readable.items() if -DAY <= one.late <= 0 and not one.wrong][:4]
        too_late = [id for id, one in readable.items() if one.late > DAY][:2]
        proofs = {id: readable[id].proof for id in again + too_late}
        asked, wrong = len(self.problems[name].tests), MISTAKES[name][0]
        early = {id: HandIn(asked, proof, -3 * DAY, wrong=wrong) for id, proof in proofs.items()}
        self._by_moodle(name, early, {id: self._text(name, one) for id, one in early.items()}, 0)
        self._by_moodle(name, when, texts, 1)
        for id in too_late:
            self.ledger.hand_ins[id, name] = early[id]

    def _by_moodle(
        self, name: str, hand_ins: dict[str, HandIn], texts: dict[str, str], status: int
    ) -> None:
        files, rows = {}, []
        for one in self.students:
            row = {"number": one.number, "name": one.name, "email": one.email}
            if one.id in hand_ins:
                late = timedelta(seconds=hand_ins[one.id].late)
                local = (RULES[name].due.astimezone(UTC) + late).astimezone(BERLIN)
                row["submitted"] = f"{local:%A, %d %B %Y, %I:%M %p}"
                files[f"{moodle_folder(one.name, one.number)}/{name} (1).ipynb"] = texts[one.id]
            rows.append(row)
        archive = zipped(self.root / "moodle.zip", files)
        sheet = moodle_sheet(self.root / "moodle.csv", rows)
        command = ["autograder", "collect-zip", name, str(archive), "--sheet", str(sheet)]
        self.run(*command, status=status)

    def _from_canvas(self, name: str, texts: dict[str, str]) -> None:
        """Canvas's archive has no times: it says who was late, and p4 has no penalty."""
        files = {}
        for at, one in enumerate(self.students):
            if one.id in texts:
                late = self.ledger.hand_ins[one.id, name].late > 0
                shown = canvas_name(
                    f"{one.last}, {one.first}", one.number, 7000 + at, f"{name}.ipynb", late
                )
                files[shown] = texts[one.id]
        archive = zipped(self.root / "canvas.zip", files)
        self.run("autograder", "collect-zip", name, str(archive), status=1)
