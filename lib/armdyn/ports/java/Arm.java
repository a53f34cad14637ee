import org.ejml.simple.SimpleMatrix;

/**
 * What an arm of n joints says of itself: the terms of M(q) qdd + C(q, qd) qd + g(q) + f(qd) = u.
 * Vectors are columns; SI units, angles in rad.
 */
public interface Arm {
  /** The inertia matrix, n x n, kg m^2. */
  SimpleMatrix M(SimpleMatrix q);

  /** The Coriolis and centrifugal matrix in Christoffel form, n x n, kg m^2/s. */
  SimpleMatrix C(SimpleMatrix q, SimpleMatrix qd);

  /** The gravity vector, the gradient of the potential energy, N m. */
  SimpleMatrix g_vec(SimpleMatrix q);

  /** The friction, N m. */
  SimpleMatrix f_vec(SimpleMatrix qd);

  /** The potential energy, J. */
  double potential_energy(SimpleMatrix q);

  /** The accelerations for the inputs u, rad/s^2; the solver factors M(q). */
  default SimpleMatrix dynamics(
      SimpleMatrix q, SimpleMatrix qd, SimpleMatrix u, LinearSolver solver) {
    SimpleMatrix force = u.minus(C(q, qd).mult(qd)).minus(g_vec(q)).minus(f_vec(qd));
    return solver.solve(M(q), force);
  }
}
