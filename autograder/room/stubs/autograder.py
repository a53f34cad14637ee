"""Stands for `autograder` where a submission is graded: the judging happens elsewhere."""


def check(id, fresh=False):
    """Do nothing: grade cells are judged outside, on numbers."""


def hint(id):
    """Do nothing: hints are for the one who writes."""
