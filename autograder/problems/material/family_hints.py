"""Hints that are true of every arm of the family, where those of the book's arm are true of it alone."""

HINTS = {
    "p1-M": (
        "Start from the energy, not from the matrix. Each link has two parts: its centre of mass "
        "moves, and it turns. What is the angular velocity of each link, with your angles?",
        "Write the angle of each link from the x axis with your q1 and q2, as your table says. Then "
        "write down the position of the centre of mass of link 2, differentiate it, and square the "
        "velocity. Only the angle between the links is left in it.",
        "Sort K by q̇1², q̇1 q̇2 and q̇2². In q̇ᵀ M q̇ the first has M11, the last M22, and the mixed "
        "one M12 + M21. Remember the ½, and that M12 = M21.",
    ),
    "p2-M_dot": (
        "M changes with time only because the arm moves: M(q(t)). Which of its entries hold an angle, "
        "and which angles?",
        "The chain rule: d/dt of an entry is the sum over all joints of ∂entry/∂q_k times q̇_k. Write "
        "down which of these derivatives are zero.",
        "Call the part of M12 that holds an angle the coupling. Differentiate it with respect to each "
        "angle in it, times that angle's velocity. In which other entries does it stand, and how often? "
        "To test: (M(q + ε q̇) − M(q − ε q̇)) / (2ε) for a small ε.",
    ),
    "p2-C": (
        "Most of the derivatives ∂M_ij/∂q_k are zero. Which entries of your M hold an angle, and "
        "which angles? List the derivatives that are not zero.",
        "They all share one factor: give it a letter. Then form h_ijk for all eight i, j, k.",
        "Entry (i, j) of C is h_ij1 q̇1 + h_ij2 q̇2. Test it: C + Cᵀ must be your Ṁ, entry by entry.",
    ),
    "p2-C_other": (
        "Look at one row of C. Which other rows give the same number when they are multiplied by q̇?",
        "Add to C a matrix that sends q̇ to zero. One row of it is enough: which row (a, b) has a q̇1 + "
        "b q̇2 = 0 at every velocity?",
        "Add such a row to the first row of C. Then look at C_other + C_otherᵀ beside Ṁ: is the first "
        "entry still the same?",
    ),
    "p4-potential_energy": (
        "P of a link is its weight times the height of its centre of mass, and height counts against "
        "the pull of gravity. Draw your arm at q1 = 30°, q2 = 40° and mark both centres of mass.",
        "Link 2 begins at the elbow. Its centre of mass is as high as the elbow, and then some more. "
        "What angle does each link make with the x axis, and what angle with the pull of gravity?",
        "Write the angle of each link from the x axis with your q1 and q2, as your table says. A length "
        "rises by its sine, where the angle is taken from the line across the pull of gravity. Now add "
        "weight times height, link by link.",
    ),
    "p4-g_vec": (
        "g has one entry for each joint: the partial derivatives of your P, by q1 and by q2, each with "
        "the other angle held still.",
        "Underline q1 in your P, then q2. In which terms does each of them stand?",
        "A term of P belongs to the torque of each joint whose angle stands in it. Differentiate term "
        "by term, and test: turn one joint by a small angle, and divide the change of P by it.",
    ),
    "p4-equilibria": (
        "Begin with joint 2: when is its torque zero? Say it first in words, with the direction of link "
        "2 and the pull of gravity.",
        "With link 2 pointing so, its weight turns neither joint. What must link 1 do?",
        "Each link points along the pull of gravity or against it: two choices each. For each of the "
        "four pairs of directions write q1 and q2, each from where your table measures it.",
    ),
    "p5-energy_drift": (
        "First write a function for the energy of one state; then use it on every row.",
        "For the potential energy you need the heights of the two centres of mass, against the pull of "
        "gravity. The second one sits on the elbow. What angle does each link make with the x axis, "
        "with your q1 and q2?",
        "Put the energies into an array E of len(x) entries. The drift compares all of them with one of "
        "them. Which entry of your result is 0?",
    ),
}
