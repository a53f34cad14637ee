"""Open edX's platform side of LTI 1.3, as its package lti-consumer-xblock has it, on this machine.

Not one line of it is ours: it checks our requests as the platform does, and keeps what it takes. What
its core would know of a course is given to it: who is in it. A process of its own, since Django is set
up once in a process:

    python -m tests.autograder.lti.open_edx FOLDER PUBLIC_KEY KEY_SET_URL MEMBERS

prints one line of JSON and answers until it is ended. The line has what a course's lti.toml needs, once
where the platform has our key, and once where it asks for our key set. Its database is
FOLDER/platform.sqlite3.
"""

import json
import sys
from pathlib import Path
from types import SimpleNamespace
from wsgiref.simple_server import WSGIRequestHandler, make_server

import django
from django.conf import settings

BLOCK = "block-v1:Example+101+2026+type@lti_consumer+block@"
TABLES = {"ENGINE": "django.db.backends.sqlite3"}


def set_up(folder: Path, address: str) -> None:
    """Django with what the package needs, and its tables."""
    settings.configure(
        ALLOWED_HOSTS=["*"], DATABASES={"default": TABLES | {"NAME": folder / "platform.sqlite3"}},
        DEFAULT_AUTO_FIELD="django.db.models.AutoField", DEBUG=False, SECRET_KEY="of a test",
        INSTALLED_APPS=["django.contrib.auth", "django.contrib.contenttypes", "config_models",
                        "lti_consumer"],
        LMS_ROOT_URL=address, LTI_BASE=address, LTI_API_BASE=address, PLATFORM_NAME="test",
        USAGE_ID_PATTERN=r"(?P<usage_id>(?:i4x://?[^/]+/[^/]+/[^/]+/[^@]+(?:@[^/]+)?)|(?:[^/]+))",
        ROOT_URLCONF=__name__, USE_TZ=True, LOGGING_CONFIG=None,
    )  # fmt: skip
    django.setup()
    from django.core.management import call_command

    call_command("migrate", verbosity=0)


def know(members: list[dict]) -> None:
    """Give the package what it asks its platform's core of a course: who is in it."""
    from lti_consumer.plugin import compat, views

    known = {at: one | {"id": at} for at, one in enumerate(members, start=1)}
    numbers = {at: SimpleNamespace(external_user_id=one["number"]) for at, one in known.items()}
    users = SimpleNamespace(prefetch_related=lambda name: users, filter=lambda id__in: [])
    compat.get_course_members = lambda course: {at: dict(one) for at, one in known.items()}
    compat.merge_course_forum_roles = lambda course, members: None
    compat.batch_get_or_create_externalids = lambda users: numbers
    views.get_user_model = lambda: SimpleNamespace(objects=users)
    views.get_lti_pii_sharing_state_for_course = lambda course: True


def register(name: str, address: str, **our_key: str) -> dict[str, str]:
    """The course as a tool; what the platform shows of it."""
    from lti_consumer import models

    passport = models.Lti1p3Passport.objects.create(**our_key)
    made = models.LtiConfiguration.objects.create(
        version="lti_1p3", config_store="CONFIG_ON_DB", location=f"{BLOCK}{name}",
        lti_1p3_passport=passport, lti_advantage_ags_mode="programmatic",
        lti_advantage_enable_nrps=True,
    )  # fmt: skip
    base = f"{address}/api/lti_consumer/v1"
    services = f"{base}/lti/{made.id}"
    return {
        "issuer": address, "client-id": passport.lti_1p3_client_id,
        "token-url": f"{base}/token/{passport.passport_id}",
        "line-items-url": f"{services}/lti-ags", "members-url": f"{services}/memberships",
    }  # fmt: skip


class Quiet(WSGIRequestHandler):
    def log_message(self, *_):
        pass


def main(folder: Path, public_key: Path, key_set: str, members: Path) -> None:
    from django.core.wsgi import get_wsgi_application

    with make_server("127.0.0.1", 0, None, handler_class=Quiet) as server:
        address = f"http://127.0.0.1:{server.server_port}"
        set_up(folder, address)
        know(json.loads(members.read_text()))
        found = {
            "key": register("key", address, lti_1p3_tool_public_key=public_key.read_text()),
            "key set": register("set", address, lti_1p3_tool_keyset_url=key_set),
        }
        server.set_app(get_wsgi_application())
        print(json.dumps(found), flush=True)
        server.serve_forever(poll_interval=0.05)


def __getattr__(name: str):
    """The addresses, which Django asks this module for once the package is set up."""
    if name != "urlpatterns":
        raise AttributeError(name)
    from django.urls import include, path

    return [path("api/", include("lti_consumer.plugin.urls", namespace="lti_consumer"))]


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3], Path(sys.argv[4]))
