"""The services of a platform that sending marks needs: its members, line items and scores."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http import HTTPStatus
from urllib.parse import urlsplit

import requests
from pylti1p3.assignments_grades import AssignmentsGradesService, TAssignmentsGradersData
from pylti1p3.exception import LtiException, LtiServiceException
from pylti1p3.grade import Grade
from pylti1p3.lineitem import LineItem
from pylti1p3.names_roles import NamesRolesProvisioningService, TMember

from autograder.lti import LtiError
from autograder.lti.connection import Connector
from autograder.lti.key import Key
from autograder.lti.registration import FILE, Registered
from autograder.lti.scores import number
from autograder.protocol import one_line

AGS = "https://purl.imsglobal.org/spec/lti-ags/scope/"
# With or without the address of its vocabulary before a #.
LEARNER, TRIES_THINGS = "Learner", "TestUser"
RIGHTS = {  # by what is asked for
    "its members": "to read its members",
    "its line items": "to manage line items",
    "the score": "to send scores",
}
REASONS = ("reason", "error_description", "message", "error", "errors")


class RefusedError(LtiError):
    """The platform answered that it does not take this; it may take the next."""


@dataclass(frozen=True)
class LineItemThere:
    """A line item of the platform; "" where there is none yet. most: its points, None if not known."""

    address: str
    is_new: bool
    most: float | None


class Platform:
    """What is asked of one platform; LtiError where it cannot be reached or its answer is no answer."""

    def __init__(self, registered: Registered, key: Key):
        self._registered = registered
        self._connector = Connector(registered, key)

    def learners(self) -> list[TMember]:
        """The members of the platform's course who are students there now."""
        of = {"context_memberships_url": self._registered.members_url}
        with self._understood("its members"):
            every = NamesRolesProvisioningService(self._connector, of).get_members()  # type: ignore[arg-type]
            return [
                one
                for one in every
                if one.get("status", "Active") == "Active"
                and LEARNER
                in (roles := {str(role).rpartition("#")[2] for role in one.get("roles", ())})
                and TRIES_THINGS not in roles
            ]

    def line_item(self, assignment: str, most: float, make: bool) -> LineItemThere:
        """An assignment's line item. most: its points. make: whether one is made where there is none.

        RefusedError if the platform gives none for this assignment.
        """
        if known := self._registered.line_items.get(assignment):
            return LineItemThere(known, False, None)
        with self._understood("its line items"):
            found = self._grades("lineitem").find_lineitem_by_resource_id(assignment)
            if found is None and not make:
                return LineItemThere("", True, None)
            if is_new := found is None:
                new = LineItem().set_label(assignment).set_resource_id(assignment)
                new.set_score_maximum(number(most))
                found = self._grades("lineitem").find_or_create_lineitem(new, "resource_id")
            address = found.get_id()
            if not isinstance(address, str):
                raise LtiException("a line item without an id")
            there = found.get_score_maximum()
            return LineItemThere(address, is_new, None if there is None else float(there))

    def send(self, line_item: str, score: dict) -> None:
        """Send one student's score. RefusedError if the platform does not take this one."""
        with self._understood("the score"):
            self._grades("score").put_grade(
                Grade().set_extra_claims(score), LineItem({"id": line_item})
            )

    def _grades(self, scope: str) -> AssignmentsGradesService:
        data: TAssignmentsGradersData = {
            "scope": [f"{AGS}{scope}"],  # type: ignore[list-item]
            "lineitems": self._registered.line_items_url,
        }
        return AssignmentsGradesService(self._connector, data)

    @contextmanager
    def _understood(self, what: str) -> Iterator[None]:
        """Says of a failed request what the platform answered."""
        try:
            yield
        except LtiServiceException as error:
            answer = error.response
            where = answer.url.partition("?")[0]
            is_token = answer.url == self._registered.token_url
            refused = f"{where} answers {answer.status_code}: {_said(answer)}"
            # Without a token, the next is not taken either.
            raise (LtiError if is_token else RefusedError)(
                refused + _hint(answer, what if is_token else "")
            ) from None
        except requests.TooManyRedirects as error:
            to = error.response.headers.get("Location", "") if error.response is not None else ""
            raise LtiError(
                f"the platform leads on to {one_line(to, 200)}: write the address where it ends"
            ) from None
        except requests.JSONDecodeError:
            raise LtiError(f"the platform's answer to a request for {what} is not JSON") from None
        except requests.exceptions.SSLError as error:
            raise LtiError(
                f"{_host(error)} shows no certificate that this machine trusts: "
                f"{one_line(str(error), 200)}"
            ) from None
        except (requests.ConnectionError, requests.Timeout) as error:
            raise LtiError(
                f"{_host(error)} cannot be reached: look at the addresses in {FILE}, and whether this "
                "machine may reach that one"
            ) from None
        except requests.RequestException as error:
            raise LtiError(f"{_host(error)} cannot be asked: {one_line(str(error), 200)}") from None
        except (LtiException, KeyError, TypeError, AttributeError, ValueError) as error:
            if isinstance(error, LtiError):
                raise
            raise LtiError(
                f"the platform's answer to a request for {what} is not as LTI lays down: "
                f"{one_line(f'{type(error).__name__}: {error}', 200)}"
            ) from None


def _host(error: requests.RequestException) -> str:
    url = error.request.url if error.request is not None else None
    return str(urlsplit(url).netloc) if url else "the platform"


def _said(answer: requests.Response) -> str:
    """The platform's words, without what it wraps them in."""
    text = answer.text
    try:
        found = answer.json()
        while isinstance(found, dict):
            found = next((found[name] for name in REASONS if found.get(name)), None)
        text = found if isinstance(found, str) else text
    except requests.JSONDecodeError:
        if text.lstrip().startswith("<"):
            text = f"a web page ({answer.reason}), as where an address is wrong"
    return one_line(" ".join(text.split()), 200) or answer.reason


def _hint(answer: requests.Response, what: str) -> str:
    """Where to look. what: what a token was asked for, "" if it was none."""
    if what and "invalid_scope" in answer.text:
        return f": the platform does not allow the course {RIGHTS[what]}"
    if what and "invalid_client" in answer.text:
        return ": look at client-id, the public key that the platform has, and this machine's clock"
    if answer.status_code == HTTPStatus.CONFLICT:
        return ": the platform has a later score: is this machine's clock right?"
    return ""
