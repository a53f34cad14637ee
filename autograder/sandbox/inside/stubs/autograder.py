"""Stands for `autograder` in the sandbox; the grader judges outside it."""


def check(id=None, fresh=False):
    """Do nothing: the grader judges the functions outside the sandbox."""


def from_file(name):
    """The function in a file of another language."""
    from protocol.languages import from_file

    return from_file(name)


def hint(id=None):
    """Do nothing: nobody reads hints here."""


def look_at(*ids):
    """A block that uses the student's functions; an error in it becomes one line."""
    import sys

    from protocol import Look

    return Look(ids, sys._getframe(1).f_globals)
