// Answers requests, messages of numbers on standard input, with numbers on standard output.
//
// A message is a count and so many numbers, all doubles; before an answer come the eight bytes
// "numbers:". A request opens with what is asked: 0, the terms of the equation of motion, with rows
// of parameters, q, qd, u; or 1, a simulation, with parameters, x0, u, dt, steps, stride.
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <vector>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

#include "model.hpp"

namespace {

using Numbers = std::vector<double>;
using Vector = Arm::Vector;

constexpr int n = Vector::RowsAtCompileTime;

struct State {
  Vector q;
  Vector qd;
};

State operator+(const State& a, const State& b) { return {a.q + b.q, a.qd + b.qd}; }

State operator*(double s, const State& a) { return {s * a.q, s * a.qd}; }

// The rate of the state: its velocities and accelerations.
State rate(const Arm& arm, const State& x, const Vector& u) {
  return {x.qd, arm.dynamics(x.q, x.qd, u)};
}

// One step of the classical Runge-Kutta method (W. Kutta, 1901), with u held.
State rk4_step(const Arm& arm, const State& x, const Vector& u, double dt) {
  const State k1 = rate(arm, x, u);
  const State k2 = rate(arm, x + dt / 2 * k1, u);
  const State k3 = rate(arm, x + dt / 2 * k2, u);
  const State k4 = rate(arm, x + dt * k3, u);
  return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

// A matrix by rows, or a vector, at the end of the numbers.
template <class Derived>
void append(Numbers& numbers, const Eigen::MatrixBase<Derived>& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) numbers.push_back(matrix(i, j));
}

Numbers terms(const double* row, const double* end) {
  constexpr int width = parameters + 3 * n;
  Numbers answer;
  answer.reserve(static_cast<std::size_t>((end - row) / width * (2 * n * n + 3 * n + 1)));
  for (; end - row >= width; row += width) {
    const Arm arm = arm_of(row);
    const Vector q = Vector::Map(row + parameters);
    const Vector qd = Vector::Map(row + parameters + n);
    const Vector u = Vector::Map(row + parameters + 2 * n);
    append(answer, arm.M(q));
    append(answer, arm.C(q, qd));
    append(answer, arm.g_vec(q));
    append(answer, arm.f_vec(qd));
    answer.push_back(arm.potential_energy(q));
    append(answer, arm.dynamics(q, qd, u));
  }
  return answer;
}

Numbers simulation(const double* given) {
  const Arm arm = arm_of(given);
  const double* x0 = given + parameters;
  State x{Vector::Map(x0), Vector::Map(x0 + n)};
  const Vector u = Vector::Map(x0 + 2 * n);
  const double* run = x0 + 3 * n;
  const double dt = run[0];
  const auto steps = static_cast<long>(run[1]), stride = static_cast<long>(run[2]);

  Numbers states;
  for (long k = 0; k <= steps; ++k) {
    if (k > 0) x = rk4_step(arm, x, u, dt);
    if (k % stride == 0) {
      append(states, x.q);
      append(states, x.qd);
    }
  }
  return states;
}

bool read(double* numbers, std::size_t count) {
  return std::fread(numbers, sizeof(double), count, stdin) == count;
}

void write(const Numbers& numbers) {
  const auto count = static_cast<double>(numbers.size());
  std::fputs("numbers:", stdout);
  std::fwrite(&count, sizeof count, 1, stdout);
  std::fwrite(numbers.data(), sizeof(double), numbers.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

int main() {
#ifdef _WIN32
  _setmode(_fileno(stdin), _O_BINARY);
  _setmode(_fileno(stdout), _O_BINARY);
#endif
  try {
    for (double count; read(&count, 1);) {
      Numbers request(static_cast<std::size_t>(count));
      if (!read(request.data(), request.size())) break;
      const double* given = request.data() + 1;
      write(request[0] == 0 ? terms(given, request.data() + request.size()) : simulation(given));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
