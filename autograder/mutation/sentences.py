"""What a student reads of a mistake: one sentence for each operator and each step.

A sentence says where to look and names the term, the entry and the joint. It never holds a formula.
Where a teacher has written a better one for a place (ROWS), that one is said.
"""

import fnmatch
import re
from dataclasses import dataclass, replace

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS, Answer
from autograder.mutation.inertial_parameters import inertial_parameters
from autograder.mutation.mutant import Mutant

PLURALS = {"m": "lengths", "kg": "masses", "kg·m²": "inertias"}
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
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Is L the sum of K and P, or which of them less the other?",
        "lagrangian",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Is it positive or negative when the energy grows?",
        "energy_drift",
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
    "length left out": "In your {where}, {instead_of} is missing from a sum in {term}. Which lengths "
    "add up there?",
    "squared part by part": "In your {where}, you squared {put} one by one in {term}. What does the "
    "square of a sum hold besides the squares of its parts?",
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
    "wrong velocity": "In your {where}, {term} has the velocity {put} where {instead_of} belongs. Which "
    "joint's motion makes it?",
    "absolute angle": "In your {where}, {term} takes {put} to be measured from the same line as "
    "{instead_of}. From where is {put} measured here?",
    "relative angle": "In your {where}, {term} takes {put} to be measured from the link that "
    "{instead_of} turns. From where is {put} measured here?",
    "parallel axis added": "In your {where}, {term} has more than {instead_of}: you applied the "
    "parallel-axis theorem with {put}. About which point is {instead_of} taken, and what moves that "
    "point?",
    "parallel axis taken off": "In your {where}, {term} has less than {instead_of}. About which point "
    "is {instead_of} taken, and about which does the body turn?",
    "point mass": "In your {where}, {term} is that of a point mass. The body has a size: which "
    "parameter tells how its mass is spread?",
    "mass for inertia": "In your {where}, {term} has the mass {put} where an inertia belongs. The "
    "coordinate is an angle: what resists an angular acceleration?",
    "kind left out": "In your {where}, the {all_of_them} do not appear in {term}. Do its units come out "
    "{right}?",
    "astray": "In your {where}, {term} appears, as it does in {put}. Does it belong there too?",
    "moved": "In your {where} stands {term}, and in {put} it is missing. Which coordinate moves it?",
    "product dropped": "In {where} of your C q̇, the product of velocities {put} is missing. Which "
    "derivatives of M does it come with?",
    "product of the wrong sign": "In {where} of your C q̇, the product of velocities {put} has the "
    "wrong sign. Which derivatives of M does it come with?",
    "product halved": "In {where} of your C q̇, the product of velocities {put} is half of what it "
    "should be. In how many places of the sum over j and k does it appear?",
    "product doubled": "In {where} of your C q̇, the product of velocities {put} counts twice. In how "
    "many places of the sum over j and k does it appear?",
    "velocity dropped": "In your {where}, the part with the velocity {put} is missing. Which "
    "derivatives of M does it come with?",
    "velocity of the wrong sign": "In your {where}, the part with the velocity {put} has the wrong "
    "sign. Which derivatives of M does it come with?",
    "velocity halved": "In your {where}, the part with the velocity {put} is half of what it should be. "
    "Which derivatives of M does it come with?",
    "velocity doubled": "In your {where}, the part with the velocity {put} counts twice. Which "
    "derivatives of M does it come with?",
    "lower triangle alone": "Your {where} is 0 above its diagonal. Which property do inertia "
    "matrices have?",
    "sign below the diagonal": "In your {where}, what is below the diagonal has the wrong sign. Which "
    "property do inertia matrices have?",
    "mixed terms not shared": "What is beside the diagonal of your {where} is twice what it should be. "
    "Multiply q̇ᵀ M q̇ out: how often does each mixed product appear?",
    "mixed terms in one triangle": "The energy of your {where} is right, but the mixed terms are in one "
    "triangle of it. How must two entries share them for {where} to be symmetric?",
    "velocities exchanged": "You swapped the velocities in your {where}. Which velocity goes with the "
    "derivative by which coordinate?",
    "sum of the velocities": "You multiply each derivative of M by the sum of the velocities. In the "
    "chain rule, which velocity goes with which derivative?",
    "chain rule forgotten": "Your {where} holds derivatives by the coordinates, and no velocity. It is "
    "a derivative with respect to time: what does the chain rule add?",
    "C": "You return C. It is made of the same derivatives as Ṁ, but M is symmetric: can its derivative "
    "be anything else?",
    "twice C": "You return 2C. It does the same work as Ṁ, but the two matrices differ: compare them "
    "entry by entry.",
    "constants differentiated": "You multiply M by a velocity, where its derivative belongs. What is "
    "the derivative of the constant parts of M?",
    "product with the velocities": "You multiply the entries of M by the velocities. How fast does each "
    "entry change?",
    "torque for C": "You return the vector C q̇, or a matrix made of it. Which square matrix gives this "
    "vector when you multiply it by q̇?",
    "C times ones": "You return C times a vector of ones, which sums its rows. Which matrix is asked "
    "for?",
    "second derivative twice": "Your C gives the right C q̇, but it is not the Christoffel form: one of "
    "the two derivatives with a plus counts twice, and the other is not there.",
    "products in the later column": "Your C gives the right C q̇, but it is not the Christoffel form: "
    "each product of two velocities stands in one column. How do the entries of a row share it?",
    "products in the earlier column": "Your C gives the right C q̇, but it is not the Christoffel "
    "form: each product of two velocities stands in one column. How do the entries of a row share it?",
    "second kind": "Your Christoffel symbols are of the second kind: you multiplied them by the inverse "
    "of M. Does that inverse have a place in the equation of motion as it is written here?",
    "gravity for C": "You return what gravity and springs do. It does not depend on q̇: where does it "
    "belong in the equation of motion?",
    "momentum for C": "You return the momentum M q̇. C comes from how M changes with q.",
    "energy for its derivative": "You return the potential energy. What turns P(q) into g(q)?",
    "energy for L": "You return the energy. Is L the sum of K and P, or their difference?",
    "L for the energy": "Your {where} has P with the wrong sign. Is E the sum of K and P, and does "
    "your P grow as a body rises or a spring is stretched?",
    "½ of K missing": "The kinetic energy in your {where} is twice the right one. Which factor belongs "
    "in front of a kinetic energy?",
    "½ of K twice": "The kinetic energy in your {where} is half of the right one. Is there a ½ too "
    "many?",
    "K missing": "The kinetic energy is missing from your {where}. What does the mechanism gain as it "
    "moves faster?",
    "P missing": "The potential energy is missing from your {where}. What does the mechanism gain as "
    "bodies rise or springs are stretched?",
    "diagonal of M alone": "Your kinetic energy uses only the diagonal of M. What does the energy gain "
    "when several joints move at once?",
    "M of the start": "Your kinetic energy uses the M of the first state in every row. What does M "
    "depend on?",
    "C in the energy": "There is a term with C in your energy. Which two energies does the mechanism "
    "have?",
    "C for M": "You make the kinetic energy with C. Which matrix gives the kinetic energy?",
    "torque times coordinate": "Your P is a torque or force times the coordinate. One that changes on "
    "the way must be summed along it: how high are the bodies, how far are springs stretched?",
    "from the row before": "You return the change from each row to the next. From which state do you "
    "count the drift?",
    "size of the drift": "You return the size of the drift without its sign. Does the motion gain "
    "energy or lose it?",
    "energy for its drift": "You return the energy itself. By how much has it changed since the first "
    "row?",
    "from the mean": "You subtract the mean of the energy. From which state do you count the drift?",
    "from the end": "You subtract the energy of the last row. From which state do you count the drift?",
    "share for the drift": "You divide by the energy at the start. That ratio depends on where P is "
    "zero, but the drift in J does not.",
    "columns in another order": "Your columns are right, but they stand in another order than the "
    "parameters. Write the names of the parameters above your columns.",
    "parameters inside": "Your columns hold the parameters that they belong to. Y may hold only what is "
    "known: what multiplies it?",
    "halves of ẋ swapped": "You swapped the two halves of ẋ. Which half of x is q, and which half of ẋ "
    "is its rate of change?",
    "q for its rate": "The first half of your ẋ is q itself. What is the rate of change of q, and where "
    "in x does it stand?",
    "state read as q̇ and q": "Your accelerations come out as if x were [q̇; q]. Which half of x do you "
    "call q?",
    "state interleaved": "You read x as if each velocity stood beside its coordinate. In which order "
    "are the entries of x?",
    "states interleaved": "You read x, and write ẋ, as if each velocity stood beside its coordinate. "
    "In which order are the entries of x?",
    "M not inverted": "You multiply by M. In M q̈ = …, how do you get q̈ alone?",
    "torque for acceleration": "The second half of your ẋ is a torque or force. What resists it?",
    "divided by the diagonal of M": "You divide by the diagonal of M, as if the joints did not feel "
    "each other. What do the other entries do?",
    "entries of M inverted": "You invert each entry of M by itself, which does not invert the matrix. "
    "Which NumPy function solves a linear system?",
    "divided by M entry by entry": "You divide by M entry by entry. Which NumPy function solves a "
    "linear system?",
    "C times ones in the torque": "Your Coriolis torque is the sum of each row of C. What must C "
    "multiply?",
    "not divided by M": "You do not divide {term} by M, as you do the rest. Is it an acceleration, or "
    "what makes one?",
    "quadratic friction": "In your {where}, {term} grows with the square of the speed. Look at the unit "
    "of its coefficient.",
    "friction in one direction": "In your {where}, {term} always acts in the same direction. What "
    "decides the direction of friction?",
    "absolute value for sign": "In your {where}, {term} has the size of the velocity where its sign "
    "belongs: it grows with the speed and never changes direction.",
    "velocity for its sign": "In your {where}, {term} grows with the speed. Dry friction does not "
    "depend on how fast a joint moves: what does it depend on?",
    "sign of the coordinate": "In your {where}, {term} has the sign of the coordinate. Does friction "
    "depend on where a joint is, or on how it moves?",
    "smooth sign": "In your {where}, {term} fades out at low speed, as a tanh does. In this model it "
    "jumps: how large is dry friction at 0.001 rad/s?",
    "friction at rest": "In your {where}, {term} is not zero in a joint at rest. In which direction "
    "would it push there? What does NumPy's own sign give for 0?",
    "coefficients exchanged": "You swapped the two coefficients of {term}. Which of them is a torque or "
    "force by itself, and which must be multiplied by a velocity?",
    "divided by M": "You return an acceleration: you divided by the inertia already. In the equation "
    "of motion, what does M multiply?",
}

