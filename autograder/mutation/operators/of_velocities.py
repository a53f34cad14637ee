"""A velocity that is wrong in a term: another joint's, or one of several alone."""

import sympy as sp

from autograder.mechanisms import Mechanism
from autograder.mutation.operators.rewriting import Rewriting


def velocity_left_out(term, mechanism):
    """One velocity alone where the body turns with a sum of them."""
    for total in sorted({e for e in sp.preorder_traversal(term) if e.is_Add}, key=str):
        if total.free_symbols <= set(mechanism.qd) and sp.total_degree(total) == 1:
            for one in total.args:
                wrong = term.xreplace({total: one})
                yield Rewriting("velocity left out", wrong, str(one), str(total - one))


def wrong_velocity(term, mechanism):
    """The velocity of another joint."""
    for one in mechanism.qd:
        for other in mechanism.qd:
            if one != other and one in term.free_symbols:
                wrong = term.xreplace({one: other})
                yield Rewriting("wrong velocity", wrong, other.name, one.name)


def velocity_not_squared(term, mechanism):
    """Each velocity, or sum of velocities, once where its square belongs."""
    changes = {e: e.base for e in term.atoms(sp.Pow) if e.exp == 2 and _is_rate(e.base, mechanism)}
    if changes:
        yield Rewriting("velocity not squared", term.xreplace(changes))


def velocity_missing(term, mechanism):
    """One alone of the two velocities, or sums of velocities, that are multiplied with each other."""
    products = {e for e in sp.preorder_traversal(term) if e.is_Mul}
    for product in sorted(products, key=sp.default_sort_key):
        rates = [factor for factor in product.args if _is_rate(factor, mechanism)]
        for rate in rates if len(rates) > 1 else ():
            wrong = term.xreplace({product: product / rate})
            yield Rewriting("velocity missing", wrong, "", str(rate))


def _is_rate(e: sp.Basic, mechanism: Mechanism) -> bool:
    """Whether it is a velocity, or a sum of them."""
    return (
        bool(e.free_symbols) and e.free_symbols <= set(mechanism.qd) and (e.is_Symbol or e.is_Add)
    )
