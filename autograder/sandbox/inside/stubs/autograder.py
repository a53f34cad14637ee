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


_examples = {}


def lay_example(id, call):
    """Called by the grader before the notebook's cells run: a call that this check makes, as JSON."""
    _examples[id] = call


def worst_case(id=None):
    """Arguments as the check passes them: the grader shows no verdict here, and so no worst case."""
    import json

    from protocol import decode_call, real

    if id not in _examples:
        raise LookupError(f"there is no check {id!r}")
    values = tuple(map(real, decode_call(json.loads(_examples[id])).args))
    return values if len(values) != 1 else values[0]


def look_at(*ids):
    """A block that uses the student's functions; an error in it becomes one line."""
    import sys

    from protocol import Look

    return Look(ids, sys._getframe(1).f_globals)


def watch(id=None):
    """Do nothing: nobody looks at pictures here."""
