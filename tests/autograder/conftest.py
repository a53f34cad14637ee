"""Rooms that the tests of a file share: a room must outlive a student's faults."""

import pytest

from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.sandbox import rooms as rooms_of_tests


@pytest.fixture(scope="module")
def rooms():
    """A file's own, as cells leave names behind: after `for _ in …` IPython no longer sets _."""
    with rooms_of_tests.kept() as rooms:
        yield rooms


@pytest.fixture
def way(request, needs) -> Way:
    """How the rooms of this test are made."""
    if request.param.walled:
        needs("bubblewrap")
    return request.param


@pytest.fixture
def room(rooms, way) -> Room:
    return rooms_of_tests.room_of(rooms, way)
