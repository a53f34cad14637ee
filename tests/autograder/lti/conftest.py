"""A course that is registered at a platform, whose key is made once."""

import stat

import pytest

from autograder.lti import key, registration
from tests.autograder.lti.a_class import MEMBERS
from tests.autograder.lti.platform import Platform, playing
from tests.autograder.lti.platform import registration as registered


@pytest.fixture(scope="session")
def keys(tmp_path_factory):
    """A folder with a key pair; one takes a second."""
    root = tmp_path_factory.mktemp("keys")
    key.make(root)
    return root


@pytest.fixture
def root(tmp_path, keys):
    course = tmp_path / "course"
    course.mkdir()
    for path in (keys / "course").iterdir():
        (course / path.name).write_bytes(path.read_bytes())
        (course / path.name).chmod(stat.S_IMODE(path.stat().st_mode))
    return tmp_path


@pytest.fixture
def platform(root):
    """A platform with a course that has four students, and that knows our key."""
    platform = Platform(root / key.KEY_SET)
    platform.members = list(MEMBERS)
    with playing(platform):
        (root / registration.FILE).write_text(registered(platform))
        yield platform
