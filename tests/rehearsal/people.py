"""The class: names as a registrar's office hands them on."""

import csv
import io
import random
from dataclasses import dataclass

FIRST = ("Ada", "Ève", "José María", "Zoë", "Nguyễn Văn", "Søren", "Łukasz", "İpek", "Ὑπατία", "小明",
         "محمد", "Jean-Luc", "Anne  Marie", "Δ", "Siân", "=HYPERLINK", "D'Arcy", "Björk")  # fmt: skip
LAST = ("Lovelace", "Doe, Jr.", "O'Neil", "Gauß", "de la Cruz, III", "Åström", "Nuñez",
        "d\u2019Alembert", "McDonald", "王", "Æsir", '"Bob" Smith', "+1", "@home", "-Dash", "St. John",
        "Null", "O")  # fmt: skip


@dataclass(frozen=True)
class Student:
    """id: of the folder. number: what the learning platform calls the student."""

    id: str
    first: str
    last: str
    number: int

    @property
    def name(self) -> str:
        return f"{self.first} {self.last}"

    @property
    def email(self) -> str:
        return f"s{self.number}@university.example"


def class_of(size: int, dice: random.Random) -> list[Student]:
    """Students whose names hold commas, apostrophes, quotes, signs of formulas and other scripts."""
    shapes = (
        "s{:05d}",
        "ab{:d}cd",
        "Müller.{:d}",
        "x-{:d}_y",
        "{:d}",
        "ünï{:d}",
        "O'Brien{:d}",
        "a b {:d}",
    )
    return [
        Student(
            shapes[at % len(shapes)].format(at), dice.choice(FIRST), dice.choice(LAST), 4000 + at
        )
        for at in range(size)
    ]


def class_list(students: list[Student]) -> str:
    """course/class.csv."""
    text = io.StringIO(newline="")
    rows = csv.writer(text)
    rows.writerow(("id", "last_name", "first_name", "email", "lms_id"))
    rows.writerows((one.id, one.last, one.first, one.email, one.number) for one in students)
    return text.getvalue()
