"""Programs that answer, crash, hang and babble; compilers that complain; tools that are missing."""

import ast
import contextlib
import os
import re
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from armdyn.ports import toolchain
from armdyn.ports.toolchain import (
    TOOLCHAINS,
    BuildError,
    Conversation,
    MissingToolError,
    ProgramError,
    build,
    missing,
)
from tests.autograder.eventually import eventually

TWICE = """
import os, struct, sys
def numbers(count):
    data = sys.stdin.buffer.read(8 * count)
    if len(data) < 8 * count:
        sys.exit()
    return struct.unpack(f"<{count}d", data)
def answer(numbers):
    sys.stdout.buffer.write(b"numbers:" + struct.pack(f"<{len(numbers) + 1}d", len(numbers), *numbers))
    sys.stdout.buffer.flush()
def request():
    return numbers(int(numbers(1)[0]))
"""


def python(script):
    return [sys.executable, "-c", TWICE + script]


def conversation(script, seconds=20.0):
    return Conversation(python(script), seconds=seconds)


def test_numbers_arrive_as_they_were():
    sent = np.array([0.1, -0.0, np.nextafter(1, 2), 5e-324, 1.7e308, np.inf, np.nan, 1 / 3])
    with conversation("while True: answer(request())") as program:
        for part in (sent, sent[:1], sent[:0], np.arange(100_000) / 7):
            found = program.ask(part, at_most=part.size)
            assert found.tobytes() == part.tobytes()


def test_what_a_program_prints_is_no_answer():
    script = """
while True:
    print("q is", request(), flush=True)
    print("numbers", end="", flush=True)
    answer([1, 2])
"""
    with conversation(script) as program:
        for _ in range(2):
            assert program.ask([3], at_most=2).tolist() == [1, 2]
        assert program.text() == "q is (3.0,)\nnumbersq is (3.0,)\nnumbers"


def test_a_little_text_before_each_answer_is_never_too_much():
    script = """
while True:
    print("a word" * 50_000, flush=True)
    answer(request())
"""
    with conversation(script) as program:
        for _ in range(5):
            assert program.ask([1.0], at_most=1) == [1.0]


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("request(); print('no idea', file=sys.stderr); sys.exit(3)", "exit status 3: no idea"),
        ("request(); print('so'); sys.exit(0)", "the program ended with exit status 0: so"),
        ("request(); raise OverflowError('too fast')", "exit status 1: (.|\n)*too fast"),
        ("sys.exit(4)", "exit status 4"),
        ("request(); os.kill(os.getpid(), 11)", "ended with SIGSEGV"),
        ("request(); print('abc' * 10**6, flush=True)", "wrote text instead of an answer: ….*abc"),
        ("request(); answer([1, 2, 3])", "gave 3 numbers; at most 2"),
        ("request(); os.write(1, b'numbers:' + struct.pack('<d', -1))", "gave -1 numbers"),
        ("request(); os.write(1, b'numbers:' + struct.pack('<d', 1.5))", "gave 1.5 numbers"),
        ("request(); os.write(1, b'numbers:not a d')", "exit status 0"),
        ("request(); os.write(1, b'numbers:' + struct.pack('<2d', 2, 7))", "exit status 0"),
    ],
)
def test_a_program_that_fails_says_how(script, message):
    with conversation(script) as program:
        with pytest.raises(ProgramError, match=message):
            program.ask([1.0] * 100_000, at_most=2)
        with pytest.raises(ProgramError, match="the program has ended"):
            program.ask([1.0], at_most=2)


@contextlib.contextmanager
def under_way(script):
    """A program that has started, and has two seconds for each answer."""
    with conversation(f"print('here', file=sys.stderr, flush=True); {script}", 2) as program:
        assert eventually(lambda: "here" in program.text())
        yield program


