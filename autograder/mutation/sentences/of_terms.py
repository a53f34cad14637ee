"""What is said of what was done to a term, by the operator: at one place, and in all terms alike."""

OTHER_WAVE = (
    "In your {where}, {term} has a sine or cosine of {put}. Which of the two belongs "
    "there, and what does each angle measure?"
)
OTHER_WAVES = (
    "Your {where} has sines or cosines of {put}. Which of the two belongs where, and what "
    "does each angle measure?"
)

AT_A_PLACE = {
    "dropped": "Your {where} lacks {term}.",
    "wrong sign": "In your {where}, {term} has the wrong sign.",
    "doubled": "Your {where} counts {term} twice.",
    "halved": "In your {where}, {term} is half of what it should be.",
    "wrong parameter": "In your {where}, {term} uses {put} ({put_doc}). Which {kind} belongs "
    "there?",
    "parameters exchanged": "In your {where}, you swapped {put} and {instead_of} in {term}. "
    "Which is which?",
    "wrong angle": "In your {where}, {term} takes {put} for its angle. What does each angle "
    "measure, and from where?",
    "sine for cosine": "In your {where}, {term} has a sine where a cosine belongs. What is the "
    "sine of 0, and what should this term be there?",
    "cosine for sine": "In your {where}, {term} has a cosine where a sine belongs. What is the "
    "sine of 0, and what should this term be there?",
    "velocity left out": "In your {where}, {term} comes from {put} alone. Which other joints "
    "have a part in it?",
    "square lost": "In your {where}, the units of {term} do not come out {right}. Look at the "
    "power of {put}.",
    "length left out": "In your {where}, {instead_of} is missing from a sum in {term}. Which lengths "
    "add up there?",
    "squared part by part": "In your {where}, you squared {put} one by one in {term}. What does the "
    "square of a sum hold besides the squares of its parts?",
    "wave lost": "In your {where}, {term} is the same at every angle {instead_of}. How does it "
    "change as the joints turn?",
    "parameter added": "In your {where}, {term} adds {put} to {instead_of}. Does {put} "
    "({put_doc}) have a part in it?",
    "parameter left out": "In your {where}, {instead_of} does not appear in {term}. Do its "
    "units come out {right}?",
    "gravity of Earth": "Your {where} is right only on Earth: you typed 9.81 into it. Which "
    "parameter gives the gravitational acceleration?",
    "small angle": "In your {where}, {term} is right for small angles only. Where did you put "
    "something simpler in place of a sine or a cosine?",
    "radians converted": "In your {where}, you convert the angle in {term} to radians. It is in "
    "radians already.",
    "angle in degrees": "In your {where}, you convert the angle in {term} to degrees. Which "
    "unit do np.sin and np.cos take?",
    "wrong velocity": "In your {where}, {term} goes with {put}, where another velocity belongs. "
    "Which joint's motion makes it?",
    "absolute angle": "In your {where}, {term} takes {put} to be measured from the same line as "
    "{instead_of}. From where is {put} measured here?",
    "relative angle": "In your {where}, {term} takes {put} to be measured from the link that "
    "{instead_of} turns. From where is {put} measured here?",
    "parallel axis added": "In your {where}, {term} has more than {instead_of}: you applied the "
    "parallel-axis theorem with {put}. About which point is {instead_of} taken, and what moves "
    "that point?",
    "parallel axis taken off": "In your {where}, {term} has less than {instead_of}. About which "
    "point is {instead_of} taken, and about which does the body turn?",
    "point mass": "In your {where}, {term} is that of a point mass. The body has a size: which "
    "parameter tells how its mass is spread?",
    "mass for inertia": "In your {where}, {term} has the mass {put} where an inertia belongs. "
    "The coordinate is an angle: what resists an angular acceleration?",
    "kind left out": "In your {where}, the {all_of_them} do not appear in {term}. Do its units "
    "come out {right}?",
    "astray": "Your {where} holds {term}, as {put} does. Does it belong there too?",
    "moved": "Your {where} holds {term}, and {put} lacks it. Which coordinate moves it?",
    "velocity not squared": "In your {where}, {term} grows with the speed itself. How does an energy "
    "of motion change if everything moves twice as fast?",
    "velocity missing": "In your {where}, {term} has one velocity, without {instead_of} beside it. "
    "How does an energy of motion change if everything moves twice as fast?",
    "square added": "In your {where}, the units of {term} do not come out {right}. Look at the "
    "power of {put}.",
    "parameter inverted": "In your {where}, the units of {term} do not come out {right}. Look at the "
    "power of {put}.",
    "half angle": "In your {where}, {term} takes half of {instead_of} for its angle. After how many "
    "turns does it come back to the same value?",
    "wrong wave": OTHER_WAVE,
    "wrong wave with a minus": OTHER_WAVE,
    "double angle": "In your {where}, {term} takes twice {instead_of} for its angle. How often does "
    "it come back to the same value in one turn?",
    "triple angle": "In your {where}, {term} takes three times {instead_of} for its angle. How often "
    "does it come back to the same value in one turn?",
    "wave power": "In your {where}, {term} has a sine or cosine to the wrong power. What becomes of "
    "it if its angle grows by half a turn?",
    "wave without its sign": "In your {where}, {term} has the size of a sine or cosine, without its "
    "sign. At which angles is that sine or cosine negative?",
}

