"""Import this first: it keeps `jsonschema` from loading `rfc3987_syntax`, which takes two seconds.

nbformat and nbgrader import jsonschema, which builds a grammar for international web addresses.
No schema of a notebook needs it, and jsonschema does without it if the package is missing.
"""

import sys

if "jsonschema" not in sys.modules and "rfc3987_syntax" not in sys.modules:
    # Python's way to say that it cannot be imported, which typeshed does not know.
    sys.modules["rfc3987_syntax"] = None  # type: ignore[assignment]
    try:
        import jsonschema  # noqa: F401
    except ImportError:
        pass
    finally:
        del sys.modules["rfc3987_syntax"]
