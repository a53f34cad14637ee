"""The lessons' 2R arm: what `Planar2R` is given in their first cell."""

from types import SimpleNamespace

ARM = SimpleNamespace(
    l1=1.0, l2=0.8, lc1=0.5, lc2=0.4, m1=3.0, m2=2.0, I1=0.25, I2=0.11, g=9.81
)  # fmt: skip
