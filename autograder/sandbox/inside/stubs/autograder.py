"""Stands for `autograder` in the sandbox; the grader judges outside it."""


def check(id=None, fresh=False):
    """Do nothing: the grader judges the functions outside the sandbox."""


def from_file(name):
    """The function in a file of another language."""
    from protocol.languages import from_file

    return from_file(name)


def hint(id=None):
    """Do nothing: nobody reads hints here."""


_lines = {}


def derivation(id=None, lines=()):
    """Keep the lines for the grader, which marks them outside the sandbox."""
    from protocol import handed_in

    _lines[str(id)] = handed_in(lines)


def print_lines(id):
    """Called by the grader: the lines that were handed in last, as JSON."""
    from protocol import HandedIn, encode_handed_in

    print(encode_handed_in(_lines.get(id, HandedIn())))


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