OF_FRICTION = {
    "quadratic friction": "In your {where}, {term} grows with the square of the speed. Which "
    "power does the unit of its coefficient ask for?",
    "friction in one direction": "In your {where}, {term} always acts in the same direction. "
    "What decides the direction of friction?",
    "absolute value for sign": "In your {where}, {term} has the size of the velocity where its "
    "sign belongs, so it grows with the speed and never changes direction. In which direction "
    "does friction act?",
    "velocity for its sign": "In your {where}, {term} grows with the speed. Dry friction does "
    "not depend on how fast a joint moves: what does it depend on?",
    "sign of the coordinate": "In your {where}, {term} has the sign of the coordinate. Does "
    "friction depend on where a joint is, or on how it moves?",
    "coordinate for velocity": "In your {where}, {term} goes with the coordinate. Does friction depend "
    "on where a joint is, or on how it moves?",
    "coefficient left out": "In your {where}, {term} lacks its coefficient. Do its units come out "
    "right?",
    "added up": "In your {where}, each joint feels {term} of all joints, added up. How do @ and * "
    "differ for two vectors?",
    "direction of all velocities": "In your {where}, {term} is divided by the length of the whole q̇. "
    "Does dry friction in one joint depend on how fast another one moves?",
    "smooth sign": "In your {where}, {term} fades out at low speed, as a tanh does. In this "
    "model it jumps: how large is dry friction at 0.001 rad/s?",
    "friction at rest": "In your {where}, {term} is not zero in a joint at rest. In which "
    "direction would it push there? What does NumPy's own sign give for 0?",
    "sign for velocity": "In your {where}, {term} has the same size at every speed. Which power of the "
    "velocity does the unit of its coefficient ask for?",
    "input for velocity": "In your {where}, {term} goes with the input u. Does friction depend on what "
    "the motor does, or on how the joint moves?",
    "friction multiplied": "In your {where}, the viscous and the Coulomb friction of a joint are "
    "multiplied with each other. Do the units of the two allow that, or do they act side by side?",
    "coefficients exchanged": "You swapped the two coefficients of {term}. Which of them is a "
    "torque or force by itself, and which must be multiplied by a velocity?",
}

# In C q̇ or an entry of C.
OF_VELOCITIES = {
    "product dropped": "In {where} of your C q̇, the product of velocities {put} is missing. "
    "Which derivatives of M does it come with?",
    "product of the wrong sign": "In {where} of your C q̇, the product of velocities {put} has "
    "the wrong sign. Which derivatives of M does it come with?",
    "product halved": "In {where} of your C q̇, the product of velocities {put} is half of what "
    "it should be. In how many places of the sum over j and k does it appear?",
    "product doubled": "In {where} of your C q̇, the product of velocities {put} counts twice. "
    "In how many places of the sum over j and k does it appear?",
    "velocity dropped": "In your {where}, the part with the velocity {put} is missing. Which "
    "derivatives of M does it come with?",
    "velocity of the wrong sign": "In your {where}, the part with the velocity {put} has the "
    "wrong sign. Which derivatives of M does it come with?",
    "velocity halved": "In your {where}, the part with the velocity {put} is half of what it "
    "should be. Which derivatives of M does it come with?",
    "velocity doubled": "In your {where}, the part with the velocity {put} counts twice. Which "
    "derivatives of M does it come with?",
}

