"""Compiles the C source of a Python module once, and keeps the result under the source's hash."""

import atexit
import hashlib
import importlib.util
import os
import platform
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np

from armdyn.codegen import vector_width

FLAGS = {
    "nt": (("/O2", "/fp:precise"),),
    # Value-safe flags only: what they give up is errno and trapping on inexact results. The second
    # set is for compilers that know no "native" processor.
    "posix": (
        (
            "-O3",
            "-march=native",
            "-fno-math-errno",
            "-fno-trapping-math",
            "-fno-tree-slp-vectorize",
        ),
        ("-O3", "-fno-math-errno"),
    ),
}
MODULE = "armdyn_compiled"
_loaded: dict[str, ModuleType] = {}


class NoCompilerError(RuntimeError):
    """There is no C compiler that makes Python modules; the message says what to install."""

    def __init__(self, reason: str):
        install = (
            "Debian or Ubuntu: apt install gcc python3-dev. macOS: xcode-select --install. Windows: the "
            "Visual Studio Build Tools, with 'Desktop development with C++'."
        )
        if sys.platform == "emscripten":
            install = "A browser has none: for compiled C, the course must be on your computer."
        super().__init__(
            f"No working C compiler: {reason}. {install} Without one, "
            "armdyn.codegen.numpy_model gives the same model in NumPy, and armdyn.codegen.fastest_model "
            "chooses for you."
        )


def cache_folder() -> Path:
    """Where compiled modules are kept: $ARMDYN_CACHE, or a folder of the user's own cache."""
    if chosen := os.environ.get("ARMDYN_CACHE"):
        return Path(chosen)
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "armdyn"


def compiled(source: str):
    """The Python module armdyn_compiled from this C source, compiled now or taken from the cache.

    Where nobody may write to the cache, the module serves this process only. Raises NoCompilerError
    if it has to be compiled and cannot be.
    """
    key = hashlib.sha256(repr((source, FLAGS, _machine())).encode()).hexdigest()[:32]
    if key not in _loaded:
        path = cache_folder() / key / f"{MODULE}{sysconfig.get_config_var('EXT_SUFFIX')}"
        if not os.path.isfile(path):  # unlike Path's, silent where nobody may look
            path = _compile(source, path)
        spec = importlib.util.spec_from_file_location(MODULE, path)
        if spec is None or spec.loader is None:
            raise ImportError(f"{path}: is no module that this Python can load")
        _loaded[key] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(_loaded[key])
    return _loaded[key]


def _compile(source, path):
    """Where the compiled module is: at `path`, or in a folder of this process if that is barred."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=path.parent).close()
    except OSError:
        path = _own_folder() / path.parent.name / path.name
        path.parent.mkdir(parents=True, exist_ok=True)
    build = _with_setuptools if os.name == "nt" else shared_library
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        file = Path(folder) / f"{MODULE}.c"
        file.write_text(source, encoding="utf-8")
        for flags in FLAGS[os.name][:-1]:
            try:
                made = build(file, (*flags, *_width(flags)))
                break
            except NoCompilerError:
                continue
        else:
            made = build(file, FLAGS[os.name][-1])
        # Renamed into place: another process never sees half a file.
        os.replace(made, path)
    return path


@cache
def _own_folder():
    """A folder for this process."""
    folder = tempfile.mkdtemp(prefix="armdyn-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)


def _width(flags):
    return vector_width.flags(compiler(), shared_library, flags, cache_folder(), _machine())


def compiler() -> list[str]:
    """The C compiler's command, $CC if that is set."""
    return (os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc").split()


def shared_library(file: Path, flags: tuple[str, ...]) -> Path:
    """The shared library of the C file, by the compiler's command; `NoCompilerError` if it fails."""
    command = compiler()
    if shutil.which(command[0]) is None:
        raise NoCompilerError(f"{command[0]} was not found")
    made = file.with_suffix(".so")
    shared = (
        ("-bundle", "-undefined", "dynamic_lookup") if sys.platform == "darwin" else ("-shared",)
    )
    folders = [f"-I{folder}" for folder in _include_folders()]
    done = subprocess.run(
        [*command, *flags, "-fPIC", *shared, *folders, str(file), "-o", str(made), "-lm"],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        complaint = (done.stderr.strip() or f"exit status {done.returncode}").splitlines()
        told = next((line for line in complaint if "error" in line), complaint[0])
        raise NoCompilerError(f"{command[0]} failed with '{told}'")
    return made


def _with_setuptools(file, flags):
    """The same with setuptools, which finds Microsoft's compiler."""
    try:
        from setuptools import Distribution, Extension

        extension = Extension(
            MODULE, [str(file)], include_dirs=_include_folders(), extra_compile_args=list(flags)
        )
        build = Distribution({"ext_modules": [extension]}).get_command_obj("build_ext")
        build.build_lib = build.build_temp = str(file.parent)
        build.ensure_finalized()
        build.run()
    except Exception as error:  # a dozen kinds, from ImportError to the compiler's own
        raise NoCompilerError(f"{type(error).__name__}: {error}") from error
    return build.get_ext_fullpath(MODULE)


def _include_folders():
    return [sysconfig.get_path("include"), np.get_include()]


def _machine():
    """What -march=native depends on, as different machines may share a home folder."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    kinds = ("model name", "flags", "Features", "CPU part")
    processor = sorted({line for line in lines if line.startswith(kinds)})
    return (sys.version, np.__version__, platform.platform(), processor or platform.processor())
