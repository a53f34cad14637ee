"""The right numbers of lesson 08 once more, by SymPy and `armdyn` in place of counting and formulas."""

import numpy as np
import sympy as sp

from armdyn import PlanarChain
from autograder.lesson_checks import checks_of

CHECKS = checks_of("08")


def test_cse_shares_as_much_as_a_person():
    a, b, q, qd, qdd = sp.symbols("a b q qd qdd")
    three = [a * sp.cos(q) * qd, a * sp.cos(q) * qdd + b * sp.sin(q), b * sp.sin(q)]
    steps, results = sp.cse(three)
    in_steps = sum(step.count_ops() for _, step in steps)
    in_results = sum(result.count_ops() for result in results)
    wrong = {one.name: one.number for one in CHECKS["08-steps"].wrong}
    assert CHECKS["08-steps"].right == in_steps + in_results
    assert (wrong["steps alone"], wrong["results alone"]) == (in_steps, in_results)
    assert wrong["written out"] == sum(expression.count_ops() for expression in three)


def test_the_torques_on_the_way_are_the_models():
    arm = PlanarChain(
        l=(0.6, 0.4, 0.5), lc=(0.1, 0.2, 0.3), m=(4.0, 3.0, 2.0), I=(0.3, 0.2, 0.05), g=0.0
    )
    u = arm.inverse_dynamics(np.zeros(3), np.zeros(3), np.array([0.0, 0.0, 4.0]))
    wrong = {one.name: one.number for one in CHECKS["08-carries"].wrong}
    assert np.allclose(u, [CHECKS["08-carries"].right, wrong["joint 2"], wrong["joint 3"]])
