"""Rooms that tests share: a room must outlive a student's faults."""

import pytest

from autograder.sandbox import Room, Way


@pytest.fixture(scope="session")
def rooms():
    """One room of each kind, started when a test asks for it."""
    rooms = {}
    yield rooms
    for room in rooms.values():
        room.close()


@pytest.fixture
def way(request, needs) -> Way:
    """How the rooms of this test are made."""
    if request.param is not Way.NONE:
        needs("bubblewrap")
    return request.param


@pytest.fixture
def room(rooms, way) -> Room:
    # A test that loses the room fails by itself, and takes no other along.
    if way not in rooms or rooms[way].closed:
        rooms[way] = Room(way)
    return rooms[way]
