"""What is said of mistakes that people make in several problems: one sentence each.

Like every sentence on a mistake: what is seen, then where to look, and never the formula.
"""

HALF_MISSING = (
    "Your kinetic energy is twice the right one. Which factor belongs in front of a kinetic energy?"
)
INVERSE_OF_M = (
    "You return the inverse of M. Which of the two, M or M⁻¹, multiplies q̈ in the equation of "
    "motion?"
)
RADIANS_CONVERTED = "You convert q from degrees to radians, but q is in radians already."
IN_DEGREES = (
    "You convert q to degrees. NumPy's sine and cosine take radians, and q is in radians already."
)
RESHAPED = (
    "You reshape the array where it must be transposed: its shape fits, but its entries are in the "
    "wrong places."
)
FIRST_LINK_LEFT_OUT = "You leave out the first link. At which index does a list begin?"
LAST_LINK_LEFT_OUT = "You leave out the last link. Where does your loop end?"
FIRST_LINK_ONLY = "Your result holds only the first link. Is your return inside the loop?"
LAST_LINK_ONLY = (
    "Your result holds only the last link. Does your loop add each link, or write over the one "
    "before?"
)
Q2_ALONE = (
    "In the gravity of link 2 you take q2 for its direction in space. From where is q2 measured?"
)
COUPLING_WITH_SINE = (
    "In your column of m2 ℓc2, the accelerations come with the sine of q2. Which function of q2 does M "
    "hold, and is it largest when the arm is stretched?"
)
