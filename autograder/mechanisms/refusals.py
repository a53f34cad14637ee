"""What a mechanism is refused for: each is a ValueError that names what is wrong, and what is needed."""

from __future__ import annotations

import keyword
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp

from autograder.mechanisms.shapes import SHAPES

if TYPE_CHECKING:
    from autograder.mechanisms.mechanism import EnergyTerm, Mechanism

UNITS_OF_COORDINATES = ("rad", "m")


def refuse_bad_name(where: str, name: str) -> None:
    """For a name of a mechanism that can be no folder's and no check's."""
    if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", str(name)):
        raise ValueError(
            f"{where}: needs a name of small letters, digits and hyphens, as cart-pole"
        )


def tuple_of(where: str, field: str, kind: type, given: object) -> tuple:
    """A field's parts; ValueError where one is of another kind, or alone, without a tuple."""
    if not isinstance(given, Sequence) or not all(isinstance(e, kind) for e in given):
        raise ValueError(
            f"{where}: {field} needs a tuple of {kind.__name__}, as ({kind.__name__}(…),); "
            f"it is {given!r}"
        )
    return tuple(given)


def refuse_bad_names(where: str, mechanism: Mechanism) -> None:
    """For names that Python cannot read, or that two things have."""
    for entry in [*mechanism.coordinates, *mechanism.parameters]:
        name = str(getattr(entry, "name", ""))
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name) or keyword.iskeyword(name):
            raise ValueError(
                f"{where}: the name {name!r} needs letters and digits alone, and to be no word of "
                "Python's"
            )
    names = [c.name for c in mechanism.coordinates] + [p.name for p in mechanism.parameters]
    names += [c.velocity.name for c in mechanism.coordinates]
    refuse_doubles(where, "symbols", names)
    terms = [term.name for term in (*mechanism.kinetic, *mechanism.potential)]
    refuse_doubles(where, "energy terms", terms)
    refuse_doubles(where, "terms", [*terms, *(term.name for term in mechanism.friction)])


