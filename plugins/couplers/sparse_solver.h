#pragma once

#include <memory>
#include <vector>

namespace Breakwater
{
  /// Solves sparse, symmetric and positive definite equations with Trilinos: directly (KLU), the factors kept, or by
  /// conjugate gradients with the diagonal as preconditioner.
  class SparseSolver
  {
  public:
    struct Entry
    {
      unsigned int column;
      double       value;
    };
    using Row = std::vector<Entry>;

    SparseSolver(const std::vector<Row> &rows, bool is_direct);
    ~SparseSolver();

    /// @param solution the first guess, then the solution; its residual is at most 1e-13 of the right side
    /// @return the number of iterations, 0 if direct. @throws BreakdownError
    unsigned int solve(const std::vector<double> &right_side, std::vector<double> &solution);

  private:
    struct Trilinos;
    std::unique_ptr<Trilinos> trilinos_;
  };
} // namespace Breakwater
