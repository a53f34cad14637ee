"""What a student reads of a mistake: one sentence for each operator and each step.

A sentence says where to look and names the term, the entry and the joint. It never holds a formula.
Where a teacher has written a better one for a place (ROWS), that one is said.
"""

import fnmatch
from dataclasses import dataclass

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import Answer
from autograder.mutation.catalogue import Mutant

KINDS = {
    "m": "length",
    "kg": "mass",
    "kg·m²": "inertia",
    "N/m": "stiffness",
    "N·m/rad": "stiffness",
}


@dataclass(frozen=True)
class Row:
    """A sentence of a teacher's for an operator, where the place fits the patterns (`*` for any)."""

    operator: str
    sentence: str
    answer: str = "*"
    mechanism: str = "*"
    term: str = "*"
    entry: str = "*"


ROWS = (
    Row(
        "dropped",
        "Your {where} has everything but {term}. Hold joint 2 and move joint 1: which of the two "
        "links turn?",
        "M",
        "planar-2r*",
        "the rotation of link 2",
        "M11",
    ),
    Row(
        "dropped",
        "Your {where} has everything but {term}. In which products of two velocities does "
        "its energy appear?",
        "M",
        entry="M*",
    ),
    Row(
        "half of the whole",
        "Your {where} is half of the right one. There is a ½ in K = ½ q̇ᵀ M q̇: is it a part of M?",
        "M",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Can a kinetic energy be negative?",
        "M",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Does it rise when a body is lifted or a spring stretched?",
        "potential_energy",
    ),
)

GENERAL = {
    "dropped": "Your {where} has everything but {term}.",
    "wrong sign": "In your {where}, {term} has the wrong sign.",
    "doubled": "Your {where} counts {term} twice.",
    "halved": "In your {where}, {term} is half of what it should be.",
    "wrong parameter": "In your {where}, {term} uses {put} ({put_doc}). Which {kind} belongs there?",
    "parameters exchanged": "In your {where}, you swapped {put} and {instead_of} in {term}. Which "
    "is which?",
    "wrong angle": "In your {where}, {term} takes {put} for its angle. What does each angle measure, "
    "and from where?",
    "sine for cosine": "In your {where}, {term} has a sine where a cosine belongs. What is the sine of "
    "0, and what should this term be there?",
    "cosine for sine": "In your {where}, {term} has a cosine where a sine belongs. What is the sine of "
    "0, and what should this term be there?",
    "velocity left out": "In your {where}, {term} depends on {put} alone. Which joints move it?",
    "square lost": "In your {where}, the units of {term} do not come out {right}. Look at the power of "
    "{put}.",
    "wave lost": "In your {where}, {term} does not change with the angle. Should it?",
    "parameter added": "In your {where}, {term} has {put} beside {instead_of}. Does {put} "
    "({put_doc}) have a part in it?",
    "parameter left out": "In your {where}, {instead_of} does not appear in {term}. Do its units "
    "come out {right}?",
    "gravity of Earth": "Your {where} is right only on Earth: you typed 9.81 into it. Which "
    "parameter of {arm} gives the gravitational acceleration?",
    "small angle": "In your {where}, {term} is right for small angles only. The joint turns all the "
    "way round.",
    "radians converted": "In your {where}, you convert the angle in {term} to radians. It is in "
    "radians already.",
    "angle in degrees": "In your {where}, you convert the angle in {term} to degrees. np.sin and "
    "np.cos take radians.",
    "half of the whole": "Your {where} is half of the right one. Is there a ½ too many?",
    "twice the whole": "Your {where} is twice the right one. Is a ½ missing?",
    "sign of the whole": "Your {where} has the wrong sign. On which side of the equation of motion "
    "does it stand?",
    "inverse": "Your {where} is the inverse of the right matrix. Which of the two stands in the "
    "kinetic energy?",
    "diagonal alone": "Your {where} is diagonal. Do the joints not feel each other's accelerations?",
    "upper triangle alone": "Your {where} is 0 below its diagonal. Which property do inertia "
    "matrices have?",
    "transposed": "You return the transpose of C. Which index of h_ijk numbers the row?",
    "rate of M": "You return Ṁ, which is only one part of what the Euler–Lagrange equation gives. What "
    "comes from the derivative of the kinetic energy with respect to q?",
    "half the rate of M": "You return half of Ṁ. It makes Ṁ − 2C zero, but does it give the right "
    "C q̇?",
    "rate of M less 2C": "You return Ṁ − 2C. Which matrix is asked for?",
    "M": "You return M, which multiplies q̈. C multiplies q̇.",
    "zero": "Your {where} is 0. What do you differentiate, and with respect to what?",
    "last derivative missing": "Your C leaves out −∂K/∂q and holds only the terms from d/dt(∂K/∂q̇). "
    "Where else in the Euler–Lagrange equation is M(q) differentiated?",
    "sign of the last derivative": "The last of the three derivatives in your Christoffel symbol has "
    "the wrong sign. It comes from −∂K/∂q: what sign does that give it?",
    "last derivative not halved": "The last of the three derivatives in your Christoffel symbol counts "
    "twice. The kinetic energy has a ½.",
    "second derivative missing": "One of the two derivatives with a plus is missing from your "
    "Christoffel symbol. How do the velocities j and k share ∂M_ij/∂q_k?",
    "first derivative missing": "Your Christoffel symbol leaves out the derivative of M_ij itself.",
    "not symmetrised": "Your C gives the right C q̇, but it is not the Christoffel form: you left the "
    "derivative of M_ij as it came, and did not share it between the velocities j and k.",
    "summed over the first index": "You sum the Christoffel symbols over the wrong index. Which index "
    "is left free for the row, and which goes with q̇_k?",
    "no velocity": "Your sum over k has no velocity in it. What must multiply each h_ijk?",
    "velocity of the column": "You multiply h_ijk by the velocity of its column. Over which index does "
    "the sum run?",
    "velocity of the row": "You multiply h_ijk by the velocity of its row. Over which index does the "
    "sum run?",
    "joints exchanged": "Your {where} has the entries of the joints in the wrong order.",
}

