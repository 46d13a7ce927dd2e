#pragma once

#include <breakwater/mesh/quality.h>
#include <gtest/gtest.h>
#include <pfem_fluid/alpha_shape.h>
#include <pfem_fluid/fluid_nodes.h>
#include <pfem_fluid/kernels.h>
#include <pfem_fluid/lattice.h>

#include <random>
#include <type_traits>

namespace Breakwater
{
  /// Two and three dimensions, for typed tests.
  using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  constexpr double spacing = 0.1; ///< h of all clouds here [m]

  /// Random numbers that are the same everywhere, between -1 and 1.
  class Noise
  {
  public:
    explicit Noise(const unsigned int seed)
      : engine_(seed)
    {
    }
    double operator()() { return 2. * engine_() / std::mt19937::max() - 1.; }

    template <int dim>
    Vec<dim> vec()
    {
      Vec<dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = (*this)();
      return result;
    }

  private:
    std::mt19937 engine_;
  };

  /// A box and the lattice that fills it.
  template <int dim>
  struct BoxState
  {
    BoxShape<dim> shape;
    Lattice       lattice;
  };

  template <int dim>
  std::vector<Vec<dim>> fill_box(const BoxState<dim> &state, const double h)
  {
    return fill_box(state.shape, state.lattice, h);
  }

  /// A box of the size (0.6, 0.9, 0.7) m from a corner.
  template <int dim>
  BoxState<dim> box_state(const Vec<dim> &lower = {}, const unsigned int seed = 1)
  {
    constexpr double size[3] = {0.6, 0.9, 0.7};
    BoxState<dim>    state;
    state.lattice.seed = seed;
    state.shape.lower = state.shape.upper = lower;
    for (int d = 0; d < dim; ++d)
      state.shape.upper[d] += size[d];
    return state;
  }

  template <int dim>
  double box_volume(const BoxState<dim> &state)
  {
    double volume = 1;
    for (int d = 0; d < dim; ++d)
      volume *= state.shape.upper[d] - state.shape.lower[d];
    return volume;
  }

  template <int dim>
  DelaunayMesh<dim> triangulation_of(const std::vector<Vec<dim>> &position)
  {
    DelaunayMesh<dim> triangulation;
    triangulation.rebuild(position);
    return triangulation;
  }

  template <int dim>
  SimplexMesh<dim> mesh_of(const std::vector<Vec<dim>> &position, const double alpha = 1.25)
  {
    return alpha_shape<dim>(triangulation_of<dim>(position), alpha * spacing, [](const auto &) {
      return true;
    });
  }

  template <int dim>
  double volume_of(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position)
  {
    double volume = 0;
    for (const auto &cell : mesh.cells)
      volume += signed_volume(corners<dim>(position, cell));
    return volume;
  }

  /// A block of water at rest, its mesh and the state of its nodes: density 1000 kg/m^3, m = rho V.
  template <int dim>
  struct Block
  {
    static constexpr double density = 1000;

    SimplexMesh<dim> mesh;
    FluidNodes<dim>  nodes;

    explicit Block(const unsigned int seed = 1)
    {
      const std::vector<Vec<dim>> position = fill_box(box_state<dim>({}, seed), spacing);
      mesh                                 = mesh_of<dim>(position);
      nodes.resize(position.size());
      for (std::size_t i = 0; i < nodes.n; ++i)
        {
          for (int d = 0; d < dim; ++d)
            nodes.xp[i][d] = position[i][d];
          nodes.has_cells[i] = 1;
          nodes.density[i]   = density;
        }
      for (const auto &facet : mesh.boundary)
        for (const unsigned int i : facet)
          nodes.is_surface[i] = 1;
      compute_volumes<dim>(mesh.cells, nodes.xp, nodes.volume);
      for (std::size_t i = 0; i < nodes.n; ++i)
        nodes.mass[i] = density * nodes.volume[i];
    }
  };

  /// Sums over the nodes, and the least mass.
  template <int dim>
  struct Totals
  {
    double   mass = 0, kinetic_energy = 0, square_excess = 0, least_mass = 1e300;
    Vec<dim> momentum;

    explicit Totals(const FluidNodes<dim> &nodes)
    {
      for (std::size_t i = 0; i < nodes.n; ++i)
        {
          mass += nodes.mass[i];
          momentum += nodes.velocity(i) * nodes.mass[i];
          kinetic_energy += 0.5 * nodes.mass[i] * dot(nodes.velocity(i), nodes.velocity(i));
          square_excess += std::pow(nodes.mass[i] - nodes.density[i] * nodes.volume[i], 2);
          least_mass = std::min(least_mass, nodes.mass[i]);
        }
    }
  };
} // namespace Breakwater
