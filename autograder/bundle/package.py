"""The files of a student's package: the library, what judges, and checks in numbers.

A module is in the package as it is, or in parts (`shaking`), or another one stands in its place
(`stand_ins`). Everything else is left out, so that a new module of the graders' is, too.
"""

import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path, PurePosixPath

import autograder
from autograder import lesson_checks
from autograder.bundle.describing import Describing
from autograder.bundle.makers import Makers
from autograder.bundle.oldest import OLDEST, unreadable_line
from autograder.bundle.shaking import Shaking, ShakingError, path_of
from autograder.bundle.storing import in_numbers
from autograder.judging.check import Check
from autograder.problems import MODULES, families, own_checks
from autograder.problems.material import given
from autograder.problems.material.conventions import FAMILY

AUTOGRADER = Path(autograder.__file__).parent
STAND_INS = Path(__file__).parent / "stand_ins"
# Folders and files of `autograder` that a student's package has as they are.
WHOLE = (
    *("judging", "protocol", "proofs", "stored", "student"),
    *("__init__", "digest", "files", "hints_seen", "lab", "lab_server", "terminal"),
    *("worked_answers", "pictures/__init__", "lesson_checks/__init__", "lesson_checks/choice"),
    *("lesson_checks/number", "lesson_checks/typed", "problems/__init__", "problems/arm_card"),
    *("problems/material/__init__", "problems/material/described", "checks"),
    *("nbgrader_glue/exchange/__init__", "nbgrader_glue/exchange/entered"),
    *("nbgrader_glue/exchange/students", "nbgrader_glue/environment", "nbgrader_glue/patience"),
    "nbgrader_glue/validating",
)
# But for this one, whose formulas lead from one answer to the next.
LEFT_OUT = ("judging/carried/ways.py",)
IN_PARTS = (
    "autograder.problems.",
    "autograder.lesson_checks.lesson_",
    "autograder.mutation.answers.",
    f"{own_checks.PACKAGE}.",
)
CHECKS = '\nfrom autograder.stored.checks import checks\n\nCHECKS = checks("{name}")\n'
START = "start_here"  # lesson 00 has its check


def _as_it_is(check: Check) -> Check:
    return check


def package(
    problems: Iterable[str],
    own: Iterable[Check] = (),
    completed: Callable[[Check], Check] = _as_it_is,
) -> dict[str, bytes]:
    """By its path in the wheel: each file.

    problems: names of the problems' folders, as "p3_pendulum", whose checks can be asked. own: the
    checks of problems about mechanisms, and those of the course's own. completed: gives a problem's
    check the mistakes that the course adds to it. DescribingError, ShakingError where something of a
    check cannot be stored.
    """
    files = dict(_whole())
    describing = Describing(Makers())
    data = dict(_stored({START, *problems}, own, completed, describing))
    files |= {
        f"autograder/stored/data/{name}.json": json.dumps(of).encode() for name, of in data.items()
    }
    return files | dict(_in_parts(describing))


def _whole() -> Iterator[tuple[str, bytes]]:
    armdyn = path_of("armdyn").parent
    for path in _files(armdyn):
        yield f"armdyn/{path.relative_to(armdyn).as_posix()}", path.read_bytes()
    for name in WHOLE:
        module = AUTOGRADER / f"{name}.py"
        for path in [module] if module.is_file() else _files(AUTOGRADER / name):
            within = path.relative_to(AUTOGRADER).as_posix()
            if within not in LEFT_OUT:
                yield f"autograder/{within}", path.read_bytes()
    for path in _files(STAND_INS):
        yield f"autograder/{path.relative_to(STAND_INS).as_posix()}", path.read_bytes()


def _files(folder: Path) -> list[Path]:
    """Those that are part of the code: no caches, and nothing hidden."""
    found = sorted(path for path in folder.rglob("*") if path.is_file())
    return [path for path in found if path.suffix != ".pyc" and not path.name.startswith(".")]


def _stored(
    problems: set[str],
    own_ones: Iterable[Check],
    completed: Callable[[Check], Check],
    describing: Describing,
) -> Iterator[tuple[str, dict]]:
    """By their names: the files of the checks and of their numbers."""

    def stored(checks: Iterable, to: str) -> Iterator[tuple[str, dict]]:
        said = []
        for check in checks:
            if not isinstance(check, Check):
                said.append(describing.of(check))
                continue
            name = f"{check.id}{to[to.find('@') :] if '@' in to else ''}"
            made = in_numbers(check, name, describing)
            said.append(made.asked)
            yield f"numbers-{name}", made.numbers
        yield f"checks-{to}", {"checks": said}

    asked = [module for module in MODULES if _folder(module) in problems]
    for module in asked:
        checks = [completed(check) for check in module.CHECKS]
        yield from stored(checks, _folder(module))
        for check in checks:
            for own in FAMILY if check.id in families.OF_THE_ARM else ():
                yield from stored([families.on(own, check)], f"{check.id}@{own.name}")
    for number in lesson_checks.numbers():
        yield from stored(lesson_checks.of_lesson(number).CHECKS, f"lesson_{number}")
    yield from stored(own_ones, "mechanisms")
    short = {_folder(module).partition("_")[0] for module in asked}
    yield (
        "given",
        {
            problem: {own.name: given.code(own, problem) for own in FAMILY}
            for problem in sorted(short.intersection(given.GIVEN))
        },
    )


def _folder(module) -> str:
    return module.__name__.split(".")[-2]


def _in_parts(describing: Describing) -> Iterator[tuple[str, bytes]]:
    shaking = Shaking(lambda module: module.startswith(IN_PARTS), _has)
    for name in sorted(describing.names):
        shaking.need(*name.split(":"))
    for known in MODULES:
        shaking.need(known.__name__, "READ")
    for module in describing.makers.sources:
        shaking.need_source(module, describing.makers.written(module))
    of_checks = {module.__name__: _folder(module) for module in MODULES} | {
        f"autograder.lesson_checks.lesson_{number}": f"lesson_{number}"
        for number in lesson_checks.numbers()
    }
    for module in sorted({*shaking.modules, *of_checks}):
        source = f'"""What judging needs of {module}, which holds answers too."""\n'
        if module in shaking.modules:
            source += f"{shaking.source(module)}\n\n\n{describing.makers.written(module)}"
        source += CHECKS.format(name=of_checks[module]) if module in of_checks else ""
        if line := unreadable_line(source):
            raise ShakingError(
                f"{path_of(module)}: Python {'.'.join(map(str, OLDEST))}, which students may have, "
                f"cannot read {source.splitlines()[line - 1].strip()}. Write this line as older Pythons "
                "read it"
            )
        path = PurePosixPath(*module.split("."))
        yield f"{path}.py", source.encode()
        for package in path.parents[:-2]:
            if not _has(".".join(package.parts)):
                yield f"{package}/__init__.py", b""  # it may import what holds answers


def _has(module: str) -> bool:
    """Whether the package has this module as it is, or another one in its place."""
    if not module.startswith("autograder."):
        return module == "autograder"
    path = module.removeprefix("autograder.").replace(".", "/")
    stands = (STAND_INS / f"{path}.py").is_file()
    return (
        stands
        or any(f"{path}/".startswith(f"{own}/") for own in WHOLE)
        or (f"{path}/__init__" in WHOLE)
    )