def refuse_doubles(where: str, kind: str, names: list[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{where}: two of its {kind} are {name!r}")


def refuse_bad_units_and_ranges(where: str, mechanism: Mechanism) -> None:
    """For a coordinate that is no angle or length, and a parameter without a unit or a range."""
    for coordinate in mechanism.coordinates:
        if coordinate.unit not in UNITS_OF_COORDINATES:
            raise ValueError(
                f"{where}: {coordinate.name} has the unit {coordinate.unit!r}, needs rad or m"
            )
        if coordinate.name == "q" and len(mechanism.coordinates) > 1:
            raise ValueError(
                f"{where}: 'q' is the vector of all its coordinates; give this one another name"
            )
    for p in mechanism.parameters:
        if not p.unit or not isinstance(p.unit, str):
            raise ValueError(f"{where}: {p.name} needs a unit, as kg")
        if not all(isinstance(x, int | float) for x in (p.low, p.high)) or not 0 < p.low < p.high:
            raise ValueError(
                f"{where}: {p.name} is drawn from {p.low} to {p.high}; needs 0 < low < high"
            )


def refuse_bad_energies(where: str, mechanism: Mechanism) -> None:
    """For a term of K that is not quadratic in q̇, one of P that holds q̇, and a foreign symbol."""
    for term in mechanism.kinetic:
        _refuse_foreign(where, "K", term, mechanism)
        _refuse_other_than_quadratic(where, term, mechanism)
    for term in mechanism.potential:
        _refuse_foreign(where, "P", term, mechanism)
        held = sorted(s.name for s in sp.sympify(term.energy).free_symbols & set(mechanism.qd))
        if held:
            raise ValueError(
                f"{where}: {term.name!r} of P holds {', '.join(held)}, a velocity; P is a "
                "function of the coordinates alone"
            )


def _refuse_foreign(where: str, energy: str, term: EnergyTerm, mechanism: Mechanism) -> None:
    try:
        symbols = sp.sympify(term.energy).free_symbols
    except (sp.SympifyError, TypeError, AttributeError) as error:
        raise ValueError(
            f"{where}: {term.name!r} of {energy} is no expression ({error}); it is made of "
            "m.symbol, x.symbol and x.velocity"
        ) from None
    known = {*mechanism.q, *mechanism.qd, *(p.symbol for p in mechanism.parameters)}
    unknown = sorted(s.name for s in symbols - known)
    if unknown:
        raise ValueError(
            f"{where}: {term.name!r} holds {', '.join(unknown)}, which is neither a "
            "coordinate, nor a velocity, nor a parameter of the mechanism"
        )


def _refuse_other_than_quadratic(where: str, term: EnergyTerm, mechanism: Mechanism) -> None:
    """Tried in numbers, as that is quick: twice the velocities give four times the energy."""
    rng = np.random.default_rng(0)
    at = {s: rng.uniform(0.5, 1.0) for s in sp.sympify(term.energy).free_symbols}

    def energy(factor):
        faster = {s: factor * x if s in mechanism.qd else x for s, x in at.items()}
        return complex(sp.sympify(term.energy).xreplace(faster).evalf())

    once = energy(1.0)
    if not np.allclose([energy(2.0), energy(-3.0)], [4 * once, 9 * once], rtol=1e-9, atol=1e-12):
        raise ValueError(f"{where}: {term.name!r} of K is not quadratic in the velocities")


def refuse_bad_drawing(where: str, mechanism: Mechanism) -> None:
    """For `points` and `draws` that fail, or give no places and no shapes."""
    rng = np.random.default_rng(0)
    try:
        points = np.array(
            mechanism.points(mechanism.placed(rng), mechanism.drawn(rng)), dtype=float
        )
    except Exception as error:  # whatever the author's function raises
        raise ValueError(f"{where}: points raised {type(error).__name__}: {error}") from error
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"{where}: points gave {points.shape}, needs one (x, y) for each point")
    if mechanism.draws is None:
        return
    try:
        drawn = list(mechanism.draws(mechanism.placed(rng), mechanism.drawn(rng)))
    except Exception as error:
        raise ValueError(f"{where}: draws raised {type(error).__name__}: {error}") from error
    if not drawn or not all(isinstance(shape, SHAPES) for shape in drawn):
        kinds = ", ".join(kind.__name__ for kind in SHAPES)
        raise ValueError(f"{where}: draws gave {drawn}, needs a list of {kinds}")


def sentences_of(where: str, sentences: object) -> tuple[tuple[str, str], ...]:
    """A teacher's sentences as pairs, so that a mechanism stays hashable."""
    given = list(sentences.items()) if isinstance(sentences, Mapping) else sentences
    if not isinstance(given, list | tuple) or not all(
        isinstance(pair, tuple) and len(pair) == 2 and all(isinstance(text, str) for text in pair)
        for pair in given
    ):
        raise ValueError(
            f"{where}: sentences needs a dict of texts, as "
            f'{{"M: dropped / the spring": "What else …?"}}; it is {sentences!r}'
        )
    for mistake, _ in given:
        if ": " not in mistake:
            raise ValueError(
                f'{where}: the sentence for {mistake!r} does not say of which answer; write "M: '
                f"{mistake}\" or another answer's name"
            )
    return tuple(given)


def further_of(where: str, further: object) -> dict[str, str]:
    """What a card says after a right answer, by answer."""
    if not isinstance(further, Mapping) or not all(
        _is_line(said) for pair in further.items() for said in pair
    ):
        raise ValueError(
            f"{where}: further needs a dict of texts of one line, as "
            f'{{"M": "M is the same at every x, since …"}}; it is {further!r}'
        )
    return dict(further)


def sections_of(where: str, sections: object) -> dict[str, tuple[str, str, str]]:
    """The section of a lesson by answer: the lesson's name, the id of a cell, the heading."""
    if not isinstance(sections, Mapping) or not all(
        _is_line(answer) and isinstance(at, tuple) and len(at) == 3 and all(map(_is_line, at))
        for answer, at in sections.items()
    ):
        raise ValueError(
            f"{where}: sections needs a dict of (lesson, id of a cell, heading), as "
            '{"M": ("03-inertia-matrix", "03-arm", "2 · From the bodies to the arm")}; it is '
            f"{sections!r}"
        )
    for lesson, _, _ in sections.values():
        if not re.fullmatch(r"[\w-]+", lesson):
            raise ValueError(
                f"{where}: sections has the lesson {lesson!r}; write the name of its notebook "
                'without folder and ending, as "03-inertia-matrix"'
            )
    return dict(sections)


def _is_line(text: object) -> bool:
    return isinstance(text, str) and bool(text.strip()) and "\n" not in text
