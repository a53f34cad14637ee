"""The checks of lesson 08, from symbols to fast code."""

from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("08-steps",),
    2: ("08-shorter",),
    3: ("08-carries",),
    4: ("08-calls",),
    5: ("08-drake",),
}

# a cos q · q̇, a cos q · q̈ + b sin q and b sin q: two products are shared.
STEPS = Number(
    id="08-steps",
    text="operations of the steps and the results together",
    unit="",
    right=7,
    wrong=(
        WrongNumber(
            "written out",
            11,
            "This is the count as it is written out. What do two of the three expressions share?",
        ),
        WrongNumber(
            "sine and cosine alone",
            9,
            "You shared the sine and the cosine alone. What else stands in two expressions in the "
            "same way?",
        ),
        WrongNumber(
            "one of two",
            8,
            "One operation is too many: more than you have shared stands in two of the "
            "expressions.",
        ),
        WrongNumber(
            "results alone",
            3,
            "You counted what is left in the results. The steps cost something, too.",
        ),
        WrongNumber(
            "steps alone",
            4,
            "You counted the steps. What is left in the results costs something, too.",
        ),
    ),
    otherwise=(
        "Write the steps x0, x1, … and then the three expressions in terms of them. Count each "
        "product, sum, sine and cosine once."
    ),
    further=(
        "The third expression costs nothing any more: it is one of the steps. So it is with the "
        "terms of an arm: what M has computed, C and g get as a gift."
    ),
    hints=(
        "Look for products, not only for sines: what stands in the first and in the second "
        "expression, and what in the second and in the third?",
        "Two steps are enough, each a product of a letter and a sine or cosine. How many "
        "operations are left in the three expressions?",
    ),
)

SHORTER = Choice(
    id="08-shorter",
    text="what simplify does to the program",
    options=(
        Option(
            "The program may get shorter or longer, since `simplify` sees one entry at a time and "
            "not what the entries share; and for six joints nobody has the time to find out which.",
        ),
        Option(
            "It gets shorter for sure: if each entry is as short as it can be, so is the program.",
            "This would be so if the entries shared nothing. In the pair with the sines of this "
            "section, which of the two programs is longer?",
        ),
        Option(
            "It stays as it is, since `cse` finds by itself all that `simplify` finds.",
            "Sharing multiplies nothing out and uses no identity. What did simplify make of the 70 "
            "operations of two links?",
        ),
        Option(
            "It gets less exact, since each identity that `simplify` uses adds its rounding.",
            "An identity between symbols is exact, and rounding comes with the operations that "
            "are left. How many of these are there?",
        ),
    ),
    further=(
        "Sharing pays where entries have parts in common, and a good choice of coordinates gives "
        "them more in common than any search."
    ),
    hints=(
        "How many expressions does simplify look at when it decides what is shorter?",
        "Read the second and the third of the four points of this section again, and the times in "
        "the first.",
    ),
)

# Stretched out, at rest, weightless; joint 3 alone accelerates.
L1, L2, M3, LC3, I3, SPIN = 0.6, 0.4, 2.0, 0.3, 0.05, 4.0
FORCE = M3 * LC3 * SPIN
OF_3 = I3 * SPIN + LC3 * FORCE
OF_2 = OF_3 + L2 * FORCE
CARRIES = Number(
    id="08-carries",
    text="the torque of joint 1",
    unit="N·m",
    right=OF_2 + L1 * FORCE,
    wrong=(
        WrongNumber(
            "nothing",
            0.0,
            "Links 1 and 2 stand still, but link 3 pushes back when it is accelerated. What keeps "
            "link 1 where it is?",
        ),
        WrongNumber("joint 3", OF_3, "This is the torque of joint 3. Go on, inwards."),
        WrongNumber("joint 2", OF_2, "This is the torque of joint 2. Go on, inwards."),
        WrongNumber(
            "forces alone",
            (L1 + L2 + LC3) * FORCE,
            "You took the force with its lever arm. What does it take to turn link 3 about its "
            "own centre of mass?",
        ),
        WrongNumber(
            "to joint 3 alone",
            I3 * SPIN + (L1 + L2) * FORCE,
            "Your lever arm ends at joint 3. Where is the centre of mass that accelerates?",
        ),
        WrongNumber(
            "torques not passed on",
            L1 * FORCE,
            "You passed the force on and not the torque: the first term of u_k is missing.",
        ),
        WrongNumber(
            "forces not passed on",
            OF_3 + L1 * FORCE,
            "The force goes through joint 2, too: on the way, link 2 is a lever as well.",
        ),
        WrongNumber(
            "turning link 3 alone",
            I3 * SPIN,
            "This turns link 3 about its own centre of mass. What accelerates the centre of mass "
            "itself?",
        ),
        WrongNumber(
            "for 1 rad/s²",
            (OF_2 + L1 * FORCE) / SPIN,
            "This is the torque for 1 rad/s², an entry of M.",
        ),
    ),
    otherwise=(
        "Begin at link 3: the acceleration of its centre of mass, then F3, u3 and f3. Links 1 and "
        "2 do not move, so they only pass f and u on."
    ),
    further=(
        "You have computed an entry of M, times 4 rad/s², in three steps of the same form: one a "
        "link, however long the arm is."
    ),
    hints=(
        "Outwards: only link 3 has an angular acceleration. Its centre of mass is 0.3 m from its "
        "joint. So how large is F3?",
        "Inwards: u3 has three terms, of which one is zero. For u2 and u1, F is zero, so each "
        "adds the length of a link times the force that is handed down.",
    ),
)

