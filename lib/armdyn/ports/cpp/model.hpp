// The arm that the driver speaks for, and how it is made of a row of numbers.
#pragma once

#include "planar_2r.hpp"

using Arm = Planar2R;
constexpr int parameters = 13;

inline Arm arm_of(const double* p) {
  return {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], {p[9], p[10]}, {p[11], p[12]}};
}
