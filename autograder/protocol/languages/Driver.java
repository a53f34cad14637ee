import java.io.BufferedInputStream;
import java.io.DataInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import org.ejml.data.DMatrixRMaj;
import org.ejml.simple.SimpleMatrix;

/** Reads states and arms, writes what the student's method makes of them. */
final class Driver {
  private static final byte[] MARK = "numbers:".getBytes(StandardCharsets.US_ASCII);

  public static void main(String[] arguments) throws IOException {
    DataInputStream requests = new DataInputStream(new BufferedInputStream(System.in));
    PrintStream answers = System.out;
    try {
      while (true) {
        double[] request = read(requests, (int) read(requests, 1)[0]);
        // Nothing is asked to see whether the program has started.
        SimpleMatrix value = request.length == 0 ? new SimpleMatrix(0, 0) : answer(request);
        System.out.flush();
        answers.write(written(value));
        answers.flush();
      }
    } catch (EOFException end) {
      System.exit(0); // also where the student's code has threads of its own
    }
  }

  private static SimpleMatrix answer(double[] x) {
    SimpleMatrix q = new SimpleMatrix(2, 1, true, new double[] {x[0], x[1]});
    SimpleMatrix qd = new SimpleMatrix(2, 1, true, new double[] {x[2], x[3]});
    Arm arm = new Arm(x[4], x[5], x[6], x[7], x[8], x[9], x[10], x[11], x[12]);
    SimpleMatrix value = $NAME.$NAME($ARGUMENTS);
    if (value == null) throw new NullPointerException("$NAME returned null");
    return value;
  }

  private static double[] read(DataInputStream requests, int count) throws IOException {
    byte[] bytes = new byte[Double.BYTES * count];
    requests.readFully(bytes);
    double[] numbers = new double[count];
    ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).asDoubleBuffer().get(numbers);
    return numbers;
  }

  private static byte[] written(SimpleMatrix value) {
    DMatrixRMaj matrix = value.getDDRM();
    int count = matrix.numRows * matrix.numCols + 2;
    ByteBuffer bytes = ByteBuffer.allocate(MARK.length + Double.BYTES * (count + 1));
    bytes.put(MARK).order(ByteOrder.LITTLE_ENDIAN);
    bytes.putDouble(count).putDouble(matrix.numRows).putDouble(matrix.numCols);
    for (int i = 0; i < matrix.numRows; i++)
      for (int j = 0; j < matrix.numCols; j++) bytes.putDouble(matrix.get(i, j));
    return bytes.array();
  }
}
