"""What is put into the sandbox beside a student's code: the runner, and stubs for the course's packages.

Nothing here, and nothing it imports but `protocol`, is the course's own: no reference, no check.
"""
