"""Stands for `armdyn` in the sandbox."""

raise ImportError(
    "armdyn contains the formulas that this problem asks for, so a graded answer cannot import it; "
    "use numpy and sympy"
)
