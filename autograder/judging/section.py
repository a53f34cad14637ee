"""Where a lesson prepares a check."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Section:
    """A section of a lesson: the lesson's name, the id of the section's first cell, and its heading as
    plain text.
    """

    lesson: str
    cell: str
    heading: str

    @property
    def file(self) -> str:
        """The lesson's notebook."""
        return f"{self.lesson}.ipynb"

    @property
    def number(self) -> str:
        """The lesson's number, as it stands before its title: "03"; the name of one without a number."""
        number = self.lesson.partition("-")[0]
        return number if number.isdigit() else self.lesson
