"""The key pair by which a platform knows the course, in course/: the private key, and two forms of the
public one.
"""

import json
import os
import stat
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from autograder.files import put_in_place
from autograder.lti import LtiError

PRIVATE = Path("course") / "lti-key.pem"
PUBLIC = Path("course") / "lti-public.pem"
KEY_SET = Path("course") / "lti-key-set.json"
BITS = 2048  # what platforms make for themselves


@dataclass(frozen=True)
class Key:
    """Both keys as PEM, as text."""

    private: str
    public: str

    @property
    def jwk(self) -> Mapping[str, Any]:
        """The public key as a JSON Web Key, with the id by which a request for a token names it."""
        from pylti1p3.registration import Registration

        return Registration.get_jwk(self.public)


def make(root: Path) -> tuple[Key, bool]:
    """The course's key, and whether it is new; the public forms are written again in any case.

    LtiError if the key that is there cannot be used, OSError if one cannot be written.
    """
    from jwcrypto.jwk import JWK

    is_new = not (root / PRIVATE).exists()
    if is_new:
        (root / PRIVATE).parent.mkdir(mode=0o700, exist_ok=True)
        pair = JWK.generate(kty="RSA", size=BITS)
        put_in_place(root / PRIVATE, pair.export_to_pem(private_key=True, password=None), 0o600)
    key = read(root)
    put_in_place(root / PUBLIC, key.public)
    put_in_place(root / KEY_SET, f"{json.dumps({'keys': [key.jwk]}, indent=2)}\n")
    return key, is_new


def read(root: Path) -> Key:
    """The course's key. LtiError if there is none, if it is none, or if other accounts can read it."""
    from jwcrypto.common import JWException
    from jwcrypto.jwk import JWK

    path = root / PRIVATE
    try:
        mode = stat.S_IMODE(path.stat().st_mode)
        data = path.read_bytes()
    except FileNotFoundError:
        raise LtiError(f"there is no {PRIVATE}: run `autograder lti key` first") from None
    if os.name == "posix" and mode & (stat.S_IRWXG | stat.S_IRWXO):
        raise LtiError(
            f"other accounts can read {path}, and who has it can send marks in your name: "
            f"chmod 600 {path}; if they may have read it, delete it, and register a new one"
        )
    try:
        pair = JWK.from_pem(data)
        private = pair.export_to_pem(private_key=True, password=None).decode()
        if pair["kty"] != "RSA":
            raise ValueError("it is not RSA")
    except (JWException, ValueError, TypeError) as error:
        raise LtiError(
            f"{path} holds no private RSA key ({error}): restore it, or delete it, run "
            "`autograder lti key`, and give the platform the new public key"
        ) from None
    return Key(private, pair.export_to_pem().decode())
