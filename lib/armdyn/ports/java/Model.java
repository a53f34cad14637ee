/** The arm that the driver speaks for, and how it is made of a row of numbers. */
final class Model {
  static final int JOINTS = 2;
  static final int PARAMETERS = 13;

  private Model() {}

  static Arm of(double[] p) {
    return new Planar2R(
        p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8],
        new Planar2R.Friction(p[9], p[11]),
        new Planar2R.Friction(p[10], p[12]));
  }
}
