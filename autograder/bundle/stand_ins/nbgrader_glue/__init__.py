"""What fetching and handing in need on a class server, and nothing that grades."""

from autograder.nbgrader_glue.exchange import OF_STUDENTS as EXCHANGE

__all__ = ["EXCHANGE"]
