"""Import this first: it keeps `jsonschema` from loading `rfc3987_syntax`, which takes two seconds.

nbformat and nbgrader import jsonschema, which builds a grammar for international web addresses.
No schema of a notebook needs it, and jsonschema does without it if the package is missing.
"""

import sys

if "jsonschema" not in sys.modules and "rfc3987_syntax" not in sys.modules:
    sys.modules["rfc3987_syntax"] = None  # Python's way to say that it cannot be imported
    try:
        import jsonschema  # noqa: F401
    except ImportError:
        pass
    finally:
        del sys.modules["rfc3987_syntax"]
