"""Programs around generated source: each reads a line of numbers and answers with one.

In: the model's place in MODELS, its parameters, q, q̇, u. Out: M and C by rows, g, P, q̈.
"""

import subprocess
from pathlib import Path

from armdyn.codegen.cpp import cpp
from armdyn.codegen.java import java
from armdyn.codegen.matlab import matlab

CPP = """
#include <iomanip>
#include <iostream>
#include <sstream>
#include <vector>
%(includes)s
template <class Numbers> void write(const Numbers& numbers) {
  for (int i = 0; i < numbers.rows(); ++i)
    for (int j = 0; j < numbers.cols(); ++j) std::cout << numbers(i, j) << ' ';
}

template <class Arm> void answer(const Arm& arm, const double* x) {
  typedef typename Arm::Vector Vector;
  const Vector q = Vector::Map(x), qd = Vector::Map(x + q.size());
  const Vector u = Vector::Map(x + 2 * q.size());
  write(arm.M(q));
  write(arm.C(q, qd));
  write(arm.g_vec(q));
  std::cout << arm.potential_energy(q) << ' ';
  write(arm.dynamics(q, qd, u));
  std::cout << std::endl;
}

int main() {
  std::cout << std::setprecision(17);
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream text(line);
    std::vector<double> x;
    for (double number; text >> number;) x.push_back(number);
    if (x.empty()) continue;
%(cases)s
  }
}
"""

JAVA = """
import java.util.Arrays;
import java.util.Scanner;
import org.ejml.simple.SimpleMatrix;

class Driver {
  static void write(SimpleMatrix numbers) {
    for (int i = 0; i < numbers.getNumElements(); ++i) System.out.print(numbers.get(i) + " ");
  }

  static SimpleMatrix column(double[] x, int from, int n) {
    return new SimpleMatrix(n, 1, true, Arrays.copyOfRange(x, from, from + n));
  }

  public static void main(String[] arguments) {
    Scanner in = new Scanner(System.in);
    while (in.hasNextLine()) {
      String line = in.nextLine();
      if (line.isEmpty()) continue;
      double[] x = Arrays.stream(line.split(" ")).mapToDouble(Double::parseDouble).toArray();
%(cases)s
      System.out.println();
    }
  }
}
"""

JAVA_CASE = """      if (x[0] == %(place)d) {
        var arm = new %(name)s(%(parameters)s);
        var q = column(x, %(q)d, %(n)d);
        var qd = column(x, %(qd)d, %(n)d);
        var u = column(x, %(u)d, %(n)d);
        write(arm.M(q));
        write(arm.C(q, qd));
        write(arm.g_vec(q));
        System.out.print(arm.potential_energy(q) + " ");
        write(arm.dynamics(q, qd, u));
      }
"""

OCTAVE = """
while ischar(line = fgetl(stdin))
  if isempty(line)
    continue
  end
  x = sscanf(line, "%%g");
%(cases)s
  if !isempty(lastwarn)
    error(lastwarn)
  end
  printf("%%.17g ", answer);
  printf("\\n");
  fflush(stdout);
end
"""

OCTAVE_CASE = """  if x(1) == %(place)d
    arm = struct(%(fields)s);
    q = x(%(q)d + (1:%(n)d));
    qd = x(%(qd)d + (1:%(n)d));
    u = x(%(u)d + (1:%(n)d));
    answer = [%(name)s.M(q, arm)'(:); %(name)s.C(q, qd, arm)'(:); %(name)s.g_vec(q, arm)
              %(name)s.potential_energy(q, arm); %(name)s.dynamics(q, qd, u, arm)];
  end
"""


def cpp_program(models, folder: Path, needs) -> list[str]:
    """The command of a C++ program around the models, built with every warning an error."""
    compiler, eigen = needs("g++"), Path(needs("libeigen3-dev")).parents[1]
    cases = []
    for place, (name, derivation) in enumerate(models.items()):
        (folder / f"{name}.hpp").write_text(cpp(derivation, name), encoding="ascii")
        count = len(derivation.parameters)
        values = ", ".join(f"x[{i + 1}]" for i in range(count))
        cases.append(f"    if (x[0] == {place}) answer({name}{{{values}}}, &x[{count + 1}]);")
    includes = "".join(f'#include "{name}.hpp"\n' for name in models)
    source, program = folder / "driver.cpp", folder / "driver"
    source.write_text(CPP % {"includes": includes, "cases": "\n".join(cases)}, encoding="ascii")
    flags = ["-std=c++11", "-Wall", "-Wextra", "-Wshadow", "-Wpedantic", "-Werror"]
    run([compiler, *flags, f"-isystem{eigen}", source, "-o", program])
    return [program]


def java_program(models, folder: Path, needs) -> list[str]:
    """The command of a Java program around the models."""
    compiler, jars = Path(needs("default-jdk-headless")), Path(needs("libejml-java")).parent
    for name, derivation in models.items():
        (folder / f"{name}.java").write_text(java(derivation, name), encoding="ascii")
    cases = "".join(JAVA_CASE % _case(*entry) for entry in enumerate(models.items()))
    (folder / "Driver.java").write_text(JAVA % {"cases": cases}, encoding="ascii")
    path = ":".join(map(str, [folder, *sorted(jars.glob("ejml-*.jar"))]))
    run([compiler, "-Xlint:all,-path", "-Werror", "-cp", path, *sorted(folder.glob("*.java"))])
    return [compiler.with_name("java"), "-Xshare:auto", "-cp", path, "Driver"]


def octave_program(models, folder: Path, needs) -> list[str]:
    """The command of an Octave script around the models."""
    octave = needs("octave")
    for name, derivation in models.items():
        for file, source in matlab(derivation, name).items():
            (folder / file).parent.mkdir(exist_ok=True)
            (folder / file).write_text(source, encoding="ascii")
    cases = "".join(OCTAVE_CASE % _case(*entry) for entry in enumerate(models.items()))
    script = folder / "driver.m"
    script.write_text(OCTAVE % {"cases": cases}, encoding="ascii")
    return [octave, "--norc", "--quiet", "--path", folder, script]


def _case(place, model):
    name, derivation = model
    n, count = derivation.n, len(derivation.parameters)
    # The cart's mass M has a mark: M is the inertia matrix.
    written = [{"M": "M_"}.get(s.name, s.name) for s in derivation.parameters]
    return {
        "place": place,
        "name": name,
        "parameters": ", ".join(f"x[{i + 1}]" for i in range(count)),
        "fields": ", ".join(f'"{field}", x({i + 2})' for i, field in enumerate(written)),
        "n": n,
        "q": count + 1,
        "qd": count + 1 + n,
        "u": count + 1 + 2 * n,
    }


def run(command):
    """Run a compiler; AssertionError with what it says, if it says anything."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert not said.strip(), said


class Conversation:
    """A running program that answers a line of numbers with a line of numbers."""

    def __init__(self, command):
        self.command = command

    def __enter__(self):
        pipe = subprocess.PIPE
        self.program = subprocess.Popen(self.command, stdin=pipe, stdout=pipe, text=True)
        return self

    def __call__(self, numbers) -> list[float]:
        # Octave gives a line when it has seen what follows it.
        self.program.stdin.write(" ".join(repr(float(x)) for x in numbers) + "\n\n")
        self.program.stdin.flush()
        line = self.program.stdout.readline()
        assert line, "the program ended without an answer; its error is above"
        return [float(x) for x in line.split()]

    def __exit__(self, *_):
        self.program.stdin.close()
        self.program.stdout.close()
        self.program.wait()
