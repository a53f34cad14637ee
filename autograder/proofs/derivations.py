"""The derivations that the problems ask for, and the usual false proofs of each."""

from autograder.proofs import energy, inertia
from autograder.proofs.derivation import Derivation, FalseStep, Form, Misuse, Row
from autograder.proofs.energy import FREE, WITH_FRICTION
from autograder.proofs.false_energy import ENERGY_IS_NOT_ENOUGH, K_WITHOUT_HALF, OF_C, of_energy
from autograder.proofs.inertia import ARM
from autograder.proofs.pendulum import PENDULUM
from autograder.proofs.weights import WEIGHTS

_MILESTONE_1 = "qd' M qdd + 1/2 qd' Mdot qd + qd' g"
_MILESTONE_2 = "qd' u + 1/2 qd' (Mdot - 2 C) qd"
_ONE_MATRIX = Form(
    (("Mdot - 2 C",),),
    "what is left between qd' and qd when the equation of motion is put in, collected in one matrix "
    "(row 2 of the table)",
)
_ENERGY_OF_EACH_LINK = Form(
    (("v1' I1 v1", "v2' I2 v2"), ("qd' J1' I1 J1 qd", "qd' J2' I2 J2 qd")),
    "a line in which qd' M qd is a sum of numbers, each of which is the energy of a link but for a "
    "factor",
)
_BEHIND_QD = Form(
    (("m1 J1' g0 + m2 J2' g0",),),
    "a line with qd' in front, and all the rest in one bracket behind it",
)

