"""Acts as one of the accounts that every Debian has, where root runs the tests."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

needs_root = pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0,
    reason="run the tests as root to try what one account can do to another",
)


@contextmanager
def acting_as(name: str) -> Iterator[None]:
    """Within the block, this process has the rights of that account, and no others."""
    import pwd

    account = pwd.getpwnam(name)
    before = os.geteuid(), os.getegid(), os.getgroups()
    _become(account.pw_uid, account.pw_gid, [])
    try:
        yield
    finally:
        _become(*before)


def _become(user: int, group: int, groups: list[int]) -> None:
    os.setresuid(0, 0, 0)
    os.setgroups(groups)
    os.setresgid(group, group, 0)
    os.setresuid(user, user, 0)
