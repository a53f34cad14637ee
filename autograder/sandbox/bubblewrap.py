"""Builds the command that starts a room in bubblewrap: its files, its user, its first limits."""

import logging
import os
import subprocess
import sys
import sysconfig
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from autograder import protocol
from autograder.sandbox import refusal
from autograder.sandbox.inside.namespaces import NOBODY, TMPFS_BYTES

log = logging.getLogger(__name__)

# Importing armdyn would load SciPy.
_armdyn = find_spec("armdyn")
assert _armdyn is not None
assert _armdyn.origin is not None
TOOLCHAIN = Path(_armdyn.origin).parent / "ports" / "toolchain"
UID_MAP = Path("/proc/self/uid_map")
HERE = Path(__file__).parent / "inside"
PROTOCOL = Path(protocol.__file__).parent
INSIDE = {
    **{path: path.name for path in HERE.glob("*.py") if path.name != "__init__.py"},
    **{path: path.name for path in (HERE / "stubs").glob("*.py")},
    **{path: f"protocol/{path.name}" for path in PROTOCOL.glob("*.py")},
    **{path: f"protocol/languages/{path.name}" for path in (PROTOCOL / "languages").glob("*.*")},
    **{path: f"protocol/riddles/{path.name}" for path in (PROTOCOL / "riddles").glob("*.py")},
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
        # "Parent" means the thread that started it; the warm process must live longer than that.
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
    for path in [*java_settings(), *loaders_list()]:
        command += [*_parents(path), "--ro-bind", path, path]
    for folder in _installed_packages():
        command += ["--tmpfs", folder]
    for file, name in INSIDE.items():
        command += [*_parents(f"/room/{name}"), "--ro-bind", str(file), f"/room/{name}"]
    command += ["--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/tmp"]
    # bwrap gets only this environment, as everything in its own stays readable inside.
    return [*command, "--", sys.executable, "-I", "-u", f"/room/{script}", "walled"], ENVIRONMENT


def _user() -> list[str]:
    """Options for new namespaces, and for the user in them."""
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
    """Options for parent folders that every user may enter; bubblewrap makes its own for root alone."""
    parents = [str(parent) for parent in reversed(Path(folder).parents)][1:]
    return [word for parent in parents for word in ("--perms", "0755", "--dir", parent)]


@cache
def _root_can_step_down() -> bool:
    """Whether this user is root with all rights, and other users may run this Python."""
    if os.geteuid() != 0:
        return False
    for folder in python_folders():
        if os.stat(folder).st_mode & 0o005 != 0o005:
            log.warning(
                "only root can read %s, so student code runs as root, and the kernel does NOT limit "
                "the number of root's processes; a sandbox with too many is ended a moment later. "
                "Grade as an ordinary user, or run chmod -R o+rX on that folder",
                folder,
            )
            return False
    if _refused("--unshare-pid", "--cap-add", "CAP_SYS_ADMIN") is None:
        return True
    if _is_root_of_the_machine():
        log.warning(
            "root lacks CAP_SYS_ADMIN here, so student code runs as root, and the kernel does NOT "
            "limit the number of root's processes; a sandbox with too many is ended a moment later. "
            "Start the container as another user: leave out --user 0"
        )
    return False


def _is_root_of_the_machine() -> bool:
    """Whether this root is the kernel's too, and not somebody else's number in a user namespace."""
    try:
        inside, outside, _ = UID_MAP.read_text().splitlines()[0].split()
    except (OSError, IndexError, ValueError):
        return False
    return inside == outside == "0"


@cache
def has_bubblewrap() -> bool:
    """Whether bubblewrap is here and works; if not, one warning says why, and what to do."""
    # A container may allow the namespaces, and yet no /proc of one's own, which root can do without.
    said = _refused("--unshare-all", "--proc", "/proc")
    if said is None or (_refused("--unshare-all") is None and _root_can_step_down()):
        return True
    log.warning(
        "bubblewrap does not work here (%s): student code runs with limits on time, memory, files "
        "and the number of processes, but is NOT shut off from your files, the network and your "
        "other processes. %s",
        said,
        refusal.remedy(said),
    )
    return False


def _refused(*options: str) -> str | None:
    """None if bubblewrap starts with these options; otherwise what it said, on one line."""
    command = ["bwrap", *options, "--ro-bind", "/", "/", "true"]
    try:
        ran = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=60)
    except FileNotFoundError:
        return refusal.NOT_INSTALLED
    except (OSError, subprocess.SubprocessError) as error:
        return str(error)
    said = " ".join(ran.stderr.split()) or f"it ended with status {ran.returncode}"
    return None if ran.returncode == 0 else said


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
    """Links that lead from an environment's Python to the real one, and where they point.

    Links in `bound` folders and in /usr are left out, as the room has these folders.
    """
    links, path = {}, Path(executable)
    while path.is_symlink():
        target = path.parent / path.readlink()
        if not any(path.is_relative_to(folder) for folder in ["/usr", "/bin", *bound]):
            links[str(path)] = str(target)
        path = Path(os.path.normpath(target))
    return links


# Debian's compilers and Octave find these through /etc: two programs, and two libraries.
CHOSEN = ("java", "javac", "libblas.so.3", "liblapack.so.3")
# A Java machine does not start without these files, which Debian keeps in /etc.
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


def loaders_list() -> list[str]:
    """Where the loader looks up libraries, such as that of a Python in /usr/local."""
    return [path for path in ["/etc/ld.so.cache"] if os.path.exists(path)]


def _installed_packages() -> list[str]:
    """This project's packages, if they are copied into the environment; the room must not see them."""
    site = Path(sysconfig.get_path("purelib"))
    return [str(site / name) for name in ("armdyn", "autograder") if (site / name).exists()]
