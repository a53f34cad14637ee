"""What stands for the course's packages in the sandbox has all that a notebook may call."""

import ast
from pathlib import Path

import autograder
from autograder.sandbox import inside

STUB = Path(inside.__file__).parent / "stubs" / "autograder.py"


def functions() -> dict[str, ast.FunctionDef]:
    """The functions of the stub, by name."""
    body = ast.parse(STUB.read_text(encoding="utf-8")).body
    return {node.name: node for node in body if isinstance(node, ast.FunctionDef)}


def test_the_stub_has_every_public_name():
    assert set(autograder.__all__) <= set(functions())


def test_a_call_without_arguments_is_taken_where_the_real_one_takes_it():
    for name in ("check", "hint", "solution"):
        arguments = functions()[name].args
        assert len(arguments.defaults) == len(arguments.args), name