@pytest.mark.parametrize(
    "script",
    [
        "request(); print('thinking', file=sys.stderr, flush=True)\nwhile True: pass",
        "print('thinking', file=sys.stderr, flush=True)\nimport time; time.sleep(1000)",
        "request(); print('thinking', flush=True); os.write(1, b'numbers:\\0'); request()",
    ],
)
def test_a_program_that_hangs_is_ended(script):
    with (
        under_way(script) as program,
        pytest.raises(ProgramError, match=r"no answer within 2 s: (here\n)?thinking"),
    ):
        program.ask([1.0] * 100_000, at_most=2)


def ended(pid):
    """Whether the process is gone, or a zombie that nobody has waited for."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    return True


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc to see processes")
@pytest.mark.parametrize("hangs", [False, True])
def test_what_a_program_started_ends_with_it(hangs):
    # The second process holds the pipe open.
    script = "request(); child = os.fork(); child or __import__('time').sleep(1000);"
    script += "answer([child]); request()" if not hangs else "print(child, flush=True)"
    with under_way(script) as program:
        if hangs:
            with pytest.raises(ProgramError, match="no answer"):
                program.ask([], at_most=1)
            pid = int(program.text().split()[0])
        else:
            (pid,) = program.ask([], at_most=1).astype(int)
            assert not ended(pid)
    assert eventually(lambda: ended(pid))


def test_a_program_that_cannot_start(tmp_path):
    with pytest.raises(ProgramError, match=r"does not start: .*nothing"):
        Conversation([tmp_path / "nothing"])


def test_a_program_starts_where_and_with_what_it_is_told(tmp_path):
    script = "request(); answer([os.environ['N'] == '7', os.getcwd() == os.path.realpath('.')])"
    script += f"; request(); answer([os.path.samefile('.', {str(tmp_path)!r})])"
    environment = {**os.environ, "N": "7"}
    with Conversation(python(script), tmp_path, environment=environment) as program:
        assert program.ask([], at_most=2).tolist() == [1, 1]
        assert program.ask([], at_most=1).tolist() == [1]


def test_an_interrupted_question_ends_the_program(monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    with conversation("while True: answer(request())") as program:
        monkeypatch.setattr(program, "_answer", interrupt)
        with pytest.raises(KeyboardInterrupt):
            program.ask([1.0], at_most=1)
        monkeypatch.undo()
        with pytest.raises(ProgramError, match="has ended"):
            program.ask([2.0], at_most=1)


COMPILER = """
made = open("a/in").read() * 2
open("made", "x").write(made)
open("../../../runs", "a").write(".")
print("hm")
"""
COUNTING = [sys.executable, "-c", COMPILER]


def test_built_once(tmp_path):
    folder = build({"a/in": "é"}, COUNTING, tmp_path / "new" / "cache")
    assert (folder / "made").read_text(encoding="utf-8") == "éé"
    assert (folder / "compiler.txt").read_text(encoding="utf-8") == "hm"
    (folder / "made").write_text("kept", encoding="utf-8")
    assert build({"a/in": "é"}, COUNTING, folder.parent) == folder
    assert (folder / "made").read_text(encoding="utf-8") == "kept"
    assert (tmp_path / "new" / "runs").read_text(encoding="utf-8") == "."
    other = [
        build({"a/in": "e"}, COUNTING, folder.parent),
        build({"a/in": "é", "b": ""}, COUNTING, folder.parent),
        build({"a/in": "é"}, [*COUNTING, "-O2"], folder.parent),
        build({"a/in": "é"}, [], folder.parent),
    ]
    assert len({folder, *other}) == 5
    assert not (other[-1] / "made").exists()
    assert len(list(folder.parent.iterdir())) == 5


def test_built_by_two_at_once(tmp_path):
    together, folders = threading.Barrier(4), []

    def one():
        together.wait()
        folders.append(build({"a/in": "x"}, COUNTING, tmp_path / "cache"))

    threads = [threading.Thread(target=one) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(folders) == 4
    assert list((tmp_path / "cache").iterdir()) == [folders[0]]


@pytest.mark.parametrize(
    ("script", "message"),
    [
        (
            "import os; raise SystemExit(f'{os.getcwd()}{os.sep}a.c:3: error: no')",
            r"\Aa\.c:3: error: no\Z",
        ),
        ("print('on stdout'); raise SystemExit(2)", r"\Aon stdout\Z"),
        ("raise SystemExit(2)", r"python.* ended with exit status 2\Z"),
        ("raise SystemExit('x' * 10**5)", r"\Ax{4000}\n…\Z"),
        ("import time; time.sleep(1000)", r"python.* took more than 1 s\Z"),
    ],
)
def test_a_compiler_that_fails_is_heard(tmp_path, script, message):
    seconds = 1 if "sleep" in script else 60
    with pytest.raises(BuildError, match=message):
        build({"a.cpp": ""}, [sys.executable, "-c", script], tmp_path, seconds)
    assert list(tmp_path.iterdir()) == []


BROKEN = {
    "cpp": ({"driver.cpp": "int main() {\n  return missing;\n}\n"}, r"driver\.cpp:2:\d+: error: "),
    "java": ({"Driver.java": "class Driver {\n  int n = missing;\n}\n"}, r"\ADriver\.java:2: error: "),
}  # fmt: skip
PACKAGES = {"cpp": ("g++", "libeigen3-dev"), "java": ("default-jdk-headless", "libejml-java")}


@pytest.mark.parametrize("language", BROKEN)
def test_the_compilers_own_message(tmp_path, needs, language):
    for package in PACKAGES[language]:
        needs(package)
    files, message = BROKEN[language]
    with pytest.raises(BuildError, match=message) as error:
        build(files, TOOLCHAINS[language]().compile, tmp_path)
    assert "missing" in str(error.value)
    assert str(tmp_path) not in str(error.value)


@pytest.mark.parametrize("language", TOOLCHAINS)
def test_a_missing_tool_is_one_line(monkeypatch, language):
    for variable in ("CXX", "ARMDYN_EIGEN", "ARMDYN_EJML"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("PATH", "")
    line = missing(TOOLCHAINS[language])
    assert "was not found" in line
    assert re.search(r"Debian or Ubuntu: apt install [\w+-]+\. macOS: .+ Windows: .+\.$", line)
    assert "\n" not in line
    with pytest.raises(MissingToolError, match=re.escape(line)):
        TOOLCHAINS[language]()


@pytest.mark.parametrize(
    ("language", "variable", "package"),
    [("cpp", "ARMDYN_EIGEN", "libeigen3-dev"), ("java", "ARMDYN_EJML", "libejml-java")],
)
def test_a_library_is_where_the_user_says(
    tmp_path, monkeypatch, needs, language, variable, package
):
    for name in PACKAGES[language]:
        needs(name)
    monkeypatch.setenv(variable, str(tmp_path))
    line = missing(TOOLCHAINS[language])
    assert f"(${variable} = {tmp_path})" in line
    assert f"apt install {package}." in line
    assert f"Or set {variable} to the folder with " in line
    assert "\n" not in line
    (tmp_path / "Eigen").mkdir()
    (tmp_path / "Eigen" / "Dense").touch()
    (tmp_path / "ejml-simple-1.jar").touch()
    assert missing(TOOLCHAINS[language]) is None
    assert any(str(tmp_path) in part for part in TOOLCHAINS[language]().compile)


def test_the_compiler_is_the_one_that_the_user_says(monkeypatch, needs):
    needs("libeigen3-dev")
    monkeypatch.setenv("CXX", sys.executable)
    assert TOOLCHAINS["cpp"]().compile[0] == sys.executable
    monkeypatch.setenv("CXX", "no-such-compiler")
    assert "C++ compiler was not found (no-such-compiler)" in missing(TOOLCHAINS["cpp"])


def test_the_folder_stands_alone():
    """It goes into the room under another name, where armdyn is not."""
    for path in Path(toolchain.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                continue
            names = (
                [a.name for a in getattr(node, "names", [])] if isinstance(node, ast.Import) else []
            )
            names += [node.module] if isinstance(node, ast.ImportFrom) else []
            for name in names:
                assert name.partition(".")[0] in {"numpy", *sys.stdlib_module_names}, path
