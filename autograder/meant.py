"""Which of the names that are there somebody may have meant by one that is not."""

import difflib
from collections.abc import Collection


def meant(asked: str, names: Collection[str]) -> list[str]:
    """Those that hold the name asked for; else those like it; none where nothing is near."""
    holding = [name for name in names if asked and asked.casefold() in name.casefold()]
    return holding or difflib.get_close_matches(asked, names)
