"""Tries the checks of a mechanism, or of the course's own, as `autograder try`."""

import argparse
from itertools import chain
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.saying import complain
from autograder.terminal import say


def add_to(commands) -> None:
    trying = commands.add_parser(
        "try",
        help="try the checks of a mechanism, or of checks/NAME.py: right answers, every mistake, and "
        "what students read",
    )
    trying.add_argument(
        "mechanism",
        type=argument.mechanism,
        help="its name, such as cart-pole; a file with MECHANISM; or the name of a file in checks/",
    )
    trying.add_argument(
        "--asks", type=argument.answers, help="try these answers alone, as M,C (default: all)"
    )
    trying.add_argument("--all", action="store_true", help="print every mistake's sentence, too")
    trying.add_argument(
        "--names",
        action="store_true",
        help="as --all, with each mistake's name, for sentences of your own",
    )
    trying.add_argument(
        "--to",
        type=argument.new_file,
        metavar="FILE",
        help="write every mistake's sentence to this file",
    )
    trying.add_argument(
        "--every",
        action="store_true",
        help="hand in every mistake in the energies to the real grader, not a few; this takes long",
    )
    trying.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Try a mechanism's checks; the exit status is 1 if a mistake is not named by its sentence."""
    from autograder.authoring.course import NoMechanismError, files_of, found
    from autograder.authoring.leads_on import led_on
    from autograder.authoring.own_problem import checks_file
    from autograder.authoring.rehearsal import mistaken, rehearsed
    from autograder.files import put_in_place
    from autograder.mechanisms.file import MechanismFileError
    from autograder.mutation.answers import ANSWERS
    from autograder.mutation.trial import Line, Tried, summary, tried

    if checks_file(root, given.mechanism).is_file():
        return _of_checks(root, given.mechanism)
    try:
        mechanism = found(root, given.mechanism)
        files = files_of(root, given.mechanism, mechanism)
    except (NoMechanismError, MechanismFileError) as error:
        return complain(str(error))
    asked = list(ANSWERS) if given.asks is None else given.asks
    if unknown := [answer for answer in asked if answer not in ANSWERS]:
        return complain(f"there is no answer {unknown[0]!r}; known are {', '.join(ANSWERS)}")
    made: list[Tried] = []
    shown: list[Line] = []
    parts = (
        led_on(root, mechanism),
        tried(mechanism, asked, given.names, made),
        (line for line in summary(made)),
        rehearsed(mechanism, files, asked),
        mistaken(mechanism, files, asked, given.every),
    )
    for line in chain(*parts):
        shown.append(line)
        if not line.detail:
            say(line.text if line.good else f"! {line.text}")
    every = [line.text if line.good else f"! {line.text}" for line in shown]
    if given.all or given.names:
        say("\n".join(["", "All of it:", *every]))
    if given.to:
        try:
            put_in_place(given.to, "\n".join(every) + "\n")
        except OSError as error:
            return complain(f"{given.to} cannot be written: {error}")
        say(f"All of it: {given.to}")
    if failed := sum(not line.good for line in shown if not line.detail):
        return complain(f"{failed} lines, marked with !, are not as they should be", 1)
    return 0


def _of_checks(root: Path, name: str) -> int:
    """Try checks/NAME.py."""
    from autograder.authoring.own_problem import OwnChecksError, checks_file
    from autograder.authoring.own_trial import tried

    failed = 0
    try:
        text = checks_file(root, name).read_text(encoding="utf-8", errors="replace")
        for line in tried(root, name, text):
            say(line.text if line.good else f"! {line.text}")
            failed += not line.good
    except (OwnChecksError, OSError) as error:
        return complain(str(error))
    return complain(f"{failed} lines, marked with !, are not as they should be", 1) if failed else 0
