"""Answers in C++, Java and MATLAB: the student's file as a Python function, on either side of the wall.

Around the student's function stands a small driver, which reads numbers and writes numbers. Here is
no formula of any arm: the folder goes into the room.
"""

from .from_file import from_file, missing

__all__ = ["from_file", "missing"]
