"""All that students may read of the mistakes of all mechanisms, on one page for a person to review.

    python -m tests.autograder.mutation.said tests/autograder/mutation/said.txt

A sentence stands once, with ⟨…⟩ for what changes from place to place, then as it is said somewhere,
then where it is said. Review what a change of the page changes before you commit it.
"""

import re
import sys
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

from autograder.mechanisms import MECHANISMS, Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.mistakes import mistakes_of
from autograder.mutation.sentences.notation import written

PAGE = Path(__file__).with_name("said.txt")
HEAD = (
    "Every sentence on a mistake and every hint, by `python -m tests.autograder.mutation.said`.\n"
)


def page() -> str:
    parts = [HEAD, *_terms()]
    for title, said in (("Mistakes", mistakes), ("Hints", hints)):
        parts.append(f"\n== {title}\n")
        parts += _grouped(
            (m, a, text) for m in MECHANISMS.values() for a in ANSWERS for text in said(m, a)
        )
    return "\n".join(parts)


def _terms() -> Iterable[str]:
    """What the energies' terms are called, as sentences hold these names."""
    yield "== Terms\n"
    for mechanism in MECHANISMS.values():
        for energy, terms in (("K", mechanism.kinetic), ("P", mechanism.potential)):
            yield f"{mechanism.name}, {energy}: {'; '.join(term.name for term in terms)}"


def mistakes(mechanism: Mechanism, answer: str) -> Iterable[str]:
    """A sentence on what follows from something wrong is two: that it does, and what is wrong there."""
    for mistake in mistakes_of(mechanism, answer):
        derived = re.match(r"(?:(?:Your|This) [^.]* looks? like [^.]*\. )+(?=\w)", mistake.sentence)
        end = derived.end() if derived else 0
        if derived:
            yield mistake.sentence[:end].strip()
        yield mistake.sentence[end:]


def hints(mechanism: Mechanism, answer: str) -> Iterable[str]:
    return check_of(mechanism, answer).hints


def _grouped(said: Iterable[tuple[Mechanism, str, str]]) -> Iterable[str]:
    """One paragraph for each form of a sentence, in the order in which they come."""
    forms: dict[str, str] = {}
    places: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    for mechanism, answer, text in said:
        shape = form(text, mechanism)
        forms.setdefault(shape, text)
        places[shape][answer].add(mechanism.name)
    for shape, example in forms.items():
        yield shape
        if example != shape:
            yield f"    as: {example}"
        of = (
            f"{answer} ({len(names)})" if len(names) > 1 else f"{answer} of {next(iter(names))}"
            for answer, names in places[shape].items()
        )
        yield f"    of: {', '.join(of)}"
        yield ""


ANSWER = r"(?:[MCgPKLYẋṀ]\d*|q̈|drift)(?![\w(\u0307])"


def form(text: str, mechanism: Mechanism) -> str:
    """The sentence without what belongs to a place: the term, the answer or entry, the parameters."""
    names = [term.name for term in (*mechanism.kinetic, *mechanism.potential)]
    for name in sorted(names, key=len, reverse=True):
        text = text.replace(name, "⟨term⟩")
    text = re.sub(r"the (viscous|Coulomb) friction of (the )?\w+( \d)?", "⟨term⟩", text)
    text = re.sub(r"(⟨term⟩; )+⟨term⟩", "⟨terms⟩", text)
    text = re.sub(r"come out as (?!if )[^\s?.]+", "come out as ⟨unit⟩", text)
    for parameter in sorted(mechanism.parameters, key=lambda p: -len(p.doc)):
        text = text.replace(f"({parameter.doc})", "(⟨meaning⟩)")
    coordinates = [written(c.name, mechanism) for c in mechanism.coordinates]
    velocities = [written(v.name, mechanism) for v in mechanism.qd]
    parameters = [p.name for p in mechanism.parameters]
    zeros = "; ".join(f"{c.name} = 0 is {c.zero}" for c in mechanism.coordinates)
    text = text.replace(written(zeros, mechanism), "⟨zeros⟩")
    text = re.sub(rf"\b([Yy]our|[Tt]his|wrong) {ANSWER}", r"\1 ⟨answer⟩", text)
    text = re.sub(rf"\bin {ANSWER}(?! =)", "in ⟨answer⟩", text)
    text = re.sub(rf"\b(as|and) {ANSWER} (does|lacks)", r"\1 ⟨answer⟩ \2", text)
    text = re.sub(r"\brow \d", "row ⟨number⟩", text)
    text = text.replace("In this ⟨answer⟩", "In your ⟨answer⟩").replace("This ⟨", "Your ⟨")
    for word, symbols in (
        ("⟨coordinate⟩", [c for c in coordinates if c not in ("q", "x")]),
        ("⟨velocity⟩", [v for v in velocities if v != "q̇"]),
        ("⟨parameter⟩", [written(p, mechanism) for p in parameters if p not in ("g", "k")]),
    ):
        one = "|".join(sorted(symbols, key=len, reverse=True)) or "(?!)"
        text = re.sub(rf"(?<!\w)−?({one})²?([ ·*+−-]+({one})²?)*(?![\w’\u0307])", word, text)
    text = re.sub(r"⟨coordinate⟩( and ⟨coordinate⟩)+", "⟨coordinates⟩", text)
    text = re.sub(r"\b[gk] (beside|and|does not appear|\(⟨meaning⟩\))", r"⟨parameter⟩ \1", text)
    return re.sub(r"(lacks|beside|power of|and) [gk]([. ])(?!share)", r"\1 ⟨parameter⟩\2", text)


def main(paths: list[str]) -> None:
    for path in map(Path, paths):
        path.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
