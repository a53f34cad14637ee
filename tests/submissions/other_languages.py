"""Answers to p1's M and p2's C in C++, Java and MATLAB, and notebooks that hold them."""

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell

from tests.submissions.answers import answered, cell_of

LANGUAGES = (".cpp", ".java", ".m")
HEADS = {
    ("M", ".cpp"): "Eigen::Matrix2d M(const Eigen::Vector2d& q, const Arm& arm)",
    ("C", ".cpp"): "Eigen::Matrix2d C(const Eigen::Vector2d& q, const Eigen::Vector2d& qd, "
    "const Arm& arm)",
    ("M", ".java"): "static SimpleMatrix M(SimpleMatrix q, Arm arm)",
    ("C", ".java"): "static SimpleMatrix C(SimpleMatrix q, SimpleMatrix qd, Arm arm)",
    ("M", ".m"): "function value = M(q, arm)",
    ("C", ".m"): "function value = C(q, qd, arm)",
}
PARAMETERS = ("l1", "l2", "lc1", "lc2", "m1", "m2", "I1", "I2")
VECTORS = {
    "M": {"q1": ("q", 0), "q2": ("q", 1)},
    "C": {"q2": ("q", 1), "a": ("qd", 0), "b": ("qd", 1)},
}
# Statements that all these languages, and Python, read in the same way.
FORMULAS = {
    "M": {
        "c": "m2 * l1 * lc2 * {cos}(q2)",
        "M22": "I2 + m2 * lc2 * lc2",
        "M12": "M22 + c",
        "M21": "M12",
        "M11": "I1 + m1 * lc1 * lc1 + M22 + m2 * l1 * l1 + 2 * c",
    },
    "C": {
        "h": "-m2 * l1 * lc2 * {sin}(q2)",
        "C11": "h * b",
        "C12": "h * (a + b)",
        "C21": "-h * a",
        "C22": "0",
    },
}
ENTRY = {".cpp": "{0}({1})", ".java": "{0}.get({1})", ".m": "{0}({2})", ".py": "{0}[{1}]"}
PARAMETER = {".cpp": "arm.{0}", ".java": "arm.{0}()", ".m": "arm.{0}", ".py": "arm.{0}"}
MATHS = {".cpp": "std::", ".java": "Math.", ".m": "", ".py": "np."}
MATRIX = {
    ".cpp": "Eigen::Matrix2d value; value << {0}11, {0}12, {0}21, {0}22; return value;",
    ".java": "return new SimpleMatrix(2, 2, true, new double[] {{{0}11, {0}12, {0}21, {0}22}});",
    ".m": "value = [{0}11, {0}12; {0}21, {0}22];",
    ".py": "return np.array([[{0}11, {0}12], [{0}21, {0}22]])",
}


def body(name: str, suffix: str, first: str = "", changes: str = "") -> str:
    """The lines of a right M or C, in the language, with statements before and after the formulas."""
    maths = {word: MATHS[suffix] + word for word in ("cos", "sin")}
    declared = "double " if suffix in (".cpp", ".java") else ""
    end = "" if suffix == ".py" else ";"
    values = {p: PARAMETER[suffix].format(p) for p in PARAMETERS}
    for symbol, (vector, k) in VECTORS[name].items():
        values[symbol] = ENTRY[suffix].format(vector, k, k + 1)
    formulas = {symbol: text.format(**maths) for symbol, text in FORMULAS[name].items()}
    return "\n".join(
        [
            *(f"{declared}{symbol} = {value}{end}" for symbol, value in values.items()),
            *([first] if first else []),
            *(f"{declared}{symbol} = {value}{end}" for symbol, value in formulas.items()),
            *([changes] if changes else []),
            MATRIX[suffix].format(name),
        ]
    )


def source(name: str, suffix: str, lines: str) -> str:
    """The file of a function with these lines."""
    head = HEADS[name, suffix]
    if suffix == ".cpp":
        return f'#include "arm.hpp"\n#include <cmath>\n{head} {{\n{lines}\n}}\n'
    if suffix == ".java":
        imported = "import org.ejml.simple.SimpleMatrix;"
        return f"{imported}\nclass {name} {{\n{head} {{\n{lines}\n}}\n}}\n"
    return f"{head}\n{lines}\nend\n"


def right(name: str, suffix: str) -> str:
    return source(name, suffix, body(name, suffix))