# Of joint 1: g, C q̇ and the second entry of a row of M, as the calls of the lesson show them.
G_1, C_1, M_12 = 12.0, -1.7, 0.6
CALLS = Number(
    id="08-calls",
    text="the torque of joint 1 at twice the velocity",
    unit="N·m",
    right=G_1 + 4 * C_1 + 3 * M_12,
    wrong=(
        WrongNumber(
            "velocity once",
            G_1 + 2 * C_1 + 3 * M_12,
            "You doubled the velocity terms. Of which degree are they in the velocity?",
        ),
        WrongNumber(
            "as it was",
            G_1 + C_1 + M_12,
            "You added the terms as they are. How do they grow with the velocity and the "
            "acceleration?",
        ),
        WrongNumber(
            "acceleration once",
            G_1 + 4 * C_1 + M_12,
            "Your velocity terms are right. The acceleration is not that of the second call.",
        ),
        WrongNumber(
            "without gravity",
            4 * C_1 + 3 * M_12,
            "You took gravity out, as you must, and then left it out.",
        ),
        WrongNumber(
            "calls added",
            4 * (G_1 + C_1) + 3 * (G_1 + M_12),
            "You scaled whole calls, and gravity with them. Which part of a call is gravity?",
        ),
        WrongNumber(
            "sum of calls",
            2 * G_1 + C_1 + M_12,
            "You added two calls as they are, so gravity is in it twice.",
        ),
        WrongNumber(
            "sign of the velocity terms",
            G_1 - 4 * C_1 + 3 * M_12,
            "Your velocity terms have the other sign. Which of the two calls is the larger one?",
        ),
    ),
    otherwise=(
        "Take the three calls apart first: what is gravity, what do the velocities add to it, "
        "what does the acceleration?"
    ),
    further=(
        "Three calls, three terms: gravity is in each of them, the inertia grows with the "
        "acceleration, and the velocity terms with the square of the velocity."
    ),
    hints=(
        "At rest and without acceleration two of the three terms of M q̈ + C q̇ + g are zero. "
        "What is left?",
        "Take that away from the other two calls. Which of the rests is proportional to the "
        "acceleration, and how does the other grow if all velocities are doubled?",
    ),
)

# What Drake gives for joint 1: the bias, and its "generalised forces" of gravity.
BIAS, FORCES = 2.5, -30.0
DRAKE = Number(
    id="08-drake",
    text="the first entry of Pinocchio's nonLinearEffects",
    unit="N·m",
    right=BIAS - FORCES,
    wrong=(
        WrongNumber(
            "as they are",
            BIAS + FORCES,
            "You added Drake's two numbers as they are. Compare the gravity column of both rows.",
        ),
        WrongNumber(
            "bias alone",
            BIAS,
            "You took the bias for the same in both. What else is in Pinocchio's?",
        ),
        WrongNumber(
            "gravity alone",
            -FORCES,
            "This is gravity alone. What else is in Pinocchio's?",
        ),
        WrongNumber(
            "difference",
            -FORCES - BIAS,
            "Gravity is right, and the velocity terms have the wrong sign. Do the two differ in "
            "these?",
        ),
        WrongNumber(
            "gravity of Drake alone",
            FORCES,
            "This is one of Drake's numbers. What does it stand for in the table?",
        ),
    ),
    otherwise="The table says what each name stands for. Write both numbers in C q̇ and g first.",
    further=(
        "Drake moves gravity to the other side of the equation, as a force that acts on the arm: "
        "hence the sign, and hence a mistake that doubles the arm's weight."
    ),
    hints=(
        "What is Drake's first number in the course's letters, and what is its second?",
        "Pinocchio's nonLinearEffects holds two terms of the equation of motion. You know both "
        "now.",
    ),
)

CHECKS = (STEPS, SHORTER, CARRIES, CALLS, DRAKE)
