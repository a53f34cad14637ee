"""What NumPy says of shapes, indices and matrices, in the student's own names."""

import ast

import numpy as np

from .row import Row, Words
from .scene import Scene, text

# The joints' names of the vectors that a problem gives.
OF_JOINTS = {"q": "q", "qd": "q̇", "qdd": "q̈", "u": "u"}
PRODUCTS = ("dot", "matmul", "cross", "inner", "outer")
MOST_PARTS = 4
MOST_RANKED = 400  # entries


def _operands(scene: Scene) -> list[ast.expr]:
    """What is multiplied by @, or by np.dot or np.matmul; what + − * / join."""
    node = scene.node
    if isinstance(node, ast.BinOp):
        return [node.left, node.right]
    if isinstance(node, ast.AugAssign):
        return [node.target, node.value]
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return []
    given = node.args if len(node.args) == 2 else [node.func.value, *node.args]
    return given if node.func.attr in PRODUCTS and len(given) == 2 else []


def _two_shapes(scene: Scene, found, error) -> Words | None:
    operands = _operands(scene)
    shapes = [scene.shape(node) for node in operands]
    if len(operands) != 2 or None in shapes:
        return None
    return tuple(
        word
        for node, shape in zip(operands, shapes, strict=True)
        for word in (text(node), str(shape))
    )


def _number(scene: Scene, found, error) -> Words | None:
    """Which of two factors is a single number."""
    return next(((text(node),) for node in _operands(scene) if scene.shape(node) == ()), None)


def _first_argument(scene: Scene) -> ast.expr | None:
    call = scene.find(ast.Call)
    return call.args[0] if call and call.args else None


def _of_argument(scene: Scene, found, error) -> Words | None:
    node = _first_argument(scene)
    shape = scene.shape(node)
    return (text(node), str(shape)) if node is not None and shape is not None else None


def _rank(scene: Scene, found, error) -> Words | None:
    node = _first_argument(scene)
    matrix = scene.value(node)
    if node is None or type(matrix) is not np.ndarray or matrix.ndim != 2:
        return None
    if matrix.size > MOST_RANKED or matrix.dtype.kind not in "if":
        return None
    if not np.all(np.isfinite(matrix)):
        return None
    rank = int(np.linalg.matrix_rank(matrix))
    return (text(node), str(matrix.shape), str(rank)) if rank < len(matrix) else None


def _entries(scene: Scene, found, error) -> Words | None:
    """A vector, how many entries it has, and how the first and the last are written."""
    node = scene.find(ast.Subscript)
    shape = scene.shape(node.value) if node else None
    if node is None or shape is None or len(shape) != 1 or not shape[0]:
        return None
    name, size = text(node.value), shape[0]
    first, last = "its first entry", "its last one"
    if letter := OF_JOINTS.get(name):
        first, last = f"{letter}1", f"{letter}{size}"
    many = f"{size} entr{'y' if size == 1 else 'ies'}"
    if size == 1:
        return name, many, f"{name}[0] is {first}"
    return name, many, f"{name}[0] is {first} and {name}[{size - 1}] is {last}"


def _of_subscript(scene: Scene, found, error) -> Words | None:
    node = scene.find(ast.Subscript)
    shape = scene.shape(node.value) if node else None
    return (text(node.value), str(shape)) if node and shape is not None else None


def _too_many(scene: Scene, found, error) -> Words | None:
    words = _of_subscript(scene, found, error)
    return words and (*words, f"{found[1]} ind{'ex' if found[1] == '1' else 'ices'}")


def _parts(scene: Scene, found, error) -> Words | None:
    """The parts that are joined, with their shapes."""
    node = _first_argument(scene)
    if not isinstance(node, ast.List | ast.Tuple) or len(node.elts) > MOST_PARTS:
        return None
    shapes = [scene.shape(part) for part in node.elts]
    known = zip(node.elts, shapes, strict=True)
    said = [f"{text(part)} {shape}" for part, shape in known if shape is not None]
    return (", ".join(said),) if len(said) > 1 else None


def _array_entry(scene: Scene, found, error) -> Words | None:
    """An entry of np.array([...]) that is an array where others are numbers."""
    node = _first_argument(scene)
    rows = node.elts if isinstance(node, ast.List | ast.Tuple) else []
    entries = [e for row in rows for e in (row.elts if isinstance(row, ast.List) else [row])]
    for entry in entries:
        shape = scene.shape(entry)
        if shape and type(scene.value(entry)) is np.ndarray:
            return text(entry), str(shape)
    return None


def _condition(scene: Scene, found, error) -> Words | None:
    """What stands after if, not or while, and before and or or."""
    node = scene.node
    if isinstance(node, ast.IfExp):
        node = node.test
    if isinstance(node, ast.BoolOp):
        node = node.values[0]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        node = node.operand
    if not isinstance(node, ast.Name | ast.Compare | ast.Attribute):
        return None
    shape = scene.shape(node)
    return text(node), f" of shape {shape}" if shape else ""


def _scalar_function(scene: Scene, found, error) -> Words | None:
    """A function that takes one number, what it was given, and NumPy's function of that name."""
    call, node = scene.find(ast.Call), _first_argument(scene)
    if call is None or node is None:
        return None
    shape, called = scene.shape(node), text(call.func)
    name = called.rpartition(".")[2]
    is_there = isinstance(getattr(np, name, None), np.ufunc)
    return (
        called,
        text(node),
        f"has the shape {shape}" if shape else "is an array",
        f"Use np.{name}, or one entry." if is_there else "Which entry is meant?",
    )


