"""Errors carried on: a wrong answer that follows, as it should, from an earlier wrong answer.

The right gradient of one's own wrong P is a wrong g, but the mistake is in P. A check says from which
earlier answers its own follows, and how (`follows`, `ways`); where its numbers are wrong, they are held
against what follows from the student's own earlier function (`judge`).
"""
