"""What bubblewrap says where it does not work, and what to do about it there."""

import re

NOT_INSTALLED = "no program bwrap"

# bubblewrap's words, in its versions 0.4 to 0.12, and what helps. The kernel's reasons are few.
REMEDIES = {
    NOT_INSTALLED: "Install it; on Debian and Ubuntu: apt-get install bubblewrap.",
    "No permissions to creat": "No namespaces may be made here. Start a container of Docker's with "
    "--security-opt seccomp=unconfined. Without a container: sysctl "
    "kernel.unprivileged_userns_clone=1.",
    "Can't mount proc": "This container covers parts of /proc. Start it with --security-opt "
    "unmask=ALL (Podman) or --security-opt systempaths=unconfined (Docker).",
    "uid map|gid map|RTM_NEWADDR": "This machine forbids namespaces to ordinary programs, as Ubuntu "
    "does since 24.04, until its administrator allows /usr/bin/bwrap in AppArmor.",
    "Failed to make / slave|Can't mount|Failed to mount": "This container forbids mounts. Start a "
    "container of Docker's with --security-opt apparmor=unconfined --security-opt "
    "seccomp=unconfined, and one of Podman's with --security-opt label=disable.",
}
_OTHERWISE = "In a container, it needs flags."
PAGE = "docs/containers.md"


def remedy(said: str) -> str:
    """Sentences for who starts the grader. said: what bubblewrap wrote when it did not start."""
    for pattern, sentence in REMEDIES.items():
        if re.search(pattern, said):
            return f"{sentence} More is in {PAGE}."
    return f"{_OTHERWISE} They are in {PAGE}."
