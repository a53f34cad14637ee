"""An arm whose angle counts from another line than this one's."""

import itertools

import sympy as sp

from autograder.mutation.operators.rewriting import Rewriting, waves


def another_convention(term, mechanism):
    """The energy of an arm whose angle counts from another line: from the one that the angle before
    counts from, or from the link before. Velocities go with it.
    """
    if len(term) > 1:
        return  # entries, which have been derived for these coordinates already
    angles = [(c.symbol, c.velocity) for c in mechanism.coordinates if c.unit == "rad"]
    arguments = [wave.args[0] for wave in waves(sp.Tuple(mechanism.K, mechanism.P))]
    for (before, its_rate), (angle, rate) in itertools.pairwise(angles):
        for name, sign in (("absolute angle", -1), ("relative angle", 1)):
            if not any(a.coeff(angle) == -sign * a.coeff(before) != 0 for a in arguments):
                continue  # the angle does not count so here, or the two turn about different axes
            changes = {angle: angle + sign * before, rate: rate + sign * its_rate}
            yield Rewriting(name, term.xreplace(changes), angle.name, before.name)
