#include "sparse_solver.h"

#include <breakwater/base/exceptions.h>

#include <Amesos_Klu.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_SerialComm.h>
#include <Epetra_Vector.h>

#include <cmath>
#include <string>

namespace Breakwater
{
  struct SparseSolver::Trilinos
  {
    explicit Trilinos(const std::vector<Row> &rows)
      : map(static_cast<int>(rows.size()), 0, communicator)
      , matrix(Copy, map, 0)
      , x(map)
      , b(map)
      , diagonal(map)
      , problem(&matrix, &x, &b)
    {
      std::vector<int>    columns;
      std::vector<double> values;
      for (std::size_t r = 0; r < rows.size(); ++r)
        {
          columns.clear();
          values.clear();
          for (const Entry &entry : rows[r])
            {
              columns.push_back(static_cast<int>(entry.column));
              values.push_back(entry.value);
            }
          matrix.InsertGlobalValues(static_cast<int>(r), static_cast<int>(columns.size()), values.data(),
                                    columns.data());
        }
      matrix.FillComplete();
      matrix.ExtractDiagonalCopy(diagonal);
    }

    /// From x; the matrix's diagonal is the preconditioner. @return the number of iterations
    unsigned int solve_by_conjugate_gradients(const double norm_of_b)
    {
      constexpr unsigned int most = 1000;
      Epetra_Vector          r(b), z(map), p(map), q(map);
      matrix.Multiply(false, x, q);
      r.Update(-1., q, 1.);
      z.ReciprocalMultiply(1., diagonal, r, 0.);
      p              = z;
      double product = 0, norm = 0;
      r.Dot(z, &product);
      r.Norm2(&norm);
      unsigned int k = 0;
      for (; k < most && norm > 1e-13 * norm_of_b; ++k)
        {
          double curvature = 0, next = 0;
          matrix.Multiply(false, p, q);
          p.Dot(q, &curvature);
          x.Update(product / curvature, p, 1.);
          r.Update(-product / curvature, q, 1.);
          z.ReciprocalMultiply(1., diagonal, r, 0.);
          r.Dot(z, &next);
          p.Update(1., z, next / product);
          product = next;
          r.Norm2(&norm);
        }
      if (!(norm <= 1e-13 * norm_of_b))
        throw BreakdownError("Coupling: conjugate gradients did not solve the equations of the interface in " +
                             std::to_string(most) + " iterations.");
      return k;
    }

    Epetra_SerialComm           communicator;
    Epetra_Map                  map;
    Epetra_CrsMatrix            matrix;
    Epetra_Vector               x, b, diagonal;
    Epetra_LinearProblem        problem;
    std::unique_ptr<Amesos_Klu> direct;
  };


  SparseSolver::SparseSolver(const std::vector<Row> &rows, const bool is_direct)
    : trilinos_(std::make_unique<Trilinos>(rows))
  {
    if (!is_direct)
      return;
    trilinos_->direct = std::make_unique<Amesos_Klu>(trilinos_->problem);
    if (trilinos_->direct->SymbolicFactorization() != 0 || trilinos_->direct->NumericFactorization() != 0)
      throw BreakdownError("Coupling: the equations of the interface, " + std::to_string(rows.size()) +
                           " unknowns, are singular: are some places tied twice?");
  }


  SparseSolver::~SparseSolver() = default;


  unsigned int SparseSolver::solve(const std::vector<double> &right_side, std::vector<double> &solution)
  {
    Trilinos &t      = *trilinos_;
    double    square = 0;
    for (std::size_t r = 0; r < right_side.size(); ++r)
      {
        t.b[r] = right_side[r];
        t.x[r] = solution[r];
        square += right_side[r] * right_side[r];
      }
    if (square == 0)
      {
        solution.assign(solution.size(), 0.);
        return 0;
      }

    unsigned int n_iterations = 0;
    if (t.direct)
      {
        if (t.direct->Solve() != 0)
          throw BreakdownError("Coupling: the equations of the interface could not be solved.");
      }
    else
      n_iterations = t.solve_by_conjugate_gradients(std::sqrt(square));
    for (std::size_t r = 0; r < solution.size(); ++r)
      solution[r] = t.x[r];
    return n_iterations;
  }
} // namespace Breakwater
