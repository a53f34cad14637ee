"""What bubblewrap is asked for: which files, which user, which limits a room begins with."""

import logging
import os
import subprocess
import sys
import sysconfig
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from autograder import protocol
from autograder.sandbox.inside.namespaces import NOBODY, TMPFS_BYTES

log = logging.getLogger(__name__)

# Importing armdyn would load SciPy.
_armdyn = find_spec("armdyn")
assert _armdyn is not None
assert _armdyn.origin is not None
TOOLCHAIN = Path(_armdyn.origin).parent / "ports" / "toolchain"
HERE = Path(__file__).parent / "inside"
PROTOCOL = Path(protocol.__file__).parent
INSIDE = {
    **{path: path.name for path in HERE.glob("*.py") if path.name != "__init__.py"},
    **{path: path.name for path in (HERE / "stubs").glob("*.py")},
    **{path: f"protocol/{path.name}" for path in PROTOCOL.glob("*.py")},
    **{path: f"protocol/languages/{path.name}" for path in (PROTOCOL / "languages").glob("*.*")},
    **{path: f"toolchain/{path.name}" for path in TOOLCHAIN.glob("*.py")},
}
ENVIRONMENT = {
    "HOME": "/tmp",
    "IPYTHONDIR": "/tmp/.ipython",
    "LANG": "C.UTF-8",
    "MPLCONFIGDIR": "/tmp/.matplotlib",
    "OPENBLAS_NUM_THREADS": "1",
    "PATH": "/usr/bin:/bin",
    "PYTHONDONTWRITEBYTECODE": "1",
    "PYTHONHASHSEED": "0",
}


def bubblewrapped(script: str) -> tuple[list[str], dict[str, str]]:
    """The command that runs a script of INSIDE behind walls, and the environment to start it in."""
    command = ["bwrap", "--new-session", *_user(), "--dev", "/dev"]
    if script == "runner.py":
        # "Parent" is the thread. The warm process outlives it, and ends by its socket.
        command += ["--die-with-parent"]
    for folder in ("/tmp", "/dev/shm"):
        command += ["--perms", "1777", "--size", str(TMPFS_BYTES), "--tmpfs", folder]
    for folder in ("/usr", "/bin", "/lib", "/lib64"):
        if Path(folder).is_symlink():
            command += ["--symlink", os.readlink(folder), folder]
        elif Path(folder).exists():
            command += ["--ro-bind", folder, folder]
    for folder in python_folders():
        command += [*_parents(folder), "--ro-bind", folder, folder]
    for link, target in (python_links(sys.executable, python_folders()) | alternatives()).items():
        command += [*_parents(link), "--symlink", target, link]
    for path in java_settings():
        command += [*_parents(path), "--ro-bind", path, path]
    for folder in _installed_packages():
        command += ["--tmpfs", folder]
    for file, name in INSIDE.items():
        command += [*_parents(f"/room/{name}"), "--ro-bind", str(file), f"/room/{name}"]
    command += ["--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/tmp"]
    # The environment goes in through bwrap's own: what it is started with stays readable inside.
    return [*command, "--", sys.executable, "-I", "-u", f"/room/{script}", "walled"], ENVIRONMENT


def _user() -> list[str]:
    """New namespaces, and who the process is in them."""
    if _root_can_step_down():
        # The script itself becomes nobody: mapped to a user namespace, root stays root to the
        # kernel, which counts no processes of root's.
        kinds = ("pid", "net", "ipc", "uts", "cgroup-try")
        rights = ("CAP_SETUID", "CAP_SETGID", "CAP_SYS_ADMIN", "CAP_SETPCAP")
        return [
            *(f"--unshare-{kind}" for kind in kinds),
            *(word for right in rights for word in ("--cap-add", right)),
            *("--dir", "/proc"),
        ]
    nobody = str(NOBODY)
    return ["--unshare-all", "--uid", nobody, "--gid", nobody, "--proc", "/proc"]