def in_file(notebook: NotebookNode, name: str, suffix: str, text: str) -> NotebookNode:
    """The notebook with this answer in another language instead."""
    notebook = answered(notebook, **{name: f'{name} = from_file("{name}{suffix}")'})
    at = notebook.cells.index(cell_of(notebook, f"answer-{name}"))
    notebook.cells.insert(at, new_code_cell(f"%%writefile {name}{suffix}\n{text}"))
    return notebook


# What a student's M does depends on arm.g, so that one program shows many ends.
ENDS = {
    ".cpp": """
#include "arm.hpp"
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <stdexcept>
Eigen::MatrixXd M(Eigen::VectorXd q, Arm arm) {
  if (arm.g == 1) throw std::runtime_error("my words");
  if (arm.g == 2) std::raise(SIGSEGV);
  if (arm.g == 3) std::exit(0);
  if (arm.g == 4) for (volatile int i = 0;;) i = 1 - i;
  if (arm.g == 5) return Eigen::MatrixXd::Constant(2, 3, 7);
  if (arm.g == 6) return Eigen::MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN());
  if (arm.g == 7) { std::cout << "numbers" << std::flush; std::printf("printed"); }
  return q.asDiagonal();
}
""",
    ".java": """
import org.ejml.simple.SimpleMatrix;
class M {
  static SimpleMatrix M(SimpleMatrix q, Arm arm) {
    if (arm.g() == 1) throw new IllegalStateException("my words");
    if (arm.g() == 2) q.get(9);
    if (arm.g() == 3) System.exit(0);
    if (arm.g() == 4) while (true) Thread.onSpinWait();
    if (arm.g() == 5) return new SimpleMatrix(2, 3);
    if (arm.g() == 6) return new SimpleMatrix(2, 2, true, new double[] {1, 2, Double.NaN, 4});
    if (arm.g() == 7) { System.out.print("numbers"); System.err.println("printed"); }
    return SimpleMatrix.diag(q.get(0), q.get(1));
  }
}
""",
    ".m": """
function value = M(q, arm)
  if arm.g == 1, error('my words'); end
  if arm.g == 2, q(9); end
  if arm.g == 3, exit(0); end
  while arm.g == 4, end
  if arm.g == 7, disp('numbers'); printf('printed'); end
  value = diag(q);
  if arm.g == 5, value = zeros(2, 3); end
  if arm.g == 6, value = NaN(2); end
end
""",
}

NOT_BUILT = {
    ".cpp": (source("M", ".cpp", "return lenght * q;"), "M.cpp:4:8: ‘lenght’ was not declared"),
    ".java": (
        source("M", ".java", "return lenght;"),
        "M.java:4: cannot find symbol (symbol: variable lenght)",
    ),
    ".m": (source("M", ".m", "value = [1 2; 3 4"), "parse error near line 3 of file M.m"),
}
MISNAMED = {
    ".cpp": (
        source("M", ".cpp", "return Eigen::Matrix2d();").replace(" M(", " Mass("),
        f"M.cpp must define {HEADS['M', '.cpp']}: ",
    ),
    ".java": (
        source("M", ".java", "return q;").replace(" M(", " mass("),
        f"M.java must define class M with {HEADS['M', '.java']}: ",
    ),
}


def hostile(mark: str, port: int, files: list[str]) -> str:
    """An M that counts what it could read, connect to, and start; its children carry `mark`."""
    listed = ", ".join(f'"{file}"' for file in files)
    return f"""
#include "arm.hpp"
#include <arpa/inet.h>
#include <cstdio>
#include <sys/socket.h>
#include <unistd.h>
Eigen::Matrix2d M(const Eigen::Vector2d&, const Arm&) {{
  double files = 0, connected = 0, started = 0;
  for (const char* name : {{{listed}}})
    if (std::FILE* file = std::fopen(name, "r")) ++files, std::fclose(file);
  sockaddr_in address{{}};
  address.sin_family = AF_INET;
  address.sin_port = htons({port});
  inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
  const int line = socket(AF_INET, SOCK_STREAM, 0);
  connected = connect(line, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  for (int k = 0; k < 200; ++k) {{
    const int child = fork();
    if (child < 0) break;
    if (child == 0) {{
      setsid();
      execl("/usr/bin/sleep", "{mark}", "99", nullptr);
      _exit(1);
    }}
    ++started;
  }}
  return (Eigen::Matrix2d() << files, connected, started, 0).finished();
}}
"""
