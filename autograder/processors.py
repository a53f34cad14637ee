"""How many processors this process may use: as its affinity, and its container's share, have it."""

import math
import os
from pathlib import Path

CGROUPS = Path("/sys/fs/cgroup")
OF_PROCESS = Path("/proc/self/cgroup")


def usable() -> int:
    """At least 1; a share of 1.5 processors counts as 2."""
    shares = [share for share in _shares() if share > 0]
    return max(1, min([_allowed(), *(math.ceil(share) for share in shares)]))


def _allowed() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _shares() -> list[float]:
    """What each control group above this process grants, in processors."""
    try:
        lines = OF_PROCESS.read_text().splitlines()
    except OSError:  # not Linux
        return []
    found: list[float] = []
    for line in lines:
        _, kinds, path = line.split(":", 2)
        if kinds and "cpu" not in kinds.split(","):
            continue
        # In a container the path may be one of the machine outside; its own group is then at the top.
        tops = [CGROUPS / kinds, CGROUPS / "cpu"] if kinds else [CGROUPS, CGROUPS / "unified"]
        for top in tops:
            group = top / path.lstrip("/")
            found += [_share(at) for at in (group, *group.parents) if at.is_relative_to(top)]
    return found


def _share(group: Path) -> float:
    """The processors that one group grants, by version 2 or 1; 0 for no limit."""
    try:
        if (group / "cpu.max").exists():
            quota, period = (group / "cpu.max").read_text().split()
            return 0.0 if quota == "max" else int(quota) / int(period)
        quota = (group / "cpu.cfs_quota_us").read_text()
        return max(0.0, int(quota) / int((group / "cpu.cfs_period_us").read_text()))
    except (OSError, ValueError, ZeroDivisionError):
        return 0.0
