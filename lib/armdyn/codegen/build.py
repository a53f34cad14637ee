"""Compiles C source to a Python module, once: the result is kept under its contents' hash."""

import hashlib
import importlib.util
import os
import platform
import shutil
import sys
import sysconfig
import tempfile
from pathlib import Path

FLAGS = {
    "nt": (("/O2", "/fp:precise"),),
    # Value-safe flags only: what they give up is errno and trapping on inexact results. The second
    # set is for compilers that know no "native" processor.
    "posix": (
        ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math"),
        ("-O3", "-fno-math-errno"),
    ),
}
MODULE = "armdyn_compiled"


class NoCompilerError(RuntimeError):
    """There is no C compiler that makes Python modules; the message says what to install."""

    def __init__(self, reason: str):
        super().__init__(
            f"No working C compiler: {reason}. Debian or Ubuntu: apt install gcc python3-dev. "
            "macOS: xcode-select --install. Windows: the Visual Studio Build Tools, with 'Desktop "
            "development with C++'. Without one, armdyn.codegen.numpy_model gives the same model "
            "in NumPy, and armdyn.codegen.fastest_model chooses for you."
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


def compiled(declarations: str, source: str):
    """The module (`ffi`, `lib`) of this C source, compiled now or taken from the cache.

    Raises NoCompilerError if it has to be compiled and cannot be.
    """
    key = hashlib.sha256(repr((declarations, source, FLAGS, _machine())).encode()).hexdigest()[:32]
    name = f"{MODULE}_{key}"
    if name in sys.modules:
        return sys.modules[name]
    path = cache_folder() / f"{name}{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not path.is_file():
        _compile(name, declarations, source, path)
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    sys.modules[name] = module
    return module


def _compile(name, declarations, source, path):
    if os.name == "posix":
        command = os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc"
        if shutil.which(command.split()[0]) is None:
            raise NoCompilerError(f"{command.split()[0]} was not found")
    # Only here: setuptools takes longer to import than a cached module to load.
    from cffi import FFI

    path.parent.mkdir(parents=True, exist_ok=True)
    problem = None
    for flags in FLAGS[os.name]:
        builder = FFI()
        builder.cdef(declarations)
        builder.set_source(name, source, extra_compile_args=list(flags))
        with tempfile.TemporaryDirectory(dir=path.parent) as folder:
            try:
                made = builder.compile(tmpdir=folder)
            except Exception as error:  # setuptools and cffi raise half a dozen kinds
                problem = error
                continue
            # Renamed into place: another process never sees half a file.
            os.replace(made, path)
            return
    raise NoCompilerError(f"{type(problem).__name__}: {problem}") from problem


def _machine():
    """What -march=native depends on: a home folder may be shared by unlike machines."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    kinds = ("model name", "flags", "Features", "CPU part")
    processor = sorted({line for line in lines if line.startswith(kinds)})
    return (sys.version, platform.platform(), processor or platform.processor())
