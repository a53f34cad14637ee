import org.ejml.simple.SimpleMatrix;

/**
 * The planar arm with two revolute joints (2R).
 *
 * <p>Two links in a vertical plane, x to the right, y up, gravity along -y. q1 is the angle of link
 * 1 from the x axis, q2 that of link 2 relative to link 1.
 *
 * @param l1 length of link 1, m
 * @param l2 length of link 2, m
 * @param lc1 joint 1 to the centre of mass of link 1, m
 * @param lc2 joint 2 to the centre of mass of link 2, m
 * @param m1 mass of link 1, kg
 * @param m2 mass of link 2, kg
 * @param I1 inertia of link 1 about its centre of mass, kg m^2
 * @param I2 inertia of link 2 about its centre of mass, kg m^2
 * @param g gravitational acceleration, m/s^2
 * @param friction1 friction of joint 1
 * @param friction2 friction of joint 2
 */
public record Planar2R(
    double l1,
    double l2,
    double lc1,
    double lc2,
    double m1,
    double m2,
    double I1,
    double I2,
    double g,
    Friction friction1,
    Friction friction2)
    implements Arm {

  /**
   * The friction of a joint.
   *
   * @param viscous viscous friction, N m s/rad
   * @param coulomb Coulomb friction, N m
   */
  public record Friction(double viscous, double coulomb) {
    /** N m; none at rest, where sign(0) = 0: there is no stiction. */
    double at(double qd) {
      return viscous * qd + coulomb * Math.signum(qd);
    }
  }

  @Override
  public SimpleMatrix M(SimpleMatrix q) {
    double coupling = m2 * l1 * lc2 * Math.cos(q.get(1));
    double M22 = I2 + m2 * lc2 * lc2;
    double M12 = M22 + coupling;
    double M11 = I1 + m1 * lc1 * lc1 + m2 * l1 * l1 + M22 + 2 * coupling;
    return new SimpleMatrix(new double[][] {{M11, M12}, {M12, M22}});
  }

  @Override
  public SimpleMatrix C(SimpleMatrix q, SimpleMatrix qd) {
    double qd1 = qd.get(0), qd2 = qd.get(1);
    double h = -m2 * l1 * lc2 * Math.sin(q.get(1));
    return new SimpleMatrix(new double[][] {{h * qd2, h * (qd1 + qd2)}, {-h * qd1, 0}});
  }

  @Override
  public SimpleMatrix g_vec(SimpleMatrix q) {
    double g2 = m2 * lc2 * g * Math.cos(q.get(0) + q.get(1));
    double g1 = (m1 * lc1 + m2 * l1) * g * Math.cos(q.get(0)) + g2;
    return column(g1, g2);
  }

  @Override
  public SimpleMatrix f_vec(SimpleMatrix qd) {
    return column(friction1.at(qd.get(0)), friction2.at(qd.get(1)));
  }

  /** Zero with both centres of mass at the height of joint 1, J. */
  @Override
  public double potential_energy(SimpleMatrix q) {
    double height1 = lc1 * Math.sin(q.get(0));
    double height2 = l1 * Math.sin(q.get(0)) + lc2 * Math.sin(q.get(0) + q.get(1));
    return g * (m1 * height1 + m2 * height2);
  }

  private static SimpleMatrix column(double... numbers) {
    return new SimpleMatrix(numbers.length, 1, true, numbers);
  }
}