# One velocity too many, in an entry of C or of Ṁ.
OF_VELOCITIES |= {
    "velocity squared": "In your {where}, the velocity {put} counts with its square. C multiplies "
    "q̇: how many velocities are left for an entry of C?",
    "velocity too many": "Your {where} has one velocity too many. C multiplies q̇: how many velocities "
    "are left for an entry of C?",
}

# Of a mistake that is made in all terms alike.
THROUGHOUT = {
    "absolute angle": "Your {where} is right for an angle {put} that is measured from the same "
    "line as {instead_of}. From where is {put} measured here?",
    "relative angle": "Your {where} is right for an angle {put} that is measured from the link "
    "that {instead_of} turns. From where is {put} measured here?",
    "wrong parameter": "Your {where} uses {put} ({put_doc}) where another {kind} belongs. Which "
    "one?",
    "parameters exchanged": "In your {where}, you swapped {put} and {instead_of}. Which is which?",
    "wrong angle": "Your {where} uses the angle {put} where another one belongs. What does each "
    "angle measure, and from where?",
    "sine for cosine": "Your {where} has sines where cosines belong. What is the sine of 0, and "
    "what should come out there?",
    "cosine for sine": "Your {where} has cosines where sines belong. What is the sine of 0, and "
    "what should come out there?",
    "parameter added": "Your {where} adds {put} to {instead_of}. Does {put} ({put_doc}) have a "
    "part in it?",
    "velocity left out": "In your {where}, everything comes from {put} alone. Which joints move "
    "which body?",
    "square lost": "The units of your {where} do not come out {right}. Look at the power of {put}.",
    "length left out": "In your {where}, {instead_of} is missing from a sum. Which lengths add up "
    "there?",
    "squared part by part": "In your {where}, you squared {put} one by one. What does the square of a "
    "sum hold besides the squares of its parts?",
    "wave lost": "Your {where} is the same at every angle {instead_of}. How does it change as "
    "the joints turn?",
    "wrong velocity": "Your {where} goes with {put} where another velocity belongs. Which joint "
    "moves which body?",
    "parallel axis added": "Your {where} has more than {instead_of}: you applied the "
    "parallel-axis theorem with {put}. About which point is {instead_of} taken?",
    "parallel axis taken off": "Your {where} has less than {instead_of}. About which point is "
    "{instead_of} taken, and about which does the body turn?",
    "point mass": "Your {where} takes the body of {instead_of} for a point mass. The body has a "
    "size: which parameter tells how its mass is spread?",
    "mass for inertia": "Your {where} has the mass {put} where an inertia belongs. What resists "
    "an angular acceleration?",
    "kind left out": "Your {where} lacks the {all_of_them}. Do its units come out {right}?",
    "astray": "Your {where} holds what belongs in {put}. Does it belong there too?",
    "moved": "Your {where} holds what belongs in {put}, and {put} lacks it. Which coordinate "
    "moves what?",
    "parameter left out": "Your {where} lacks {instead_of}. Do its units come out {right}?",
    "velocity not squared": "Your {where} has velocities alone where their squares belong. How does the "
    "kinetic energy change if everything moves twice as fast?",
    "velocity missing": "In your {where}, {instead_of} is missing from products of two velocities. How "
    "does the kinetic energy change if everything moves twice as fast?",
    "square added": "The units of your {where} do not come out {right}. Look at the power of {put}.",
    "parameter inverted": "The units of your {where} do not come out {right}. Look at the power of "
    "{put}.",
    "half angle": "Your {where} takes half of {instead_of} for an angle. After how many turns does it "
    "come back to the same value?",
    "wrong wave": OTHER_WAVES,
    "wrong wave with a minus": OTHER_WAVES,
    "double angle": "Your {where} takes twice {instead_of} for an angle. How often does it come back to "
    "the same value in one turn?",
    "triple angle": "Your {where} takes three times {instead_of} for an angle. How often does it come "
    "back to the same value in one turn?",
    "wave power": "Your {where} has sines or cosines to the wrong power. What becomes of it if an angle "
    "grows by half a turn?",
    "wave without its sign": "Your {where} has the sizes of sines and cosines, without their signs. At "
    "which angles is each of them negative?",
    "small angle": "Your {where} is right for small angles only. Where did you put something "
    "simpler in place of a sine or a cosine?",
    "radians converted": "You convert the angles to radians. They are in radians already.",
    "angle in degrees": "You convert the angles to degrees. Which unit do np.sin and np.cos take?",
}