def _parents(folder: str) -> list[str]:
    """Folders that others than root may enter too: bubblewrap makes those it needs for root alone."""
    parents = [str(parent) for parent in reversed(Path(folder).parents)][1:]
    return [word for parent in parents for word in ("--perms", "0755", "--dir", parent)]


@cache
def _root_can_step_down() -> bool:
    """Whether this is a root with all rights, and a Python that others may run too."""
    if os.geteuid() != 0:
        return False
    for folder in python_folders():
        if os.stat(folder).st_mode & 0o005 != 0o005:
            log.warning(
                "%s is readable by root alone: student code runs as root's, whose processes the "
                "kernel does NOT limit; a room that has too many ends a moment later. Grade as an "
                "ordinary user, or chmod -R o+rX it",
                folder,
            )
            return False
    return _runs("--unshare-pid", "--cap-add", "CAP_SYS_ADMIN")


@cache
def has_bubblewrap() -> bool:
    """Whether bubblewrap is here and works; a warning once where not."""
    if _runs("--unshare-all"):
        return True
    log.warning(
        "bubblewrap does not work here: student code runs with limits on time, memory, files and "
        "the number of processes, but is NOT shut off from files and network, nor from your other "
        "processes. On Debian: apt-get install bubblewrap"
    )
    return False


def _runs(*options: str) -> bool:
    command = ["bwrap", *options, "--ro-bind", "/", "/", "true"]
    try:
        return subprocess.run(command, capture_output=True, timeout=10).returncode == 0
    except (OSError, subprocess.SubprocessError):
        return False


def python_folders() -> list[str]:
    """Where this Python and its packages are, outermost first; folders under /usr come with it."""
    folders = {sys.prefix, sys.base_prefix, str(Path(sys.executable).resolve().parent.parent)}
    folders |= {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    kept: list[str] = []
    for folder in sorted(folders, key=len):
        if not any(Path(folder).is_relative_to(outer) for outer in ["/usr", *kept]):
            kept.append(folder)
    return kept


def python_links(executable: str, bound: list[str]) -> dict[str, str]:
    """Links on the way from an environment's Python to the real one, and where they point.

    Such as one in somebody's own folder of programs; those in `bound` folders and in /usr come along.
    """
    links, path = {}, Path(executable)
    while path.is_symlink():
        target = path.parent / path.readlink()
        if not any(path.is_relative_to(folder) for folder in ["/usr", "/bin", *bound]):
            links[str(path)] = str(target)
        path = Path(os.path.normpath(target))
    return links


# What Debian's compilers and Octave go through /etc for: two programs, and two libraries.
CHOSEN = ("java", "javac", "libblas.so.3", "liblapack.so.3")
# What a Java machine does not start without, where Debian keeps it in /etc.
JAVA_READS = ("conf/security/java.security", "lib/jvm.cfg")


def alternatives() -> dict[str, str]:
    """Links of /etc/alternatives that a room needs, and where they point; all of it is in /usr."""
    links = sorted(Path("/etc/alternatives").glob("*"))
    chosen = [link for link in links if link.name.partition("-")[0] in CHOSEN]  # …-x86_64-linux-gnu
    targets = {str(link): os.readlink(link) for link in chosen if link.is_symlink()}
    return {link: target for link, target in targets.items() if target.startswith("/usr/")}


def java_settings() -> list[str]:
    """Files in /etc that are part of the Java of /usr/bin: readable by all, and the same anywhere."""
    home = Path("/usr/bin/javac").resolve().parents[1]
    files = {(home / name).resolve() for name in JAVA_READS}
    return sorted(str(file) for file in files if file.is_file() and file.is_relative_to("/etc"))


def _installed_packages() -> list[str]:
    """This project's packages where they are copied into the environment: to be covered."""
    site = Path(sysconfig.get_path("purelib"))
    return [str(site / name) for name in ("armdyn", "autograder") if (site / name).exists()]
