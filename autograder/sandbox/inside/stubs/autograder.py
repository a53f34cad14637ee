"""Stands for `autograder` in the sandbox; the grader judges outside it."""


def check(id=None, fresh=False):
    """Do nothing: the grader judges the functions outside the sandbox."""


def from_file(name):
    """The function in a file of another language."""
    from protocol.languages import from_file

    return from_file(name)


def hint(id=None):
    """Do nothing: nobody reads hints here."""


def solution(id=None):
    """Do nothing: a worked answer is no answer of the student's."""


_drawn = {}


def lay_own_arm(problem, described):
    """Called by the grader before the notebook's cells run: the arm that it drew for this student."""
    _drawn[problem] = described


def own_arm(problem, name=None, *, arm=None, year=0, same_for_all=False):
    """The arm that the grader drew for this student, whatever is given here; the grader shows it."""
    from protocol import OwnArm

    if problem not in _drawn:
        raise ValueError(f"own_arm has no arm for {problem!r}")
    return None if name is not None and arm is None else OwnArm(**_drawn[problem])


def look_at(*ids):
    """A block that uses the student's functions; an error in it becomes one line."""
    import sys

    from protocol import Look

    return Look(ids, sys._getframe(1).f_globals)
