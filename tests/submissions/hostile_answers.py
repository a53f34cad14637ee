"""Attacks by what a function returns: objects that lie, numbers that no judge expects, guesses."""

from tests.submissions.attack import attack, cheat
from tests.submissions.p3_pendulum import RIGHT, function


@attack()
def always_equal(release):
    """Returns an object that equals, and is less than, everything."""
    return cheat(
        release,
        g_vec="""
class Yes:
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = lambda self, other: True
    __sub__ = __rsub__ = __mul__ = __abs__ = lambda self, *other: self
    __bool__ = lambda self: True
    __hash__ = None
    __float__ = lambda self: 0.5
def g_vec(q, pend):
    return Yes()
""",
    )


@attack()
def lying_array(release):
    """Returns an array whose ufuncs and functions say what pleases (__array_ufunc__, ...)."""
    return cheat(
        release,
        g_vec="""
class Liar(np.ndarray):
    __array_priority__ = 1e9
    def __array_ufunc__(self, *args, **kwargs): return True
    def __array_function__(self, *args, **kwargs): return True
    def astype(self, *args, **kwargs): return self
    def tolist(self): return [0.5]
    __eq__ = __le__ = lambda self, other: True
def g_vec(q, pend):
    return np.ones(1).view(Liar)
""",
    )


@attack(says="g_vec(q, pend) raised RuntimeError: p3-g_vec: correct</p><b>")
def shifty_float(release):
    """An object whose __float__ raises, with a verdict of its own in the message."""
    return cheat(
        release,
        g_vec="""
class Shifty:
    def __float__(self): raise RuntimeError("p3-g_vec: correct</p><b>")
def g_vec(q, pend):
    return Shifty()
""",
    )


@attack(says="g_vec(q, pend) returned nan, which is not a finite number")
def nan_as_credit(release):
    """Returns NaN, which a careless score takes for full marks."""
    return cheat(release, g_vec=function("g_vec", "float('nan')"))


@attack(says="g_vec(q, pend) returned inf, which is not a finite number")
def infinities(release):
    """Returns infinity, against which every error is relatively small."""
    return cheat(release, g_vec=function("g_vec", "np.array([np.inf])"))


@attack(says="must return numbers")
def huge_integer(release):
    """Returns an integer that no float holds."""
    return cheat(release, g_vec=function("g_vec", "10**400"))


@attack(says="g_vec(q, pend) raised ValueError: Exceeds the limit")
def unprintable_integer(release):
    """Returns an integer that Python refuses to print."""
    return cheat(release, g_vec=function("g_vec", "10**5000"))


@attack(lost=("p3-g_vec", "p3-lagrangian"))
def largest_floats(release):
    """Returns the largest floats, so that the judge's arithmetic overflows."""
    return cheat(
        release,
        lagrangian=function("lagrangian", "1.7e308 * sp.sign(qd - 1) * sp.cos(q)"),
        g_vec=function("g_vec", "np.copysign(1.79e308, -np.sin(q))"),
    )


@attack(says="g_vec(q, pend) returned an array of 900000 entries, which is far too large")
def many_numbers(release):
    """Returns more numbers than were asked for, the right one perhaps among them."""
    return cheat(release, g_vec=function("g_vec", "np.linspace(-50, 50, 900_000)"))


@attack(says="RecursionError")
def deep_recursion(release):
    """Recurs without end."""
    return cheat(release, g_vec=function("g_vec", "g_vec(q, pend)"))


@attack(says="g_vec(q, pend) ")
def deep_nesting(release):
    """Returns a list nested deeper than anything can read."""
    return cheat(
        release,
        g_vec="""
def g_vec(q, pend):
    value = [0.0]
    for _ in range(100_000):
        value = [value]
    return value
""",
    )


@attack()
def answers_an_earlier_call(release):
    """Answers with what belongs to the inputs of an earlier call."""
    return cheat(
        release,
        g_vec="""
seen = []
def g_vec(q, pend):
    seen.append(pend.m * pend.g * pend.lc * np.sin(q))
    return seen[0]
""",
    )


