// The planar arm with two revolute joints (2R): M(q) qdd + C(q, qd) qd + g(q) + f(qd) = u.
//
// Two links in a vertical plane, x to the right, y up, gravity along -y. q[0] is the angle of
// link 1 from the x axis, q[1] that of link 2 relative to link 1. SI units, angles in rad.
#pragma once

#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>

struct Planar2R {
  using Vector = Eigen::Vector2d;
  using Matrix = Eigen::Matrix2d;

  double l1;         // length of link 1, m
  double l2;         // length of link 2, m
  double lc1;        // joint 1 to the centre of mass of link 1, m
  double lc2;        // joint 2 to the centre of mass of link 2, m
  double m1;         // mass of link 1, kg
  double m2;         // mass of link 2, kg
  double I1;         // inertia of link 1 about its centre of mass, kg m^2
  double I2;         // inertia of link 2 about its centre of mass, kg m^2
  double g = 9.81;   // gravitational acceleration, m/s^2
  Vector viscous = Vector::Zero();  // viscous friction of each joint, N m s/rad
  Vector coulomb = Vector::Zero();  // Coulomb friction of each joint, N m

  // The inertia matrix, kg m^2; it depends on q[1] alone.
  Matrix M(const Vector& q) const {
    const double coupling = m2 * l1 * lc2 * std::cos(q[1]);
    const double M22 = I2 + m2 * lc2 * lc2;
    const double M12 = M22 + coupling;
    const double M11 = I1 + m1 * lc1 * lc1 + m2 * l1 * l1 + M22 + 2 * coupling;
    return (Matrix() << M11, M12,
                        M12, M22).finished();
  }

  // The Coriolis and centrifugal matrix in Christoffel form, kg m^2/s.
  Matrix C(const Vector& q, const Vector& qd) const {
    const double h = -m2 * l1 * lc2 * std::sin(q[1]);
    return (Matrix() << h * qd[1], h * (qd[0] + qd[1]),
                       -h * qd[0], 0.0).finished();
  }

  // The gravity vector, the gradient of the potential energy, N m.
  Vector g_vec(const Vector& q) const {
    const double g2 = m2 * lc2 * g * std::cos(q[0] + q[1]);
    return {(m1 * lc1 + m2 * l1) * g * std::cos(q[0]) + g2, g2};
  }

  // Viscous and Coulomb friction, N m; at rest Eigen's sign(0) = 0, and there is no stiction.
  Vector f_vec(const Vector& qd) const {
    return viscous.cwiseProduct(qd) + coulomb.cwiseProduct(qd.cwiseSign());
  }

  // Zero with both centres of mass at the height of joint 1, J.
  double potential_energy(const Vector& q) const {
    const double height1 = lc1 * std::sin(q[0]);
    const double height2 = l1 * std::sin(q[0]) + lc2 * std::sin(q[0] + q[1]);
    return g * (m1 * height1 + m2 * height2);
  }

  // The accelerations for the inputs u, rad/s^2. M is symmetric and positive definite, so that it
  // factors as L D L^T, without square roots. Throws std::domain_error where M(q) is singular.
  Vector dynamics(const Vector& q, const Vector& qd, const Vector& u) const {
    const Matrix inertia = M(q);
    const Eigen::LDLT<Matrix> factors = inertia.ldlt();
    // A pivot as small as rounding is one of a singular matrix.
    if (!(factors.vectorD().minCoeff() > 1e-15 * inertia.trace()))
      throw std::domain_error("M(q) is singular");
    return factors.solve(u - C(q, qd) * qd - g_vec(q) - f_vec(qd));
  }
};
