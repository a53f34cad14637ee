"""Whether this account may work in a course's folder, and as whom to do so if not."""

import os
from pathlib import Path


def why_closed(folder: Path) -> str:
    """Why this account cannot read and write in a folder that is there, and what to do; "" if it can."""
    if os.access(folder, os.R_OK | os.W_OK | os.X_OK):
        return ""
    try:
        owner = f"the account {folder.owner()}"
    except (
        KeyError,
        NotImplementedError,
        OSError,
    ):  # an account that is gone, Windows, a closed folder
        owner = "another account"
    return (
        f"you cannot read and write in {folder}, which belongs to {owner}: run the command as that "
        "account, or work in a course's folder of your own"
    )
