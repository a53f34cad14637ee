"""What is said of a regressor where what belongs to one entry of π counts in the column of another."""

OF_A_TERM = {
    "wrong parameter": "In your {where}, {term} counts in the column of {put}. Which entry of π "
    "does it belong to?",
    "parameter added": "In your {where}, {term} counts in the column of {put} too. Does {put} "
    "have a part in it?",
    "parameters exchanged": "In your {where}, you swapped the columns of {put} and {instead_of} "
    "in {term}. Which is which?",
}

OF_COLUMNS = {
    "wrong parameter": "Your {where} puts what belongs to {instead_of} into the column of "
    "{put}. What does each of the two multiply?",
    "parameter added": "Your {where} counts what belongs to {instead_of} in the column of {put} "
    "too. What does {put} multiply?",
    "parameters exchanged": "In your {where}, what belongs to {put} and what belongs to "
    "{instead_of} are swapped. Which is which?",
}
