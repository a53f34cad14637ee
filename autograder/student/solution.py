"""`solution` shows the worked answer of a check, once the instructor has opened it."""

from datetime import datetime
from pathlib import Path

from autograder import worked_answers
from autograder.problems import READ, families, known_check
from autograder.problems.material.conventions import BOOK
from autograder.proofs import derivation_of
from autograder.student.display import say, show
from autograder.student.own_arm import drawn_for


def solution(id: str | None = None) -> None:
    """Show the worked answer to the check `id`, to a derivation such as "p2-E", or to a text that a
    person reads, such as "p1-proof".

    Before your instructor has opened it, a sentence says when that will be, where that is known.
    UnknownCheckError where neither a check nor a derivation has this id.
    """
    id = str(id) if _is_text(id) or _is_derivation(id) else known_check(id).id
    answer = opened().get(id)
    if answer is None:
        say(f"There is no worked answer for {id} yet. {_when(id)}")
    else:
        _show(id, answer)


def opened() -> dict[str, str]:
    """The worked answers that are open to this notebook, by grade_id."""
    return next(
        filter(None, (worked_answers.read(at / worked_answers.OPEN) for at in _places())), {}
    )


def _places() -> list[Path]:
    """Beside the notebook, and where the course's own exchange keeps its assignment."""
    here = Path.cwd()
    exchange = here.parent.parent / "course" / "exchange"
    return [here, *exchange.glob(f"*/outbound/{here.name}")]


def _when(id: str) -> str:
    """What is known of when it opens, as a sentence."""
    said = next(
        filter(
            None,
            (
                worked_answers.read(at / worked_answers.OPENS).get(worked_answers.WHEN)
                for at in reversed(_places())  # the exchange has the later news
            ),
        ),
        "",
    )
    try:
        time = worked_answers.time_of(said) if said else None
    except ValueError:
        said, time = "", None
    if not said:
        return "Your instructor opens it, and has named no date so far."
    if time is None:
        if _is_text(id):
            return "Worked answers are opened for code and derivations alone so far."
        if _is_derivation(id):
            return f"Your feedback page shows it if your lines for {id} are complete."
        return f"Your feedback page shows it if you have full marks for {id}."
    day = f"{time:%d %B %Y, %H:%M} ({time:%Z})".lstrip("0")
    if time > datetime.now().astimezone():
        return f"It opens on {day}."
    return (
        f"It was to open on {day}. Run `nbgrader fetch_assignment {Path.cwd().name}` in your course's "
        "folder to get it, or ask your instructor."
    )


def _show(id: str, answer: str) -> None:
    is_text, own = _is_text(id), drawn_for(id)
    if _is_derivation(id):
        differs = False  # its lines hold for every arm
    else:
        differs = own not in (None, BOOK) if is_text else families.differs(own, known_check(id))
    remark = worked_answers.OF_THE_BOOK if differs else ""
    show(worked_answers.mimebundle(id, answer, is_text, remark))


def _is_text(id: object) -> bool:
    """Whether a person reads the answer, which is no code."""
    return isinstance(id, str) and (id in READ or id.endswith("-proof"))


def _is_derivation(id: object) -> bool:
    return isinstance(id, str) and derivation_of(id) is not None
