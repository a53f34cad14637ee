"""The skeletons that a new problem or lesson is made of, with its own names in them."""

from collections.abc import Mapping
from pathlib import Path

SKELETONS = Path(__file__).parent / "skeleton"


def filled(skeleton: str, words: Mapping[str, str]) -> str:
    """The text of a skeleton, with each «word» replaced."""
    text = (SKELETONS / f"{skeleton}.txt").read_text(encoding="utf-8")
    for word, own in words.items():
        text = text.replace(f"«{word}»", own)
    return text