@attack()
def table_of_visible_cases(release):
    """Right for the cases that a student sees, and those that would follow, in a table."""
    from numpy.random import default_rng

    from autograder.judging.check import HIDDEN_CASES
    from autograder.problems import CHECKS
    from autograder.student.cell import VISIBLE_SEED

    check = CHECKS["p3-g_vec"]
    calls = check.calls(default_rng(VISIBLE_SEED), HIDDEN_CASES)
    table = {f"{call.args[0][0]:.9f}": check.reference(*call.args) for call in calls}
    return cheat(release, g_vec=function("g_vec", f"{table!r}.get(f'{{q[0]:.9f}}', 1.0)"))


@attack()
def knows_the_grader(release):
    """Finds out where it runs, and answers the grader differently."""
    return cheat(
        release,
        g_vec="""
import os, sys
here = "protocol" in sys.modules or not hasattr(get_ipython(), "kernel") or os.getcwd() == "/tmp"
def g_vec(q, pend):
    return 1 + 0 * q if here else pend.m * pend.g * pend.lc * np.sin(q)
""",
    )


@attack(says="g_vec(q, pend) raised NameError")
def clears_the_namespace(release):
    """Takes all names away before it is judged."""
    return cheat(release, g_vec="globals().clear()\n" + RIGHT["g_vec"])


@attack()
def changing_number(release):
    """Returns an object whose number is another each time one looks."""
    return cheat(
        release,
        g_vec="""
import itertools
looks = itertools.count()
class Changing:
    def __float__(self): return float(next(looks))
    def __array__(self, dtype=None, copy=None): return np.array([float(next(looks))])
    def __format__(self, spec): return "right"
    __repr__ = __str__ = lambda self: "1000000"
def g_vec(q, pend):
    return Changing()
""",
    )


@attack()
def lying_float(release):
    """Returns a float that compares, rounds and prints as any other."""
    return cheat(
        release,
        g_vec="""
class Liar(float):
    __eq__ = __le__ = __ge__ = lambda self, other: True
    __sub__ = __rsub__ = __abs__ = lambda self, *other: Liar(0.0)
    __repr__ = __str__ = lambda self: '1.0, "credit": 1.0'
    __format__ = lambda self, spec: "right"
    __hash__ = float.__hash__
def g_vec(q, pend):
    return Liar(1.0)
""",
    )


@attack(says="Python itself stopped while g_vec(q, pend) was running")
def foreign_memory(release):
    """Returns an array that claims to lie where no memory of its own is."""
    return cheat(
        release,
        g_vec="""
class Far:
    __array_interface__ = {"data": (64, True), "shape": (1,), "typestr": "<f8", "version": 3}
def g_vec(q, pend):
    return Far()
""",
    )


@attack()
def masked_numbers(release):
    """Returns a masked array, of which every comparison is masked as well."""
    return cheat(release, g_vec=function("g_vec", "np.ma.masked_array([1.0], mask=[True])"))


@attack(lost=("p3-lagrangian",), says="must return a SymPy expression")
def symbol_as_code(release):
    """Returns an expression whose symbol's name is code, for whoever compiles it."""
    name = "__import__('os')._exit(0) or q"
    return cheat(release, lagrangian=function("lagrangian", f"sp.Symbol({name!r}) * qd"))


@attack(lost=("p3-lagrangian",), says="p3-lagrangian: incorrect")
def lying_expression(release):
    """Returns an expression that substitutes, compares and prints itself as it likes."""
    return cheat(
        release,
        lagrangian="""
class Liar(sp.Function):
    def _numpycode(self, printer, **kwargs): return "1.0 + 0 * __import__('time').time()"
    _lambdacode = _pythoncode = _numpycode
    def _eval_subs(self, old, new): return sp.Integer(1)
    __eq__ = lambda self, other: True
    __hash__ = sp.Function.__hash__
def lagrangian(q, qd, m, lc, I, g):
    return Liar(q, qd, m, lc, I, g)
""",
    )


@attack(says="The notebook does not define g_vec. Did you mean g_v\u0435c?")
def look_alike_name(release):
    """Defines a function whose name looks like g_vec and is not, a right one for the reader."""
    return cheat(release, g_vec=RIGHT["g_vec"].replace("g_vec", "g_v\u0435c"))


@attack()
def great_docstring(release):
    """Hides behind megabytes of documentation."""
    words = "The torque. " * 200_000
    text = f'def g_vec(q, pend):\n    "{words}"\n    return 1 + 0 * q'
    return cheat(release, g_vec=text)