P1_SYMMETRY = Derivation(
    id="p1-symmetry",
    cell="p1-proof",
    subject=ARM,
    start="M'",
    goal="M",
    goal_said="that the transpose of M is M",
    rows=(Row(1, 1),),
    hints=(
        "Begin with the transpose of M. What is M made of?",
        "A product is transposed factor by factor, in the reverse order. No fact about the arm "
        "is used in that: the reason is algebra.",
        "Which property of the link inertias makes the transposed sum the old one? The last line "
        "is M again, for the same reason as the first.",
    ),
    to_prove=(inertia.SYMMETRY, inertia.DEFINITE),
)
P1_POSITIVE = Derivation(
    id="p1-positive",
    cell="p1-proof",
    subject=ARM,
    start="qd' M qd",
    goal="0",
    goal_said="that qd' M qd is above zero, of an arm in which no motion is without energy",
    relation=">",
    rows=(Row(2, 1, form=_ENERGY_OF_EACH_LINK),),
    hints=(
        "Begin with qd' M qd. It is a number, and an energy: of which bodies?",
        "Put in M from the links, and group the factors so that the velocity of each link "
        "appears. To group is algebra.",
        "When every term is an energy of a link, the last line is a comparison, > 0. It takes "
        "two facts: one says that no term is negative, the other that they do not all vanish.",
    ),
    to_prove=(inertia.DEFINITE,),
    misused=(
        Misuse(
            inertia.DETERMINANT,
            "A determinant above zero does not make a matrix positive definite: two negative "
            "eigenvalues have a positive product. What is qd' M qd the energy of?",
            (">", ">="),
        ),
        Misuse(
            inertia.DIAGONAL,
            "A diagonal above zero does not make a matrix positive definite: it only tells of "
            "motions of one joint alone. What is qd' M qd the energy of?",
            (">", ">="),
        ),
        Misuse(
            inertia.SYMMETRY,
            "A symmetric matrix can have eigenvalues of either sign, so symmetry does not give "
            "this. What is qd' M qd the energy of?",
            (">", ">="),
        ),
        Misuse(
            inertia.SEMIDEFINITE,
            "A link may move without energy: a point mass that turns about itself does. So this "
            "gives no more than ≥. What keeps the energies from vanishing all at once?",
            (">",),
            gives=">=",
        ),
    ),
    mistakes=(K_WITHOUT_HALF,),
)
P2_ENERGY = Derivation(
    id="p2-E",
    cell="p2-proof",
    subject=FREE,
    start="Edot",
    goal="qd' u",
    goal_said="that the rate of E is the power of the motors",
    rows=(
        Row(1, 1, _MILESTONE_1),
        Row(2, 1, _MILESTONE_2, "for which matrices C it holds", _ONE_MATRIX),
    ),
    hints=(
        "Begin with Edot. Put in what E is, then what K is, and differentiate the product.",
        "Two of the terms of d/dt (1/2 qd' M qd) hold qdd. They are each other's transposes, so "
        "one property of M makes them equal.",
        "Where qdd is left, it stands behind M. The equation of motion says what M qdd is. Then "
        "collect what stands between qd' and qd: which matrix is it, and what is known of it?",
    ),
    to_prove=(energy.BALANCE,),
    mistakes=of_energy(),
)
P2_SKEW = Derivation(
    id="p2-skew",
    cell="p2-proof",
    subject=FREE,
    start="(Mdot - 2 C) + (Mdot - 2 C)'",
    goal="0",
    goal_said="that Mdot - 2 C and its transpose add up to zero",
    least_lines=2,
    rows=(Row(4, 1),),
    hints=(
        "A matrix is skew-symmetric if it and its transpose add up to zero. Begin with this sum "
        "for Mdot - 2 C.",
        "What is C made of? W has the slopes of M q̇ as its columns. In it and its transpose you "
        "find two of the three slopes of a Christoffel symbol; the third gives Mdot.",
        "What is left of Mdot - 2 C when C is put in? Transpose it term by term: what becomes of "
        "it?",
    ),
    to_prove=(energy.SKEW,),
    misused=(Misuse(energy.BALANCE, ENERGY_IS_NOT_ENOUGH),),
    mistakes=OF_C,
)
P3_LAGRANGE = Derivation(
    id="p3-L",
    cell="p3-derivation",
    subject=PENDULUM,
    start="u",
    goal="I qdd + m g lc sin(q)",
    goal_said="what u is, without L, K, P and derivatives",
    rows=(Row(3, 1),),
    hints=(
        "Begin with u, and say what it is in terms of L. Write d/dqd(...) and d/dq(...) for the "
        "partial derivatives, d/dt(...) for the one in time.",
        "Put in K and P, each with its reason, before you differentiate.",
        "First the partial derivatives: which part of L holds q̇, which holds q? Then the "
        "derivative in time.",
    ),
    mistakes=(
        FalseStep(
            "L = K + P",
            "This step adds K and P in L. That sum is the energy; what is the Lagrangian?",
            (("L", "K + P"),),
        ),
        FalseStep(
            "from upright",
            "This P is largest where the body hangs. From where is q measured?",
            (("P", "m g lc (1 + cos(q))"),),
        ),
        FalseStep(
            "sine for the height",
            "This step takes the height of the centre of mass to go with the sine of q. Where is "
            "the body at q = 0, and which way does it leave?",
            (("P", "m g lc sin(q)"),),
        ),
        FalseStep(
            "inertia about the centre of mass",
            "This K adds the motion of the centre of mass once more. About which point is I?",
            (("K", "1/2 I qd^2 + 1/2 m lc^2 qd^2"),),
        ),
        FalseStep(
            "point mass",
            "This K is that of a mass in one point. What does I hold beside it?",
            (("K", "1/2 m lc^2 qd^2"),),
        ),
        FalseStep(
            "K without its half",
            "Look at the factor of the kinetic energy in this step.",
            (("K", "I qd^2"),),
        ),
        FalseStep(
            "P with the sign of K",
            "In this step the slope of P has the wrong sign. Which two signs meet there?",
            (("u", "d/dt(d/dqd(L)) + d/dq(L)"),),
        ),
        FalseStep(
            "derivatives exchanged",
            "Which of the two derivatives of L is differentiated in time: the one by the angle, or the "
            "one by the velocity?",
            (("u", "d/dt(d/dq(L)) - d/dqd(L)"),),
        ),
        FalseStep(
            "no derivative in time",
            "The derivative in time is missing: what is the unit of each side?",
            (("u", "d/dqd(L) - d/dq(L)"),),
        ),
    ),
)
P4_WEIGHT = Derivation(
    id="p4-P",
    cell="p4-check",
    subject=WEIGHTS,
    start="qd' g",
    goal="qd' (-m1 J1' g0 - m2 J2' g0)",
    goal_said="what stands behind qd', in terms of the masses, their Jacobians and g0 alone",
    rows=(Row(3, 1, left="the sign, explained from the work of the weight", form=_BEHIND_QD),),
    hints=(
        "Begin with qd' g: a power. What is g of P, and what does the chain rule make of its "
        "product with qd?",
        "You have the rate of P. Put in what P is: masses, places, and g0, which points down. "
        "Then differentiate.",
        "The velocities come from qd by the Jacobians. At the end every term is a number, so it "
        "equals its transpose: bring qd' to the front.",
    ),
    mistakes=(
        FalseStep(
            "sign of P",
            "This step lets P grow along g0. Which way does g0 point, and does a weight gain or "
            "lose potential energy on that way?",
            (("P", "m1 g0' p1 + m2 g0' p2"),),
        ),
        FalseStep(
            "one mass for both",
            "This step gives both links the same mass.",
            (("m2", "m1"),),
        ),
        FalseStep(
            "g reversed",
            "In this step g has the wrong sign. Is it the torque of the weights, or what holds "
            "them?",
            (("g", "-dPdq"),),
        ),
        FalseStep(
            "links of one Jacobian",
            "This step gives both links the same Jacobian.",
            (("J2", "J1"),),
        ),
    ),
)
P5_ENERGY = Derivation(
    id="p5-E",
    cell="p5-discussion",
    subject=WITH_FRICTION,
    start="Edot",
    goal="qd' (u - f)",
    goal_said="that the rate of E is the power of u - f",
    rows=(Row(2, 1, left="that the drift therefore comes from the method"),),
    hints=(
        "Begin with Edot. Put in what E is, then what K is, and differentiate the product.",
        "Two of the terms of d/dt (1/2 qd' M qd) hold qdd. One property of M makes them equal.",
        "Put in the equation of motion, with friction. Then collect what stands between qd' and "
        "qd.",
    ),
    to_prove=(energy.BALANCE,),
    mistakes=(
        FalseStep(
            "friction lost",
            "This step has no friction in the equation of motion. Which torque is missing?",
            (("u", "M qdd + C qd + g"),),
        ),
        FalseStep(
            "friction reversed",
            "In this step friction puts power in. On which side of the equation of motion does f "
            "stand?",
            (("u", "M qdd + C qd + g - f"),),
        ),
        *of_energy(" + f"),
    ),
)
DERIVATIONS = {
    derivation.id: derivation
    for derivation in (
        P1_SYMMETRY,
        P1_POSITIVE,
        P2_ENERGY,
        P2_SKEW,
        P3_LAGRANGE,
        P4_WEIGHT,
        P5_ENERGY,
    )
}