# Of a mistake that is made in all terms alike.
THROUGHOUT = {
    "wrong parameter": "Your {where} uses {put} ({put_doc}) where another {kind} belongs. Which one?",
    "parameters exchanged": "In your {where}, you swapped {put} and {instead_of}. Which is which?",
    "wrong angle": "Your {where} takes {put} for an angle throughout. What does each angle measure, and "
    "from where?",
    "sine for cosine": "Your {where} has sines where cosines belong. What is the sine of 0, and what "
    "should your answer be there?",
    "cosine for sine": "Your {where} has cosines where sines belong. What is the sine of 0, and what "
    "should your answer be there?",
    "parameter added": "Your {where} has {put} beside {instead_of}. Does {put} ({put_doc}) have a part "
    "in it?",
    "velocity left out": "In your {where}, everything moves with {put} alone. Which joints move which "
    "body?",
    "square lost": "The units of your {where} do not come out {right}. Look at the power of {put}.",
    "wave lost": "Your {where} does not change with the angle {instead_of}. Should it?",
    "parameter left out": "Your {where} lacks {instead_of}. Do its units come out {right}?",
    "small angle": "Your {where} is right for small angles only. The joints turn all the way round.",
    "radians converted": "You convert the angles to radians. They are in radians already.",
    "angle in degrees": "You convert the angles to degrees. np.sin and np.cos take radians.",
}

# What an answer follows from, where the mistake was made there.
DERIVED = {
    "g_vec": "the derivative of a wrong P",
    "C": "the Christoffel matrix of a wrong M",
}
ENERGIES = {"g_vec": "P", "C": "M"}


def sentence(mutant: Mutant, mechanism: Mechanism, answer: Answer) -> str:
    """What to say of a mistake: a teacher's row, the most specific first, or the operator's sentence."""
    head = answer.name.removesuffix("_vec").replace("potential_energy", "P")
    turning = all(c.unit == "rad" for c in mechanism.coordinates)
    docs = {p.name: p for p in mechanism.parameters}
    put = docs.get(mutant.put)
    words = {
        "where": mutant.entry or head,
        "term": mutant.term,
        "put": mutant.put,
        "instead_of": mutant.instead_of,
        "put_doc": put.doc if put else "",
        "kind": KINDS.get(put.unit, "parameter") if put else "parameter",
        "right": f"as {answer.unit}" if turning else "right",
        "arm": answer.arguments[-1],
    }
    rows = [row for row in ROWS if _fits(row, mutant, mechanism, answer)]
    rows.sort(
        key=lambda row: -sum(len(p.replace("*", "")) for p in (row.term, row.entry, row.mechanism))
    )
    general = GENERAL if mutant.term else GENERAL | THROUGHOUT
    template = rows[0].sentence if rows else general[mutant.operator]
    if not put:  # a combination of parameters has a name alone
        template = template.replace(" ({put_doc})", "")
    # On a slope a direction is an angle and a constant, of which only the angle is a student's.
    words["instead_of"] = mutant.instead_of.partition(" + pi")[0].partition(" - pi")[0]
    if mutant.in_energy and answer.name in DERIVED:
        words["where"], source = ENERGIES[answer.name], DERIVED[answer.name]
        said = template.format(**words)
        # It is the student's answer, but not the student's P.
        said = said.replace(f"In your {words['where']}", f"In this {words['where']}")
        said = said.replace(f"Your {words['where']}", f"This {words['where']}")
        return f"Your {head} looks like {source}. {said}"
    return template.format(**words)


def _fits(row: Row, mutant: Mutant, mechanism: Mechanism, answer: Answer) -> bool:
    return row.operator == mutant.operator and all(
        fnmatch.fnmatchcase(value, pattern)
        for value, pattern in (
            (answer.name, row.answer),
            (mechanism.name, row.mechanism),
            (mutant.term, row.term),
            (mutant.entry, row.entry),
        )
    )