# Of a mistake that is made in all terms alike.
THROUGHOUT = {
    "absolute angle": "Your {where} is right for an angle {put} that is measured from the same line as "
    "{instead_of}. From where is {put} measured here?",
    "relative angle": "Your {where} is right for an angle {put} that is measured from the link that "
    "{instead_of} turns. From where is {put} measured here?",
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
    "length left out": "In your {where}, {instead_of} is missing from a sum. Which lengths add up "
    "there?",
    "squared part by part": "In your {where}, you squared {put} one by one. What does the square of a "
    "sum hold besides the squares of its parts?",
    "wave lost": "Your {where} does not change with the angle {instead_of}. Should it?",
    "wrong velocity": "Your {where} has the velocity {put} where {instead_of} belongs. Which joint's "
    "motion makes it?",
    "parallel axis added": "Your {where} has more than {instead_of}: you applied the parallel-axis "
    "theorem with {put}. About which point is {instead_of} taken?",
    "parallel axis taken off": "Your {where} has less than {instead_of}. About which point is "
    "{instead_of} taken, and about which does the body turn?",
    "point mass": "Your {where} is that of a point mass in place of {instead_of}. The body has a size: "
    "which parameter tells how its mass is spread?",
    "mass for inertia": "Your {where} has the mass {put} where an inertia belongs. What resists an "
    "angular acceleration?",
    "kind left out": "The {all_of_them} are missing from your {where}. Do its units come out {right}?",
    "astray": "In your {where} stands what belongs in {put}. Does it belong there too?",
    "moved": "In your {where} stands what belongs in {put}, where it is missing. Which coordinate moves "
    "what?",
    "parameter left out": "Your {where} lacks {instead_of}. Do its units come out {right}?",
    "small angle": "Your {where} is right for small angles only. The joints turn all the way round.",
    "radians converted": "You convert the angles to radians. They are in radians already.",
    "angle in degrees": "You convert the angles to degrees. np.sin and np.cos take radians.",
}

