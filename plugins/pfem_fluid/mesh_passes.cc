#include "four_cells.h"

// Loops over cells that remeshing needs, compiled once per instruction set (see element_passes.cc).

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    namespace
    {
      template <int dim>
      inline V4 dot(const V4 *a, const V4 *b)
      {
        V4 sum = a[0] * b[0];
        for (int d = 1; d < dim; ++d)
          sum += a[d] * b[d];
        return sum;
      }

      template <int dim>
      void volume_changes(const unsigned int *cells, const std::size_t n_cells, const Quad *xp, const Quad *u,
                          double *change)
      {
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 x[dim + 1][4], move[4];
            for (int a = 0; a <= dim; ++a)
              four.gather(xp, a, x[a]);
            const Geometry<dim> geometry(x);
            V4                  sum = all(0.);
            for (int a = 0; a <= dim; ++a)
              {
                four.gather(u, a, move);
                sum += dot<dim>(geometry.area[a], move);
              }
            sum *= all(1. / (dim + 1));
            for (std::size_t k = 0; k < four.n; ++k)
              for (int a = 0; a <= dim; ++a)
                change[four.node(k, a)] += sum[k];
          });
      }

      template <int dim>
      void cell_volumes(const unsigned int *cells, const std::size_t n_cells, const Quad *xp, double *volume)
      {
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 x[dim + 1][4];
            for (int a = 0; a <= dim; ++a)
              four.gather(xp, a, x[a]);
            const Geometry<dim> geometry(x);
            for (std::size_t k = 0; k < four.n; ++k)
              volume[four.first + k] = geometry.volume[k];
          });
      }

      template <int dim>
      void insphere_radii(const unsigned int *cells, const std::size_t n_cells, const Quad *xp, double *radius)
      {
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 x[dim + 1][4], length[dim + 1];
            for (int a = 0; a <= dim; ++a)
              four.gather(xp, a, x[a]);
            const Geometry<dim> geometry(x);
            for (int a = 0; a <= dim; ++a)
              length[a] = dot<dim>(geometry.area[a], geometry.area[a]);
            for (std::size_t k = 0; k < four.n; ++k)
              {
                double sum = 0;
                for (int a = 0; a <= dim; ++a)
                  sum += __builtin_sqrt(length[a][k]);
                radius[four.first + k] = sum > 0 ? geometry.volume[k] / sum : 0.;
              }
          });
      }

      template <int dim>
      void edge_squares(const unsigned int *cells, const std::size_t n_cells, const Quad *xp, double *shortest,
                        double *longest)
      {
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 x[dim + 1][4], least = all(1e300), most = all(0.);
            for (int a = 0; a <= dim; ++a)
              four.gather(xp, a, x[a]);
            for (int a = 1; a <= dim; ++a)
              for (int b = 0; b < a; ++b)
                {
                  V4 edge[dim];
                  for (int d = 0; d < dim; ++d)
                    edge[d] = x[a][d] - x[b][d];
                  const V4 square = dot<dim>(edge, edge);
                  least           = smaller(least, square);
                  most            = larger(most, square);
                }
            for (std::size_t k = 0; k < four.n; ++k)
              {
                shortest[four.first + k] = least[k];
                longest[four.first + k]  = most[k];
              }
          });
      }
    } // namespace


    template <int dim>
    void set_mesh_passes(ElementPasses &passes)
    {
      passes.volume_changes = volume_changes<dim>;
      passes.cell_volumes   = cell_volumes<dim>;
      passes.insphere_radii = insphere_radii<dim>;
      passes.edge_squares   = edge_squares<dim>;
    }

    template void set_mesh_passes<2>(ElementPasses &);
    template void set_mesh_passes<3>(ElementPasses &);
  } // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
