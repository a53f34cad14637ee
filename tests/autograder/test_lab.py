"""What `autograder lab` says when it cannot start; that it starts is tested in the browser."""

import asyncio
import logging
import socket
from functools import partial
from unittest import mock

import pytest
from jupyterlab.labapp import LabApp
from tornado.iostream import StreamClosedError
from tornado.log import access_log, app_log, gen_log
from tornado.websocket import WebSocketClosedError

from autograder.lab import lab


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
    assert f"port {port} is in use" in said
    assert "leave out --port" in said
    assert not (course / ".venv").exists()


@pytest.mark.parametrize("given", ["--port=x", "--port=65536", "--port=-1", "--port="])
def test_no_port(course, capsys, given):
    assert f"{given} is not a port" in refusal(capsys, given)


def test_port_without_a_number(course, capsys):
    assert "--port=--no-browser is not a port" in refusal(capsys, "--port")


def test_wrong_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert "change to the course's folder" in refusal(capsys)


@pytest.fixture
def server(monkeypatch):
    """Stands in for the server, which is not to run here. Its start does what its loop would do."""
    server = mock.MagicMock(log=logging.getLogger("of the server"), custom_display_url="")
    tasks = [partial(print, "listening")]
    server.io_loop.add_callback = lambda task, *args, **named: tasks.append(
        partial(task, *args, **named)
    )
    server.start = lambda: [task() for task in tasks]
    server.connection_url, server.default_url = "http://3f2a:8888/", "/lab"
    server.identity_provider.token = "t"
    monkeypatch.setattr(LabApp, "initialize_server", lambda arguments: server)
    return server


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("", "http://3f2a:8888/lab"),
        ("http://127.0.0.1:8888", "http://127.0.0.1:8888/lab"),
        ("https://class.example/ada/", "https://class.example/ada/lab"),
    ],
)
def test_the_address_is_the_one_that_the_reader_can_open(course, server, capsys, said, shown):
    server.custom_display_url = said  # as an image for students sets it
    assert lab([]) == 0
    printed = capsys.readouterr().out
    assert f"Open {shown}?token=t\n" in printed
    assert printed.startswith("listening")  # or who reads it could be too early


@pytest.fixture
def quiet(course, server, monkeypatch, caplog):
    """The logs of `autograder lab` as it sets them up."""
    logs = [server.log, asyncio.log.logger, app_log, access_log, gen_log]
    for log in logs:
        monkeypatch.setattr(log, "filters", [])
        caplog.set_level(logging.ERROR, log.name)  # Dask lowers some
    assert lab([]) == 0
    return logs


@pytest.mark.parametrize(
    ("error", "shown"), [(WebSocketClosedError(), 0), (StreamClosedError(), 0), (OSError(), 5)]
)
def test_a_page_that_is_closed_is_no_error(quiet, caplog, error, shown):
    for log in quiet:
        log.error("Uncaught exception", exc_info=error)
    assert len(caplog.records) == shown
