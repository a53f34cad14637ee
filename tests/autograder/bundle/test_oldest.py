"""What a student with the oldest Python could not read is not handed out."""

import ast
import importlib.util
import sys
import zipfile

import pytest

from autograder.bundle.makers import Makers
from autograder.bundle.oldest import unreadable_line
from autograder.bundle.package import package
from autograder.bundle.shaking import Shaking, ShakingError
from autograder.problems import own_checks
from tests.autograder.authoring.my_cart import CART

NEW = [
    "x = 1\ny = f'{', '.join(names)}'",
    "x = 1\ny = f'{f\"{names['a']}\"}'",
    "x = 1\ny = f'{'a'}'",
    'x = 1\ny = f"{chr(10) + "\\n"}"',
    "x = 1\ny = f'{f\"{x}\\n\"}'",
    "x = 1\ny = f'{x\n}'",
    "x = 1\ny = f'''{x  # a comment\n}'''",
    "x = 1\ntype Y = int",
    "x = 1\ndef f[T](y): pass",
]
OLD = [
    "f'{\", \".join(names)} {x:>{width}}\\n{{}}'",
    "f'''{\n  'a'\n}'''",
    "f'{f\"{x}\"} it\\'s'",
    "f'{x!r:\\n}' '\\\\'",
]


@pytest.mark.skipif(sys.version_info < (3, 12), reason="only a newer Python reads them at all")
@pytest.mark.parametrize("source", NEW)
def test_what_it_cannot_read_is_found(source):
    ast.parse(source)
    assert unreadable_line(source) in (2, 3)


@pytest.mark.parametrize("source", OLD)
def test_what_it_reads_is_let_through(source):
    ast.parse(source)
    assert unreadable_line(source) is None


def test_each_file_of_an_archive_is_readable(installed):
    (wheel,) = installed.folder.glob("*.whl")
    with zipfile.ZipFile(wheel) as packed:
        names = [name for name in packed.namelist() if name.endswith(".py")]
        sources = {name: packed.read(name).decode() for name in names}
    sources["start.py"] = (installed.folder / "start.py").read_text()
    assert len(sources) > 200
    assert not {name: line for name, text in sources.items() if (line := unreadable_line(text))}


ASKED = """
def named(names):  # a comment: 42
    'A # is no comment here.'
    return f"{', '.join(names)} # nor here"


def around(words):
    def inner(x):
        # a comment: 42
        return f"{', '.join(words)}{x}"

    return inner, lambda x: (  # a comment: 42
        f"{', '.join(words)}, {x}"
    )
"""


@pytest.fixture
def asked(monkeypatch, tmp_path):
    """A module of these functions, under a name of the kit's."""
    (tmp_path / "asked.py").write_text(ASKED)
    spec = importlib.util.spec_from_file_location("autograder.asked", tmp_path / "asked.py")
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    return module


def test_what_is_taken_from_a_module_stands_there_word_for_word_but_for_comments(asked):
    """Python's own way back from a tree to a text writes f-strings that only new ones read."""
    makers, shaking = Makers(), Shaking(lambda module: True, lambda module: False)
    shaking.need(asked.__name__, "named")
    made = [makers.of(function) for function in asked.around(["a", "b"])]
    written = f"{shaking.source(asked.__name__)}\n\n{makers.written(asked.__name__)}"
    assert unreadable_line(written) is None
    assert "42" not in written
    namespace: dict = {}
    exec(written, namespace)
    assert namespace["named"](["a", "b"]) == "a, b # nor here"
    functions = [namespace[name.rpartition(":")[2]](*cells) for name, cells in made]
    assert [function("c") for function in functions] == ["a, bc", "a, b, c"]


@pytest.mark.skipif(sys.version_info < (3, 12), reason="only a newer Python reads it at all")
def test_a_courses_own_check_that_it_cannot_read_is_refused_by_its_line():
    new = "said = f'{', '.join(['small', 'large'])}'"
    text = CART.replace("    return (array(", f"    {new}\n    return (array(")
    files = {"checks/my-cart.py": text}
    own_checks.import_again(files)
    try:
        with pytest.raises(ShakingError) as refused:
            package(["p3_pendulum"], own_checks.read(text, "checks/my-cart.py").checks.values())
    finally:
        sys.modules.pop(f"{own_checks.PACKAGE}.my_cart")
    assert str(refused.value) == (
        f"checks/my-cart.py: Python 3.11, which students may have, cannot read {new}. "
        "Write this line as older Pythons read it"
    )
