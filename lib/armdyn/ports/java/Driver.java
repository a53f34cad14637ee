import java.io.BufferedInputStream;
import java.io.DataInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.charset.StandardCharsets;
import org.ejml.simple.SimpleMatrix;

/**
 * Answers requests, messages of numbers on standard input, with numbers on standard output.
 *
 * <p>A message is a count and so many numbers, all little-endian doubles; before an answer come the
 * eight bytes "numbers:". A request opens with what is asked: 0, the terms of the equation of
 * motion, with rows of parameters, q, qd, u; or 1, a simulation, with parameters, x0, u, dt, steps,
 * stride. An argument chooses the solver: "cholesky", which is used without one, or "two-by-two".
 */
final class Driver {
  private static final int N = Model.JOINTS;

  private final LinearSolver solver;

  private Driver(LinearSolver solver) {
    this.solver = solver;
  }

  public static void main(String[] arguments) throws IOException {
    String chosen = arguments.length > 0 ? arguments[0] : "cholesky";
    Driver driver =
        new Driver(
            switch (chosen) {
              case "cholesky" -> LinearSolver.cholesky();
              case "two-by-two" -> LinearSolver.twoByTwo();
              default -> throw new IllegalArgumentException(chosen + ": no such solver");
            });
    DataInputStream in = new DataInputStream(new BufferedInputStream(System.in));
    while (true) {
      DoubleBuffer request;
      try {
        request = numbers(in, (int) numbers(in, 1).get());
      } catch (EOFException end) {
        return;
      }
      write(request.get() == 0 ? driver.terms(request) : driver.simulation(request));
    }
  }

  private DoubleBuffer terms(DoubleBuffer given) {
    int rows = given.remaining() / (Model.PARAMETERS + 3 * N);
    DoubleBuffer answer = DoubleBuffer.allocate(rows * (2 * N * N + 3 * N + 1));
    for (int row = 0; row < rows; ++row) {
      Arm arm = Model.of(next(given, Model.PARAMETERS));
      SimpleMatrix q = column(given);
      SimpleMatrix qd = column(given);
      SimpleMatrix u = column(given);
      append(answer, arm.M(q));
      append(answer, arm.C(q, qd));
      append(answer, arm.g_vec(q));
      append(answer, arm.f_vec(qd));
      answer.put(arm.potential_energy(q));
      append(answer, arm.dynamics(q, qd, u, solver));
    }
    return answer.flip();
  }

  private DoubleBuffer simulation(DoubleBuffer given) {
    Arm arm = Model.of(next(given, Model.PARAMETERS));
    State x = new State(column(given), column(given));
    SimpleMatrix u = column(given);
    double dt = given.get();
    int steps = (int) given.get();
    int stride = (int) given.get();

    DoubleBuffer states = DoubleBuffer.allocate((steps / stride + 1) * 2 * N);
    for (int k = 0; k <= steps; ++k) {
      if (k > 0) x = rk4Step(arm, x, u, dt);
      if (k % stride == 0) {
        append(states, x.q);
        append(states, x.qd);
      }
    }
    return states.flip();
  }

  private record State(SimpleMatrix q, SimpleMatrix qd) {
    /** This state plus s times a rate. */
    State plus(double s, State rate) {
      return new State(q.plus(s, rate.q), qd.plus(s, rate.qd));
    }
  }

  /** The rate of the state: its velocities and accelerations. */
  private State rate(Arm arm, State x, SimpleMatrix u) {
    return new State(x.qd, arm.dynamics(x.q, x.qd, u, solver));
  }

  /** One step of the classical Runge-Kutta method (W. Kutta, 1901), with u held. */
  private State rk4Step(Arm arm, State x, SimpleMatrix u, double dt) {
    State k1 = rate(arm, x, u);
    State k2 = rate(arm, x.plus(dt / 2, k1), u);
    State k3 = rate(arm, x.plus(dt / 2, k2), u);
    State k4 = rate(arm, x.plus(dt, k3), u);
    return x.plus(dt / 6, k1.plus(2, k2).plus(2, k3).plus(1, k4));
  }

  private static double[] next(DoubleBuffer given, int count) {
    double[] numbers = new double[count];
    given.get(numbers);
    return numbers;
  }

  private static SimpleMatrix column(DoubleBuffer given) {
    return new SimpleMatrix(N, 1, true, next(given, N));
  }

  /** A matrix by rows, or a vector. */
  private static void append(DoubleBuffer numbers, SimpleMatrix matrix) {
    for (int i = 0; i < matrix.getNumElements(); ++i) numbers.put(matrix.get(i));
  }

  private static DoubleBuffer numbers(DataInputStream in, int count) throws IOException {
    byte[] bytes = new byte[count * Double.BYTES];
    in.readFully(bytes);
    return ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).asDoubleBuffer();
  }

  private static void write(DoubleBuffer numbers) {
    byte[] mark = "numbers:".getBytes(StandardCharsets.US_ASCII);
    int count = numbers.remaining();
    ByteBuffer message = ByteBuffer.allocate(mark.length + (1 + count) * Double.BYTES);
    message.put(mark).order(ByteOrder.LITTLE_ENDIAN).putDouble(count);
    message.asDoubleBuffer().put(numbers);
    PrintStream out = System.out;
    out.write(message.array(), 0, message.array().length);
    out.flush();
  }
}
