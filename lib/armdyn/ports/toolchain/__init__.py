"""Finds, builds, keeps and talks to programs in other languages; it knows nothing of any arm.

The sandbox in which student code runs has this folder too, under another name. So it imports
relatively, and only the standard library and NumPy.
"""

from .building import BuildError, build
from .conversation import Conversation, ProgramError
from .finding import IN_BROWSER, MissingToolError, missing
from .languages import TOOLCHAINS, Toolchain

__all__ = [
    "IN_BROWSER",
    "TOOLCHAINS",
    "BuildError",
    "Conversation",
    "MissingToolError",
    "ProgramError",
    "Toolchain",
    "build",
    "missing",
]