def _two_lists(scene: Scene, found, error) -> Words | None:
    """np.array with a second list where it takes the type of its numbers."""
    call = scene.find(ast.Call)
    if call is None or len(call.args) < 2 or not isinstance(call.args[1], ast.List | ast.Tuple):
        return None
    return (text(call.func),)


def _called_with_number(scene: Scene, found, error) -> Words | None:
    call = scene.find(ast.Call)
    return (text(call.func),) if call else None


def _lengths(scene: Scene, found, error) -> Words:
    """The last length of A and the first of B, as NumPy's message has them."""
    last, first = found["last"] or found["last_of_dot"], found["first"] or found["first_of_dot"]
    return last, first


def _sides(scene: Scene, found, error) -> Words | None:
    """The matrix and the right side of equations, with their shapes."""
    call = scene.find(ast.Call)
    given = call.args[:2] if call else []
    shapes = [scene.shape(node) for node in given]
    if len(given) != 2 or None in shapes:
        return None
    words = zip(given, shapes, strict=True)
    return tuple(word for node, shape in words for word in (text(node), str(shape)))


PRODUCT = "In a product A @ B, the last length of A must be the first of B."
MATMUL = r"matmul: Input operand|^shapes .* not aligned|^Matrix size mismatch|^Dimension mismatch"
ROWS = (
    Row(
        "matmul number",
        ("ValueError",),
        r"does not have enough dimensions",
        "{0} is a single number, and @ multiplies matrices and vectors. A number is multiplied by *.",
        _number,
    ),
    Row(
        "matmul",
        ("ValueError", "ShapeError"),
        MATMUL,
        "{0} is {1}, and {2} is {3}. " + PRODUCT,
        _two_shapes,
    ),
    Row(
        "matmul of unknown shapes",
        ("ValueError",),
        r"^matmul: .*size (?P<first>\d+) is different from (?P<last>\d+)|"
        r"^shapes .* not aligned: (?P<last_of_dot>\d+) \(dim \d\) != (?P<first_of_dot>\d+)",
        PRODUCT + " Here they are {0} and {1}.",
        _lengths,
    ),
    Row(
        "two sides",
        ("ValueError", "LinAlgError"),
        r"^solve1?: Input operand|^Incompatible dimensions",
        "{0} is {1}, and {2} is {3}. Each row of the matrix is an equation and needs its number on the "
        "right side.",
        _sides,
    ),
    Row(
        "broadcast",
        ("ValueError",),
        r"could not be broadcast together",
        "{0} is {1}, and {2} is {3}. The signs +, −, * and / join arrays entry by entry.",
        _two_shapes,
    ),
    Row(
        "singular",
        ("LinAlgError",),
        r"^Singular matrix",
        "{0} is {1}, and its rank is only {2}: some of its columns follow from others, or are zero. "
        "Which columns?",
        _rank,
    ),
    Row(
        "some singular",
        ("LinAlgError", "NonInvertibleMatrixError"),
        r"^Singular matrix|det == 0|Matrix.*not invertible",
        "Some columns of this matrix follow from others, or are zero. Which columns?",
    ),
    Row(
        "square",
        ("LinAlgError",),
        r"must be square",
        "{0} is {1}, and only a square matrix has an inverse.",
        _of_argument,
    ),
    Row(
        "index",
        ("IndexError",),
        r"is out of bounds for axis|index out of range",
        "{0} has {1}, and Python counts from 0: {2}.",
        _entries,
    ),
    Row(
        "index of matrix",
        ("IndexError",),
        r"is out of bounds for axis",
        "{0} has the shape {1}, and Python counts rows and columns from 0.",
        _of_subscript,
    ),
    Row(
        "index of number",
        ("IndexError",),
        r"^invalid index to scalar variable",
        "{0} got a single number where it takes an array. Are its arguments in the right order?",
        _called_with_number,
    ),
    Row(
        "many indices",
        ("IndexError",),
        r"too many indices for array: array is (\d+)-dimensional",
        "{0} has the shape {1}: it takes {2}.",
        _too_many,
    ),
    Row(
        "joined",
        ("ValueError",),
        r"all the input arrays must have same|all the input array dimensions",
        "The parts have the shapes {0}. Is one of them a matrix where a vector belongs?",
        _parts,
    ),
    Row(
        "joined, of unknown shapes",
        ("ValueError",),
        r"all the input arrays must have same number of dimensions",
        "Print the shape of each part: is one of them a matrix where a vector belongs? A * B multiplies "
        "entry by entry, and A @ B is the product of matrices.",
    ),
    Row(
        "truth",
        ("ValueError",),
        r"^The truth value of an array",
        "A condition needs one True or False, and {0} is an array of them{1}. Must all of them hold "
        "(np.all), or is one enough (np.any)?",
        _condition,
    ),
    Row(
        "some truth",
        ("ValueError",),
        r"^The truth value of an array",
        "A condition needs one True or False, and this one is an array of them. Must all of them hold "
        "(np.all), or is one enough (np.any)?",
    ),
    Row(
        "two lists",
        ("TypeError",),
        r"^Field elements must be|^Cannot construct a dtype|as a data type$",
        "{0} takes one list: its rows stand in one more pair of square brackets.",
        _two_lists,
    ),
    Row(
        "one number",
        ("TypeError",),
        r"only (length-1|0-dimensional|size-1) arrays can be converted|"
        r"must be real number, not (list|tuple)",
        "{0} takes one number, and {1} {2}. {3}",
        _scalar_function,
    ),
    Row(
        "entry",
        ("ValueError",),
        r"^setting an array element with a sequence",
        "{0} is an array of shape {1}. Does one number belong there?",
        _array_entry,
    ),
    Row(
        "some entry",
        ("ValueError",),
        r"^setting an array element with a sequence",
        "The rows of an array must have one length. Is there an array where one number belongs?",
    ),
)
