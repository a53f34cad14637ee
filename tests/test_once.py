"""What the processes of a run share is made once, whole, and by one of them."""

from concurrent.futures import ThreadPoolExecutor
from threading import Event

import pytest

from tests import once


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(once, "folder", tmp_path / "once")
    monkeypatch.setattr(once, "PATIENCE", 20.0)


@pytest.mark.usefixtures("folder")
def test_who_comes_second_waits_and_finds_the_whole():
    began, made = Event(), []

    def make(top):
        began.set()
        made.append(top)
        (top / "half").touch()
        Event().wait(0.3)
        (top / "whole").touch()

    def ask():
        assert began.wait(20)
        return sorted(path.name for path in once.made_once("course", make).iterdir())

    with ThreadPoolExecutor() as threads:
        second = threads.submit(ask)
        first = once.made_once("course", make)
        assert second.result(timeout=20) == ["half", "whole"]
    assert made == [first]


@pytest.mark.usefixtures("folder")
def test_what_could_not_be_made_is_not_waited_for():
    def fails(top):
        raise OSError("no room")

    with pytest.raises(OSError, match="no room"):
        once.made_once("course", fails)
    with pytest.raises(AssertionError, match="course could not be made"):
        once.made_once("course", fails)


def test_it_stands_in_the_folder_of_the_run(tmp_path_factory):
    """Which pytest removes, however a process of the run ends."""
    made = once.made_once("nothing", lambda top: None)
    assert made.is_relative_to(once.of_the_run(tmp_path_factory.getbasetemp()))
