"""Our request for a token, and our key set, as lti1p3platform checks them: by the key's id, too."""

import json

import pytest

pytest.importorskip(
    "lti1p3platform", reason="needs lti1p3platform: pip install -c constraints.txt -e .[peers]"
)
from jwcrypto.jwk import JWK
from lti1p3platform.ltiplatform import LTI1P3PlatformConfAbstract
from lti1p3platform.registration import Registration

from autograder.lti import key, registration, sending
from autograder.lti.sending import How
from tests.autograder.lti.a_class import MEMBERS, marks, scores
from tests.autograder.lti.platform import AGS, CLIENT, Platform, playing
from tests.autograder.lti.platform import MEMBERS as READ_MEMBERS
from tests.autograder.lti.platform import registration as registered


class Issuer(LTI1P3PlatformConfAbstract):
    """Issues tokens and reads them again; the package's own code, given the registration alone."""

    def init_platform_config(self, tool_keys: dict) -> None:
        pair = JWK.generate(kty="RSA", size=2048)
        private = pair.export_to_pem(private_key=True, password=None).decode()
        self._registration = (
            Registration()
            .set_iss("https://platform.example.edu")
            .set_client_id(CLIENT)
            .set_tool_key_set(tool_keys)
            .set_platform_private_key(private)
            .set_platform_public_key(pair.export_to_pem().decode())
        )

    def get_registration_by_params(self, **_) -> Registration:
        return self._registration


class Peer(Platform):
    """Our platform, whose tokens are lti1p3platform's."""

    def __init__(self, key_set):
        super().__init__(key_set)
        self.issuer = Issuer(tool_keys=json.loads(key_set.read_text()))
        self.scopes: list[str] = []

    def _token(self, form: dict):
        issued = self.issuer.get_access_token({name: text for name, (text,) in form.items()})
        for scope in (f"{AGS}lineitem", f"{AGS}score", READ_MEMBERS):
            if self.issuer.validate_token(issued["access_token"], [scope]):
                self.tokens.setdefault(issued["access_token"], set()).add(scope)
                self.scopes.append(scope)
        return issued


def test_its_tokens_let_marks_through(root):
    platform = Peer(root / key.KEY_SET)
    platform.members = list(MEMBERS)
    with playing(platform):
        (root / registration.FILE).write_text(registered(platform))
        assert sending.send(root, marks(), How()).faults == []
    assert len(scores(platform)) == 3
    assert sorted(platform.scopes) == sorted([f"{AGS}lineitem", f"{AGS}score", READ_MEMBERS])
