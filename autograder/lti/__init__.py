"""Sends marks to a learning platform by LTI 1.3, with its Assignment and Grade Services 2.0.

The course is a tool of the platform: `course/lti.toml` says what the platform has registered, and a key
pair shows that it is us who sends. No launch is needed, and nothing of ours listens. Importing this
package does not import what talks to the platform, which the extra `lti` installs.
"""


class LtiError(ValueError):
    """Nothing can be sent; the message says why, and what to do."""
