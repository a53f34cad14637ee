"""Pictures for a student's notebook: the mechanism in motion, with the right equations and with the
student's, and curves of theirs against the right ones.
"""
