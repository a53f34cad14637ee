"""What `autograder lab` says when it cannot start; that it starts is tested in the browser."""

import logging
import socket

import pytest
from tornado.websocket import WebSocketClosedError

from autograder.lab import _is_an_error, lab


@pytest.fixture
def course(tmp_path, monkeypatch):
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refusal(capsys, *arguments: str) -> str:
    """The one line with which lab refuses."""
    assert lab([*arguments, "--no-browser"]) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    return said.err


@pytest.mark.parametrize("form", ["--port={}", "--port {}", "--ServerApp.port={}"])
def test_taken_port(course, capsys, form):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        said = refusal(capsys, *form.format(port).split())
    assert f"port {port} is taken" in said
    assert "leave --port out" in said
    assert not (course / ".venv").exists()


@pytest.mark.parametrize("given", ["--port=x", "--port=65536", "--port=-1", "--port="])
def test_no_port(course, capsys, given):
    assert f"{given} is not a port" in refusal(capsys, given)


def test_port_without_a_number(course, capsys):
    assert "--port=--no-browser is not a port" in refusal(capsys, "--port")


def test_wrong_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert "change to the folder of the course" in refusal(capsys)


@pytest.mark.parametrize(("error", "shown"), [(WebSocketClosedError(), False), (OSError(), True)])
def test_a_page_that_is_closed_is_no_error(caplog, monkeypatch, error, shown):
    log = logging.getLogger("asyncio")
    monkeypatch.setattr(log, "filters", [_is_an_error])
    log.error("Task exception was never retrieved", exc_info=error)
    assert bool(caplog.records) == shown
