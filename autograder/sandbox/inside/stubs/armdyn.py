"""Stands for `armdyn` where a submission is graded."""

raise ImportError(
    "armdyn holds the formulas that this problem asks for, so a graded answer cannot import it; "
    "use numpy and sympy"
)
