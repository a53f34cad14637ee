// What an answer in C++ includes: Eigen, and the arm that the check passes.
#pragma once

#include <Eigen/Dense>

/// A planar arm with two links, in SI units.
struct Arm {
  double l1, l2;    ///< lengths of the links, m
  double lc1, lc2;  ///< from the joint of a link to its centre of mass, m
  double m1, m2;    ///< masses, kg
  double I1, I2;    ///< inertias about the centres of mass, kg·m²
  double g;         ///< gravitational acceleration, m/s²
};
