/** A planar arm with two links, in SI units: arm.l1() is the length of the first, in m. */
record Arm(
    double l1, double l2, double lc1, double lc2, // m
    double m1, double m2, // kg
    double I1, double I2, // kg·m², about the centres of mass
    double g) {} // m/s²
