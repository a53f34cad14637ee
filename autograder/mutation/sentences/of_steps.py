"""What is said of a step on the way to the answer that went wrong, by the step."""

HALF_OF_ONE = (
    "Only one of the three derivatives in your Christoffel symbol is halved. Where do the brackets "
    "behind its ½ begin and end?"
)

OF_STEPS = {
    "half of the whole": "Your {where} is half of the right one. Is there a ½ too many?",
    "twice the whole": "Your {where} is twice the right one. Is a ½ missing?",
    "sign of the whole": "Your {where} has the wrong sign. On which side of the equation of "
    "motion does it stand?",
    "inverse": "Your {where} is the inverse of the right matrix. Which of the two stands in the "
    "kinetic energy?",
    "diagonal alone": "Your {where} is diagonal. Do the joints not feel each other's "
    "accelerations?",
    "upper triangle alone": "Your {where} is 0 below its diagonal. Which property do inertia "
    "matrices have?",
    "transposed": "You return the transpose of C. Which index of h_ijk numbers the row?",
    "rate of M": "You return Ṁ, which is only one part of what the Euler–Lagrange equation "
    "gives. What comes from the derivative of the kinetic energy with respect to q?",
    "half the rate of M": "You return half of Ṁ. It makes Ṁ − 2C zero, but does it give the "
    "right C q̇?",
    "rate of M less 2C": "You return Ṁ − 2C. Which matrix multiplies q̇ in the equation of motion?",
    "2C less the rate of M": "You return C less its transpose, which is 2C − Ṁ. Which matrix multiplies "
    "q̇ in the equation of motion?",
    "M": "You return M, which multiplies q̈. C multiplies q̇.",
    "zero": "Your {where} is 0. What do you differentiate, and with respect to what?",
    "last derivative missing": "Your C leaves out −∂K/∂q and holds only the terms from "
    "d/dt(∂K/∂q̇). Where else in the Euler–Lagrange equation is M(q) differentiated?",
    "sign of the last derivative": "The last of the three derivatives in your Christoffel "
    "symbol has the wrong sign. It comes from −∂K/∂q: what sign does that give it?",
    "last derivative not halved": "The last of the three derivatives in your Christoffel symbol "
    "counts twice. The kinetic energy has a ½: what becomes of it?",
    "second derivative missing": "One of the two derivatives with a plus is missing from your "
    "Christoffel symbol. How do the velocities j and k share ∂M_ij/∂q_k?",
    "first derivative missing": "Your Christoffel symbol leaves out the derivative of M_ij "
    "itself. How fast does M_ij change as coordinate k moves, and where does that count?",
    "not symmetrised": "Your C gives the right C q̇, but it is not the Christoffel form: you "
    "left the derivative of M_ij as it came. How do the velocities j and k share it?",
    "summed over the first index": "You sum the Christoffel symbols over the wrong index. Which "
    "index is left free for the row, and which goes with q̇_k?",
    "no velocity": "Your sum over k has no velocity in it. What must multiply each h_ijk?",
    "velocity of the column": "You multiply h_ijk by the velocity of its column. Over which "
    "index does the sum run?",
    "velocity of the row": "You multiply h_ijk by the velocity of its row. Over which index "
    "does the sum run?",
    "joints exchanged": "Your {where} has the entries of the joints in the wrong order. Which "
    "coordinate comes first?",
    "lower triangle alone": "Your {where} is 0 above its diagonal. Which property do inertia "
    "matrices have?",
    "sign below the diagonal": "Your {where} has the wrong sign below its diagonal. Which "
    "property do inertia matrices have?",
    "mixed terms not shared": "Your {where} has twice what it should have beside its diagonal. "
    "Multiply q̇ᵀ M q̇ out: how often does each mixed product appear?",
    "mixed terms in one triangle": "Your {where} gives the right kinetic energy, but all its "
    "mixed terms are on one side of the diagonal. How do two entries share them if {where} is "
    "symmetric?",
    "velocities exchanged": "You swapped the velocities in your {where}. Which velocity goes "
    "with the derivative by which coordinate?",
    "velocities squared": "Your {where} has each velocity squared. How many of the two velocities "
    "in a product of C q̇ come from the q̇ beside C?",
    "products of velocities": "The entries of your C hold products of two velocities, as C q̇ does. "
    "How many velocities are left for C itself?",
    "products with the row": "The entries of your C hold products of two velocities. C multiplies "
    "q̇: how many velocities are left for C itself?",
    "velocities of K not squared": "Your kinetic energy has velocities alone where their squares "
    "belong. How does it change if everything moves twice as fast?",
    "sum of the velocities": "You multiply each derivative of M by the sum of the velocities. "
    "In the chain rule, which velocity goes with which derivative?",
    "chain rule forgotten": "Your {where} holds derivatives by the coordinates, and no "
    "velocity. It is a derivative with respect to time: what does the chain rule add?",
    "C": "You return C. It is made of the same derivatives as Ṁ, but M is symmetric: can its "
    "derivative be anything else?",
    "twice C": "You return 2C. It does the same work as Ṁ, but the two matrices differ. In "
    "which entries?",
    "constants differentiated": "You multiply M by a velocity and differentiate nothing. What "
    "is the derivative of the constant parts of M?",
    "product with the velocities": "You multiply the entries of M by the velocities. How fast "
    "does each entry change?",
    "torque for C": "You return the vector C q̇, or a matrix made of it. Which square matrix "
    "gives this vector when you multiply it by q̇?",
    "C times ones": "You return C times a vector of ones, which sums its rows. What does C "
    "multiply in the equation of motion?",
    "second derivative twice": "Your C gives the right C q̇, but it is not the Christoffel "
    "form: one of the two derivatives with a plus counts twice, and the other is not there. How "
    "do the velocities j and k share them?",
    "first derivative alone halved": HALF_OF_ONE,
    "second derivative alone halved": HALF_OF_ONE,
    "last derivative alone halved": HALF_OF_ONE,
    "last term alone": "Your C holds only the last term of each sum over k. Is each term added to those "
    "before it, or written over them?",
    "first term alone": "Your C holds only the first term of each sum over k. Does your function "
    "return, or your loop end, before the others are added?",
    "last term left out": "In your C, the last term of each sum over k is missing. Which numbers does k "
    "take?",
    "first term left out": "In your C, the first term of each sum over k is missing. Which numbers does "
    "k take?",
    "sum never begun anew": "Each entry of your C also holds all the entries before it. Where does the "
    "sum for an entry begin?",
    "upper triangle mirrored": "Your C is symmetric: below its diagonal stands what stands above it. "
    "Must C be symmetric, as M is?",
    "signs of the left side": "In your q̈, everything but u has the wrong sign. In the equation of "
    "motion, on which side of the equals sign does each term stand?",
    "left side missing": "Your q̈ comes from u alone. Which other torques or forces does the equation of "
    "motion hold?",
    "products in the later column": "Your C gives the right C q̇, but it is not the Christoffel "
    "form: each product of two velocities stands in one column. How do the entries of a row "
    "share it?",
    "products in the earlier column": "Your C gives the right C q̇, but it is not the "
    "Christoffel form: each product of two velocities stands in one column. How do the entries "
    "of a row share it?",
    "second kind": "Your Christoffel symbols are of the second kind: you multiplied them by the "
    "inverse of M. Does that inverse have a place in the equation of motion as it is written "
    "here?",
    "gravity for C": "You return what gravity and springs do. It does not depend on q̇: where "
    "does it belong in the equation of motion?",
    "momentum for C": "You return the momentum M q̇. C comes from how M changes with q: where "
    "do you differentiate?",
    "energy for its derivative": "You return the potential energy. What turns P(q) into g(q)?",
    "energy for L": "You return the energy. Is L the sum of K and P, or their difference?",
    "L for the energy": "Your {where} has P with the wrong sign. Is E the sum of K and P, and "
    "does your P grow as a body rises or a spring is stretched?",
    "½ of K missing": "The kinetic energy in your {where} is twice the right one. Which factor "
    "belongs in front of a kinetic energy?",
    "½ of K twice": "The kinetic energy in your {where} is half of the right one. Is there a ½ "
    "too many?",
    "K missing": "The kinetic energy is missing from your {where}. What does the mechanism gain "
    "as it moves faster?",
    "P missing": "The potential energy is missing from your {where}. What does the mechanism "
    "gain as bodies rise or springs are stretched?",
    "diagonal of M alone": "Your kinetic energy uses only the diagonal of M. What does the "
    "energy gain when several joints move at once?",
    "M times squares": "Your kinetic energy multiplies M by the squares of the velocities. Which "
    "products of two different velocities does q̇ᵀ M q̇ hold?",
    "M of the start": "Your kinetic energy uses the M of the first state in every row. What "
    "does M depend on?",
    "C in the energy": "There is a term with C in your energy. Which two energies does the "
    "mechanism have?",
    "C for M": "You make the kinetic energy with C. Which matrix gives the kinetic energy?",
    "torque times coordinate": "Your P is a torque or force times the coordinate. One that "
    "changes on the way must be summed along it: how high are the bodies, how far are springs "
    "stretched?",
    "from the row before": "You return the change from each row to the next. From which state "
    "do you count the drift?",
    "size of the drift": "You return the size of the drift without its sign. Does the motion "
    "gain energy or lose it?",
    "energy for its drift": "You return the energy itself. By how much has it changed since the "
    "first row?",
    "from the mean": "You subtract the mean of the energy. From which state do you count the "
    "drift?",
    "from the end": "You subtract the energy of the last row. From which state do you count the "
    "drift?",
    "share for the drift": "You divide by the energy at the start. What happens to this ratio "
    "if you measure heights from elsewhere?",
    "share in percent": "You return the drift in percent of the energy at the start. What happens to "
    "this number if you measure heights from elsewhere?",
    "size of the share": "You divide by the energy at the start, and return the size without its sign. "
    "Does the motion gain energy or lose it, and in which unit?",
    "ratio for the drift": "You divide each energy by the first one. By how much has the energy "
    "changed, in joules?",
    "range for the drift": "You return the largest energy less the smallest, in each row. By how much "
    "has the energy of each row changed since the first?",
    "difference of sizes": "You compare the sizes of the energies. An energy may be negative, where a "
    "body hangs lower than your zero: what is its change then?",
    "slope for the drift": "You return the slope of the energy from row to row. From which state do you "
    "count the drift?",
    "M left out of K": "Your kinetic energy is half the sum of the squares of the velocities. What "
    "tells it how heavy the bodies are?",
    "momentum for K": "Your kinetic energy adds up the entries of M q̇, which are momenta. How often "
    "does the velocity enter a kinetic energy?",
    "column of another": "In your {where}, {term} holds what belongs in that of {put}. Which entry "
    "of π multiplies it?",
    "columns in another order": "Your columns are right, but they stand in another order than "
    "the entries of π. Which entry belongs to each column?",
    "parameters inside": "Your columns hold the parameters that they belong to. Y may hold only "
    "what is known: what multiplies Y?",
    "state for its rate": "You return x itself. What is its rate of change, half by half?",
    "velocity for acceleration": "The second half of your ẋ is q̇ again. What is the rate of "
    "change of q̇?",
    "halves of ẋ swapped": "You swapped the two halves of ẋ. Which half of x is q, and which "
    "half of ẋ is its rate of change?",
    "q for its rate": "The first half of your ẋ is q itself. What is the rate of change of q, "
    "and where in x does it stand?",
    "state read as q̇ and q": "Your accelerations come out as if x were [q̇; q]. Which half of "
    "x do you call q?",
    "state interleaved": "You read x as if each velocity stood beside its coordinate. In which "
    "order are the entries of x?",
    "states interleaved": "You read x, and write ẋ, as if each velocity stood beside its "
    "coordinate. In which order are the entries of x?",
    "rate interleaved": "You write ẋ as if each acceleration stood beside its velocity. In which "
    "order are the entries of x?",
    "M not inverted": "You multiply by M. In the equation of motion M multiplies q̈: how do you get q̈ "
    "alone?",
    "torque for acceleration": "The second half of your ẋ is a torque or force. What resists it?",
    "divided by the diagonal of M": "You divide by the diagonal of M, as if the joints did not "
    "feel each other. What do the other entries do?",
    "entries of M inverted": "You invert each entry of M by itself, which does not invert the "
    "matrix. Which NumPy function solves a linear system?",
    "divided by M entry by entry": "You divide by M entry by entry. Which NumPy function solves "
    "a linear system?",
    "C times ones in the torque": "Your Coriolis torque is the sum of each row of C. What must "
    "C multiply?",
    "not divided by M": "You do not divide {term} by M, as you do the rest. Is it an "
    "acceleration, or what makes one?",
    "divided by M": "You return an acceleration: you divided by the inertia already. In the "
    "equation of motion, what does M multiply?",
}
