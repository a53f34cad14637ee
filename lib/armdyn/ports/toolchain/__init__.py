"""Programs in other languages: found, built, kept and talked to; nothing of any arm is known here.

The folder is used under another name too, in the room where student code runs: it imports
relatively, and only the standard library and NumPy.
"""

from .building import BuildError, build
from .conversation import Conversation, ProgramError
from .finding import MissingToolError, missing
from .languages import TOOLCHAINS, Toolchain

__all__ = [
    "TOOLCHAINS",
    "BuildError",
    "Conversation",
    "MissingToolError",
    "ProgramError",
    "Toolchain",
    "build",
    "missing",
]
