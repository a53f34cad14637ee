// Reads states and arms, writes what the student's function makes of them.
#include "arm.hpp"
#include "$NAME.cpp"

#include <cstdio>
#include <iostream>
#include <vector>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

namespace armdyn_driver {

bool read(double* numbers, std::size_t count) {
  return std::fread(numbers, sizeof(double), count, stdin) == count;
}

Eigen::MatrixXd answer(const std::vector<double>& x) {
  const Eigen::Vector2d q(x[0], x[1]);
  [[maybe_unused]] const Eigen::Vector2d qd(x[2], x[3]);
  const Arm arm{x[4], x[5], x[6], x[7], x[8], x[9], x[10], x[11], x[12]};
  return $NAME($ARGUMENTS);
}

void write(const Eigen::MatrixXd& value) {
  std::vector<double> numbers{static_cast<double>(value.size() + 2),
                              static_cast<double>(value.rows()),
                              static_cast<double>(value.cols())};
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    for (Eigen::Index j = 0; j < value.cols(); ++j) numbers.push_back(value(i, j));
  std::cout.flush();
  std::fwrite("numbers:", 1, 8, stdout);
  std::fwrite(numbers.data(), sizeof(double), numbers.size(), stdout);
  std::fflush(stdout);
}

}  // namespace armdyn_driver

int main() {
#ifdef _WIN32
  _setmode(_fileno(stdin), _O_BINARY);
  _setmode(_fileno(stdout), _O_BINARY);
#endif
  for (double count; armdyn_driver::read(&count, 1);) {
    std::vector<double> request(static_cast<std::size_t>(count));
    if (!armdyn_driver::read(request.data(), request.size())) break;
    // Nothing is asked to see whether the program has started.
    armdyn_driver::write(request.empty() ? Eigen::MatrixXd() : armdyn_driver::answer(request));
  }
}
