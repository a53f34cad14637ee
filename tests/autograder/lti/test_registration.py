"""course/lti.toml: what is wrong in it is named."""

import pytest

from autograder.lti import LtiError, registration
from tests.autograder.lti.platform import registration as registered


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"client-id": ""}, "client-id is missing"),
        ({"token-url": "http://x.org/t"}, "token-url = .* does not begin with https://"),
        ({"members-url": "x.org"}, "members-url = .* is no address"),
        ({"client_id": "1"}, "client_id is no setting; there are issuer, client-id"),
    ],
)
def test_what_is_wrong_with_the_registration_is_said(root, platform, change, said):
    (root / registration.FILE).write_text(registered(platform, **change))
    with pytest.raises(LtiError, match=rf"lti\.toml: {said}"):
        registration.read(root)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("issuer =", "Invalid value"),
        ("issuer = 3", "issuer = 3 is no text in quotes"),
        ('line-items = "x"', r"below \[line-items\]"),
        ('[line-items]\np3 = "http://x.org"', "p3 = .* does not begin with https://"),
    ],
)
def test_a_registration_that_is_no_registration(root, platform, text, said):
    held = "" if text.startswith("issuer") else registered(platform)
    (root / registration.FILE).write_text(f"{held}{text}\n")
    with pytest.raises(LtiError, match=said):
        registration.read(root)


def test_without_a_registration_the_error_says_what_to_write(tmp_path):
    with pytest.raises(LtiError, match=r"there is no course.lti\.toml: write into it .* token-url"):
        registration.read(tmp_path)
