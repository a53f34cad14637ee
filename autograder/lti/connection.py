"""Requests to a platform: only by https or within this machine, each with a time limit."""

import time
from http import HTTPStatus

from pylti1p3.exception import LtiServiceException
from pylti1p3.registration import Registration
from pylti1p3.service_connector import ServiceConnector, TServiceConnectorResponse
from requests import PreparedRequest, Response, Session
from requests.adapters import HTTPAdapter
from urllib3.util import Retry

from autograder.lti import LtiError
from autograder.lti.key import Key
from autograder.lti.registration import Registered, not_safe

PATIENCE = (10.0, 60.0)  # s: to be connected, and to get the next part of an answer
LONGEST_PAUSE = 30.0  # s, whatever a platform that is asked too often demands
TIMES = 4
EARLY = 30.0  # s before its end, a token is asked for again
# A score that comes twice is the same score, so it may be sent again, too.
PASSING = (
    HTTPStatus.TOO_MANY_REQUESTS,
    HTTPStatus.BAD_GATEWAY,
    HTTPStatus.SERVICE_UNAVAILABLE,
    HTTPStatus.GATEWAY_TIMEOUT,
)


class _Patient(Retry):
    """Asks again after a pause that is never too long."""

    def get_retry_after(self, response) -> float | None:
        said = super().get_retry_after(response)
        return None if said is None else min(said, LONGEST_PAUSE)


class _Guarded(HTTPAdapter):
    """Sends nothing that others could read on the way, also where the platform names the address."""

    def send(self, request: PreparedRequest, *args, **options) -> Response:
        if why := not_safe(request.url or ""):
            raise LtiError(f"the platform names an address that {why}: {request.url}")
        options["timeout"] = PATIENCE
        return super().send(request, *args, **options)


class Connector(ServiceConnector):
    """PyLTI1p3's, which asks for tokens; it keeps each as long as the platform says."""

    def __init__(self, registered: Registered, key: Key):
        registration = Registration()
        registration.set_issuer(registered.issuer).set_client_id(registered.client_id)
        registration.set_auth_token_url(registered.token_url)
        if registered.audience:
            registration.set_auth_audience(registered.audience)
        registration.set_tool_private_key(key.private).set_tool_public_key(key.public)
        super().__init__(registration, _session())
        self._token_url = registered.token_url
        self._tokens: dict[str, tuple[str, float]] = {}

    def make_service_request(self, *args, **options) -> TServiceConnectorResponse:
        """Ask once more with a new token where the platform has ended one before its time."""
        try:
            return super().make_service_request(*args, **options)
        except LtiServiceException as error:
            answer = error.response
            if answer.status_code != HTTPStatus.UNAUTHORIZED or answer.url == self._token_url:
                raise
        self._tokens.clear()
        return super().make_service_request(*args, **options)

    def _get_cached_access_token(self, scope_key: str) -> str | None:
        token, until = self._tokens.get(scope_key, ("", 0.0))
        return token if time.monotonic() < until else None

    def _cache_access_token(self, scope_key: str, access_token: str, expires_in: float) -> None:
        until = time.monotonic() + float(expires_in) - EARLY
        self._tokens[scope_key] = access_token, until


def _session() -> Session:
    session = Session()
    session.headers["User-Agent"] = "armdyn"
    session.max_redirects = 0  # a token is for the address that was registered, and for no other
    session.auth = _as_it_is
    again = _Patient(
        TIMES - 1, backoff_factor=0.5, status_forcelist=PASSING, allowed_methods=None,
        redirect=False, raise_on_status=False,
    )  # fmt: skip
    for scheme in ("https://", "http://"):
        session.mount(scheme, _Guarded(max_retries=again))
    return session


def _as_it_is(request: PreparedRequest) -> PreparedRequest:
    """Keeps `requests` from putting a password of ~/.netrc in the token's place."""
    return request
