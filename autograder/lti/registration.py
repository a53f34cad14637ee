"""What a platform has registered of the course: course/lti.toml.

issuer = "https://moodle.example.edu"
client-id = "Zk3xQ7"
token-url = "https://moodle.example.edu/mod/lti/token.php"
line-items-url = "https://moodle.example.edu/mod/lti/services.php/2/lineitems?type_id=1"
members-url = "https://moodle.example.edu/mod/lti/services.php/CourseSection/2/bindings/1/memberships"

[line-items]
p3-pendulum = "https://moodle.example.edu/mod/lti/services.php/2/lineitems/17/lineitem?type_id=1"
"""

import tomllib
from dataclasses import dataclass, field
from ipaddress import ip_address
from pathlib import Path
from urllib.parse import urlsplit

from autograder.lti import LtiError

FILE = Path("course") / "lti.toml"
NEEDED = ("issuer", "client-id", "token-url", "line-items-url")
# A platform shows the last three with the others. They serve launches, and sending needs none of them.
OTHERS = ("members-url", "audience", "deployment-id", "key-set-url", "login-url")
LINE_ITEMS = "line-items"


@dataclass(frozen=True)
class Registered:
    """members_url: "" where the class list's lms_id is the platform's id of a user. audience: whom a
    request for a token is addressed to. line_items: by assignment, those that the platform made.
    """

    issuer: str
    client_id: str
    token_url: str
    line_items_url: str
    members_url: str = ""
    audience: str = ""
    line_items: dict[str, str] = field(default_factory=dict)


def read(root: Path) -> Registered:
    """The file of the course in the folder `root`. LtiError if there is none, or if it is wrong."""
    path = root / FILE
    if not path.is_file():
        raise LtiError(
            f"there is no {FILE}: write into it what the platform shows when you register the course "
            f"as a tool: {', '.join(NEEDED)}, and members-url"
        )
    try:
        held = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise LtiError(f"{path}: {error}") from None
    own = held.pop(LINE_ITEMS, {})
    if not isinstance(own, dict):
        raise LtiError(f"{path}: the line items are written below [{LINE_ITEMS}]")
    for name, text in [*held.items(), *own.items()]:
        if not isinstance(text, str) or not text.strip():
            raise LtiError(f"{path}: {name} = {text!r} is no text in quotes")
    for name in held:
        if name not in (*NEEDED, *OTHERS):
            raise LtiError(
                f"{path}: {name} is no setting; there are {', '.join((*NEEDED, *OTHERS))}"
            )
    for name in NEEDED:
        if name not in held:
            raise LtiError(f"{path}: {name} is missing")
    for name, text in [*held.items(), *own.items()]:
        if (name.endswith("-url") or name in own) and (why := not_safe(text)):
            raise LtiError(f"{path}: {name} = {text!r} {why}")
    return Registered(
        issuer=held["issuer"].strip(),
        client_id=held["client-id"].strip(),
        token_url=held["token-url"].strip(),
        line_items_url=held["line-items-url"].strip(),
        members_url=held.get("members-url", "").strip(),
        audience=held.get("audience", "").strip(),
        line_items={name: text.strip() for name, text in own.items()},
    )


def not_safe(url: str) -> str:
    """Why nothing may be sent to this address; "" if it may: by https, or on this machine."""
    try:
        parts = urlsplit(url.strip())
        host = parts.hostname or ""
    except ValueError as error:
        return f"is no address: {error}"
    if not host:
        return "is no address, such as https://moodle.example.edu/mod/lti/token.php"
    if parts.scheme == "https" or (parts.scheme == "http" and _is_here(host)):
        return ""
    return "does not begin with https://, so others could read what is sent"


def _is_here(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
