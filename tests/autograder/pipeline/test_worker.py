"""What a worker says of a file that is no notebook."""

import pytest

from autograder.pipeline.worker import judge


@pytest.mark.parametrize("content", [b"[]", b"null", b"3", b'"text"', b"{}"])
def test_json_of_something_else_is_no_notebook(content):
    refused = judge(content, "", "seed")["refused"]
    assert refused == "is not a notebook: ask the student for it again"


@pytest.mark.parametrize("content", [b"", b"{", "{}".encode("utf-16")])
def test_what_is_no_json_is_said_to_be_none(content):
    assert judge(content, "", "seed")["refused"].startswith("is not valid JSON")
