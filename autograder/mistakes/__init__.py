"""The physics mistakes people make, a file a problem: each a wrong model, and the sentence for it.

A mistake's model takes the arguments of the student's function. It is reported only where the
student's numbers equal its numbers to rounding at random states, so an entry can be specific. To add
one: write the wrong model, the sentence that says where to look (never the formula), and a row in
tests/autograder/mistakes/.
"""
