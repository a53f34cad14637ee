"""The checks of every problem, by the grade_id of the cell they judge."""

from autograder.problems import p3_pendulum, start_here

CHECKS = {check.id: check for module in (start_here, p3_pendulum) for check in module.CHECKS}
