"""Answers that a person reads, and the page on which they get their points: `autograder mark`.

It knows nothing of nbgrader: who asks for a page gives it a `Desk`, which has the answers and takes the
points.
"""
