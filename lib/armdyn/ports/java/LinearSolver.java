import org.ejml.data.DMatrixRMaj;
import org.ejml.dense.row.factory.LinearSolverFactory_DDRM;
import org.ejml.interfaces.decomposition.CholeskyDecomposition_F64;
import org.ejml.interfaces.linsol.LinearSolverDense;
import org.ejml.simple.SimpleMatrix;

/** Solves A x = b for a symmetric positive definite A, such as an inertia matrix. */
@FunctionalInterface
public interface LinearSolver {
  /** Throws ArithmeticException where A is not positive definite. */
  SimpleMatrix solve(SimpleMatrix A, SimpleMatrix b);

  /** A = L L^T for any number of joints, by EJML. */
  static LinearSolver cholesky() {
    return (A, b) -> {
      LinearSolverDense<DMatrixRMaj> solver = LinearSolverFactory_DDRM.chol(A.numRows());
      // The factors take the place of the matrix that is given.
      if (!solver.setA(A.copy().getDDRM())) throw notPositiveDefinite();
      CholeskyDecomposition_F64<DMatrixRMaj> factors = solver.getDecomposition();
      DMatrixRMaj L = factors.getT(null);
      for (int i = 0; i < L.numRows; ++i) checkPivot(L.get(i, i) * L.get(i, i), A);
      SimpleMatrix x = new SimpleMatrix(b.numRows(), b.numCols());
      solver.solve(b.getDDRM(), x.getDDRM());
      return x;
    };
  }

  /** The closed form for two joints, by Cramer's rule. */
  static LinearSolver twoByTwo() {
    return (A, b) -> {
      if (A.numRows() != 2) throw new IllegalArgumentException("needs two joints");
      double a11 = A.get(0, 0), a12 = A.get(0, 1), a22 = A.get(1, 1);
      double determinant = a11 * a22 - a12 * a12;
      checkPivot(a11, A);
      checkPivot(determinant / a11, A);
      double b1 = b.get(0), b2 = b.get(1);
      double x1 = (a22 * b1 - a12 * b2) / determinant;
      double x2 = (a11 * b2 - a12 * b1) / determinant;
      return new SimpleMatrix(2, 1, true, new double[] {x1, x2});
    };
  }

  /** A pivot as small as rounding is one of a singular matrix. */
  private static void checkPivot(double pivot, SimpleMatrix A) {
    if (!(pivot > 1e-15 * A.trace())) throw notPositiveDefinite();
  }

  private static ArithmeticException notPositiveDefinite() {
    return new ArithmeticException("M(q) is not positive definite");
  }
}