# What an answer follows from, where the mistake was made there.
DERIVED = {"g_vec": "the derivative of a wrong P"}
ENERGIES = {"g_vec": "P"}

# Of an answer, what is wrong with it where one of its parts is.
FOLLOWS = {
    "C": {"M": "Your C looks like the Christoffel matrix of a wrong M."},
    "M_dot": {"M": "Your Ṁ looks like the rate of a wrong M."},
    "f": {
        "M": "Your accelerations look like those of a wrong M.",
        "C": "Your accelerations look like those of a wrong C.",
        "g_vec": "Your accelerations look like those of a wrong g.",
        "M and C": "Your accelerations look like those of another arm: M is wrong, and C with it.",
    },
    "regressor": {
        "M": "Your Y looks like one of a wrong M.",
        "C": "Your Y looks like one of a wrong C.",
        "g_vec": "Your Y looks like one of a wrong g.",
        "M and C": "Your Y looks like one of another arm: M is wrong, and C with it.",
    },
}


def sentence(mutant: Mutant, mechanism: Mechanism, answer: Answer) -> str:
    """What to say of a mistake: a teacher's row, the most specific first, or the operator's sentence."""
    head = answer.head
    turning = all(c.unit == "rad" for c in mechanism.coordinates)
    docs = {p.name: p for p in mechanism.parameters}
    put = docs.get(mutant.put)
    words = {
        "where": mutant.entry or head,
        "term": mutant.term,
        "put": mutant.put,
        "instead_of": mutant.instead_of,
        "all_of_them": PLURALS.get(mutant.instead_of, "parameters"),
        "put_doc": put.doc if put else "",
        "kind": KINDS.get(put.unit, "parameter") if put else "parameter",
        "right": f"as {answer.unit}" if turning else "right",
        "arm": answer.arguments[-1],
    }
    if re.fullmatch(r"pi\d+", mutant.put):  # a mistake among the columns of a regressor
        entries = inertial_parameters(mechanism)
        for name in ("put", "instead_of"):
            if match := re.fullmatch(r"pi(\d+)", words[name]):
                words[name] = entries[int(match[1]) - 1].words
        words |= {"put_doc": "an entry of π", "kind": "entry"}
    rows = [row for row in ROWS if _fits(row, mutant, mechanism, answer)]
    if mutant.source and not any(row.answer == answer.name for row in rows):
        return f"{FOLLOWS[answer.name][mutant.source]} {_of_source(mutant, mechanism)}"
    rows.sort(
        key=lambda row: -sum(len(p.replace("*", "")) for p in (row.term, row.entry, row.mechanism))
    )
    general = GENERAL if mutant.term else GENERAL | THROUGHOUT
    template = rows[0].sentence if rows else general[mutant.operator]
    if not put:  # a combination of parameters has a name alone
        template = template.replace(" ({put_doc})", "")
    # On a slope a direction is an angle and a constant, of which only the angle is a student's.
    words["instead_of"] = words["instead_of"].partition(" + pi")[0].partition(" - pi")[0]
    if mutant.in_energy and answer.name in DERIVED:
        words["where"], source = ENERGIES[answer.name], DERIVED[answer.name]
        said = template.format(**words)
        # It is the student's answer, but not the student's P.
        said = said.replace(f"In your {words['where']}", f"In this {words['where']}")
        said = said.replace(f"Your {words['where']}", f"This {words['where']}")
        return f"Your {head} looks like {source}. {said}"
    return template.format(**words)


def _of_source(mutant: Mutant, mechanism: Mechanism) -> str:
    """What is said of the answer in which the mistake was made, of which only this one shows."""
    said = sentence(replace(mutant, source=""), mechanism, ANSWERS[mutant.source.partition(" ")[0]])
    return (
        said.replace("Your ", "This ", 1).replace("your ", "this ", 1)
        if said.startswith(("Your ", "In your "))
        else said.replace("You return ", "You use ", 1)
    )


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
