"""What NumPy says where a line changes an array that is there already: x[0] = y, x += y."""

import ast

from .row import Row, Words
from .scene import Scene, text


def _assigned(scene: Scene, found, error) -> Words | None:
    return found[1], found[2]


def _kept_shape(scene: Scene, found, error) -> Words | None:
    """What x += y was to change, its shape, and the one that came out."""
    node = scene.find(ast.AugAssign)
    return (text(node.target), found[1], found[2]) if node else None


def _kept_whole(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.AugAssign)
    return (text(node.target),) if node else None


ROWS = (
    Row(
        "put into",
        ("ValueError",),
        r"could not broadcast input array from shape (\(.*\)) into shape (\(.*\))",
        "An array of shape {0} does not fit where you put it: the place has the shape {1}.",
        _assigned,
    ),
    Row(
        "shape that stays",
        ("ValueError",),
        r"^non-broadcastable output operand with shape (\(.*?\)) .* the broadcast shape (\(.*?\))",
        "{0} has the shape {1}, which += and its like do not change, and what would come out has {2}. "
        "Is there a * where the product of a matrix and a vector, @, belongs?",
        _kept_shape,
    ),
    Row(
        "whole numbers",
        ("TypeError",),
        r"^Cannot cast ufunc .* output from dtype\('float64'\) to dtype\('u?int",
        "{0} is an array of whole numbers, as np.array([0, 0]) is, and can hold no others. Make it with "
        "np.zeros, or write 0.0.",
        _kept_whole,
    ),
)
