"""Stands for `autograder` where a submission is graded: the judging happens elsewhere."""


def check(id=None, fresh=False):
    """Do nothing: grade cells are judged outside, on numbers."""


def from_file(name):
    """The function in a file of another language."""
    from protocol.languages import from_file

    return from_file(name)


def hint(id=None):
    """Do nothing: hints are for the one who writes."""


def look_at(*ids):
    """A block that uses the student's functions, for the feedback page: an error becomes one line."""
    import sys

    from protocol import Look

    return Look(ids, sys._getframe(1).f_globals)
