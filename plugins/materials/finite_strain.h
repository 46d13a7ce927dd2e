#pragma once

namespace Breakwater
{
  /// F = 1 + H and what laws of large strain need of it, in three dimensions: in 2D nothing happens across the plane.
  struct FiniteStrain
  {
    /// @param displacement_gradient H, [dim][dim]
    template <int dim>
    static FiniteStrain from(const double *displacement_gradient)
    {
      FiniteStrain strain;
      double(&f)[3][3] = strain.f;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          f[i][j] += displacement_gradient[i * dim + j];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            strain.inverse_transposed[i][j] = f[a][c] * f[b][d] - f[a][d] * f[b][c]; // the cofactor
          }
      for (int j = 0; j < 3; ++j)
        strain.volume_ratio += f[0][j] * strain.inverse_transposed[0][j];
      for (auto &row : strain.inverse_transposed)
        for (double &entry : row)
          entry /= strain.volume_ratio;
      return strain;
    }

    double f[3][3]                  = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double inverse_transposed[3][3] = {}; ///< F^-T
    double volume_ratio             = 0;  ///< J = det F
  };

  /// tr(A^T A)
  inline double square(const double (&a)[3][3])
  {
    double sum = 0;
    for (const auto &row : a)
      for (const double entry : row)
        sum += entry * entry;
    return sum;
  }
} // namespace Breakwater
