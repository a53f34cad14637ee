"""What a room has used and how long it has waited, as the judge asks for it."""

from types import SimpleNamespace

import pytest

from autograder.sandbox import clock
from autograder.sandbox.clock import Clock


class Room:
    """A room that idles all the time, and its watch; requests: what the watch was asked."""

    def __init__(self):
        self.now, self.requests = 100.0, []

    def ask_watch(self, request, seconds):
        self.requests.append(request)
        return 0.0, self.now - 100.0


@pytest.fixture
def room(monkeypatch):
    room = Room()
    monkeypatch.setattr(clock, "time", SimpleNamespace(monotonic=lambda: room.now))
    return room


def work(judge: Clock, room: Room, seconds: float) -> None:
    """A request to which the room replies after a time in which it only waits."""
    with judge.working():
        room.now += seconds
        judge.look("sweep")


def test_requests_that_follow_at_once_are_looked_at_once_each(room):
    judge = Clock(room)
    judge.begin()
    for _ in range(5):
        work(judge, room, 2.0)
    assert room.requests == ["used"] + 5 * ["sweep"]
    assert judge.waited == pytest.approx(10.0)


def test_what_the_judge_thinks_over_is_no_waiting_of_the_rooms(room):
    judge = Clock(room)
    judge.begin()
    for _ in range(5):
        room.now += 30.0
        work(judge, room, 2.0)
    assert judge.waited == pytest.approx(10.0)
