"""What the sandbox holds beside a student's code: the runner, and stubs for the course's packages.

Nothing here is a reference or a check, and nothing of the course is imported but `protocol`.
"""
