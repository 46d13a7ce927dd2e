#include "sparse_solver.h"

#include <breakwater/base/exceptions.h>

#include <Amesos_Klu.h>
#include <AztecOO.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_SerialComm.h>
#include <Epetra_Vector.h>

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
    }

    Epetra_SerialComm           communicator;
    Epetra_Map                  map;
    Epetra_CrsMatrix            matrix;
    Epetra_Vector               x, b;
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
                           " places, are singular: are some of them tied twice?");
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
    if (square == 0) // AztecOO divides by it
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
      {
        AztecOO iterative(t.problem);
        iterative.SetAztecOption(AZ_solver, AZ_cg);
        iterative.SetAztecOption(AZ_precond, AZ_Jacobi);
        iterative.SetAztecOption(AZ_conv, AZ_rhs);
        iterative.SetAztecOption(AZ_output, AZ_none);
        iterative.SetAztecOption(AZ_diagnostics, AZ_none);
        const int status = iterative.Iterate(1000, 1e-13);
        if (status != 0 && !(iterative.ScaledResidual() < 1e-11))
          throw BreakdownError("Coupling: conjugate gradients did not solve the equations of the interface in " +
                               std::to_string(iterative.NumIters()) + " iterations.");
        n_iterations = iterative.NumIters();
      }
    for (std::size_t r = 0; r < solution.size(); ++r)
      solution[r] = t.x[r];
    return n_iterations;
  }
} // namespace Breakwater
