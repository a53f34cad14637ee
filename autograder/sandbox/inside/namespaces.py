"""Sets up Linux namespaces, mounts and privileges; Python 3.11 has no `os.unshare`."""

import ctypes
import os
import platform
import signal
from contextlib import suppress

NOBODY = 65534
TMPFS_BYTES = 64 << 20
MOST_FILES = 20_000

CLONE_NEWUSER = 0x10000000
CLONE_NEWPID = 0x20000000
# Mounts, cgroups, host name, IPC, users, processes, network.
EVERY_KIND = (
    0x00020000 | 0x02000000 | 0x04000000 | 0x08000000 | CLONE_NEWUSER | CLONE_NEWPID | 0x40000000
)
MS_NOSUID, MS_NODEV, MS_NOEXEC, MS_BIND, MS_REC, MS_PRIVATE = 2, 4, 8, 1 << 12, 1 << 14, 1 << 18
PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_CAPBSET_DROP, PR_SET_NO_NEW_PRIVS = 1, 4, 24, 38
PR_SET_CHILD_SUBREAPER = 36
CAPABILITY_VERSION = 0x20080522
CLONE = {"x86_64": 56, "aarch64": 220}
KEYCTL = {"x86_64": 250, "aarch64": 219}
KEYCTL_JOIN_SESSION_KEYRING = 1

_libc = ctypes.CDLL(None, use_errno=True)
_pythons = ctypes.PyDLL(None, use_errno=True)  # keeps the interpreter's lock, which a fork needs
_libc.mount.argtypes = [ctypes.c_char_p] * 3 + [ctypes.c_ulong, ctypes.c_char_p]
_libc.prctl.argtypes = [ctypes.c_int] + [ctypes.c_ulong] * 4


def become_nobody() -> None:
    """Go from root inside bubblewrap to a user without rights, whose processes the kernel limits."""
    step_down()
    # In a new namespace, this user's other processes do not count. Some kernels allow only root to
    # make one; then all rooms share the limit.
    with suppress(OSError):
        unshare(CLONE_NEWUSER)
    drop_privileges()


def step_down() -> None:
    """Go from root inside bubblewrap to another user, with a /proc.

    bubblewrap gives root the capabilities for these steps alone. bubblewrap's own /proc would be partly
    covered, and then the kernel would let no room mount one.
    """
    if os.path.exists("/proc/self"):
        raise RuntimeError("this process is not in a room: it has a /proc already")
    mount_proc()
    os.setgroups([])
    os.setresgid(NOBODY, NOBODY, NOBODY)
    os.setresuid(NOBODY, NOBODY, NOBODY)
    # A change of user makes a process's own /proc files root's.
    _libc.prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)


def clone(kinds: int) -> int:
    """A fork in new namespaces, one of users among them; the process, and 0 in the fork.

    For a fork that starts nothing: neither Python nor the C library knows of it.
    """
    return _checked(
        "clone", _pythons.syscall(CLONE[platform.machine()], kinds | signal.SIGCHLD, *[0] * 4)
    )


def enter(process: int, kinds: int) -> None:
    """Enter the namespaces of the process behind a pidfd; one of processes counts for the next fork."""
    _checked("setns", _libc.setns(process, kinds))


def unshare(kinds: int) -> None:
    """Enter new namespaces, one of users among them, as the same user."""
    user, group = os.getuid(), os.getgid()
    _checked("unshare", _libc.unshare(kinds))
    map_user(user, group)


def map_user(user: int, group: int) -> None:
    """Be the same user in a new namespace of users as outside it."""
    _write("/proc/self/setgroups", "deny")
    _write("/proc/self/uid_map", f"{user} {user} 1")
    _write("/proc/self/gid_map", f"{group} {group} 1")


def furnish() -> None:
    """Give process 1 of new namespaces its own /proc, /tmp and terminals."""
    _mount(None, "/", None, MS_REC | MS_PRIVATE)
    mount_proc()
    covered = {place: os.open(place, os.O_PATH) for place in _mounted_under("/tmp")}
    for folder in ("/tmp", "/dev/shm"):
        size = f"mode=0755,size={TMPFS_BYTES},nr_inodes={MOST_FILES}"
        _mount("tmpfs", folder, "tmpfs", MS_NOSUID | MS_NODEV, size)
    for place, descriptor in covered.items():
        os.makedirs(place)
        _mount(f"/proc/self/fd/{descriptor}", place, None, MS_BIND | MS_REC)
        os.close(descriptor)
    options = "newinstance,ptmxmode=0666,mode=0620"
    _mount("devpts", "/dev/pts", "devpts", MS_NOSUID | MS_NOEXEC, options)
    # No further namespaces: inside one of its own, a process would have all capabilities.
    _write("/proc/sys/user/max_user_namespaces", "0")


def new_keys() -> None:
    """Make a keyring that only this process and those it starts can use."""
    if platform.machine() in KEYCTL:
        # Where the kernel has no keys there are none to share.
        _libc.syscall(KEYCTL[platform.machine()], KEYCTL_JOIN_SESSION_KEYRING, None)


def _mounted_under(folder):
    """The outermost mounts in the folder, such as a Python that is installed in /tmp."""
    with open("/proc/self/mountinfo") as file:
        places = [line.split()[4] for line in file]
    places = [place.encode().decode("unicode_escape") for place in places]
    outermost: list[str] = []
    for place in sorted(places, key=len):
        if place.startswith(folder + "/") and not any(
            place.startswith(outer + "/") or place == outer for outer in outermost
        ):
            outermost.append(place)
    return outermost


def mount_proc() -> None:
    _mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC)


def drop_privileges() -> None:
    """Give up all capabilities, for this process and all it starts."""
    _checked("prctl", _libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
    capability = 0
    while _libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0) == 0:
        capability += 1
    header = (ctypes.c_uint32 * 2)(CAPABILITY_VERSION, 0)
    _checked("capset", _libc.capset(header, (ctypes.c_uint32 * 6)()))


def close_to_tracing() -> None:
    """Let no process of the same user read or trace this one."""
    _libc.prctl(PR_SET_DUMPABLE, 0, 0, 0, 0)


def adopt_orphans() -> None:
    """Become the parent of every descendant whose own parent ends."""
    _checked("prctl", _libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0))


def end_with_parent() -> None:
    """Be killed when the parent ends."""
    _checked("prctl", _libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0))


def _mount(source, target, kind, flags, options=None):
    parts = [part.encode() if part else None for part in (source, target, kind)]
    result = _libc.mount(*parts, flags, options.encode() if options else None)
    _checked(f"mount {target}", result)


def _write(path, text):
    descriptor = os.open(path, os.O_WRONLY)
    try:
        os.write(descriptor, text.encode())
    finally:
        os.close(descriptor)


def _checked(what, result):
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")
    return result
