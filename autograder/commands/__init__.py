"""The subcommands of `autograder`, a file each: `add_to` says what it is given, `run` does it.

What takes long to import is imported in `run`.
"""

from autograder.commands import (
    archive,
    bundle,
    collect_zip,
    export,
    forget,
    grade,
    lti,
    mark,
    new_problem,
    open_solution,
    problems,
    report,
    try_mechanism,
)

# In the order of the command's help.
ALL = (
    problems,
    grade,
    mark,
    report,
    open_solution,
    collect_zip,
    export,
    lti,
    forget,
    archive,
    bundle,
    try_mechanism,
    new_problem,
)
