#pragma once

#include "contacts.h"
#include "delaunay.h"
#include "element_passes.h"

#include <breakwater/mesh/quality.h>

#include <vector>

namespace Breakwater
{
  /// The state of the fluid's nodes, as split arrays. Nodes [0, n_interface) are those of an adopted surface; the
  /// others are numbered along a Hilbert curve.
  template <int dim>
  struct FluidNodes
  {
    std::size_t n           = 0;
    std::size_t n_interface = 0;

    std::vector<Quad> xp;            ///< position x, y, z [m] and pressure [Pa]
    std::vector<Quad> v;             ///< velocity [m/s]
    std::vector<Quad> a;             ///< acceleration at the current time [m/s^2], links and walls included
    std::vector<Quad> force;         ///< force of the fluid's stresses [N]; fourth: flux of density, see kernels.h
    std::vector<Quad> density_slope; ///< density [kg/m^3] and its hydrostatic gradient [kg/m^4], see kernels.h

    std::vector<double> mass;              ///< fluid mass [kg], the same between two remeshes
    std::vector<double> base_density;      ///< rho_b: density at the reference volume [kg/m^3]
    std::vector<double> density;           ///< rho = rho_b / J [kg/m^3]
    std::vector<double> volume;            ///< V: share of the cells around [m^dim], signed
    std::vector<double> reference_volume;  ///< V0: volume at the last remesh
    std::vector<double> stiffness_volume;  ///< Vhat >= V0: what a change of volume is measured by
    std::vector<double> companion_mass;    ///< inertia that an interface node carries for another body [kg]
    std::vector<double> hydrostatic_slope; ///< rho / c^2 at the last remesh [s^2/m^2 kg/m^3]
    std::vector<Quad>   position_at_remesh;

    std::vector<Contacts> contacts;         ///< faces of walls that hold the node now
    std::vector<Contacts> walls;            ///< faces of walls that the node lay on at the last remesh
    std::vector<double>   slip_conductance; ///< area over slip length of the walls around, if any slips [m^(dim - 2)]
    std::vector<char>     is_surface;       ///< on a facet that neither wall nor interface closes
    std::vector<char>     has_cells;        ///< false: isolated, flies ballistically
    std::vector<std::uint8_t> inflow;       ///< the inflow that drives the node, counted from 1; 0: none

    /// Of the node at the last triangulation; no_cell for nodes that are new since then.
    std::vector<unsigned int> number_in_triangulation;

    /// Calls visit with every array of one entry per node, of these nodes or constant ones.
    template <class Nodes, class Visitor>
    static void visit_arrays(Nodes &nodes, const Visitor &visit)
    {
      visit(nodes.xp);
      visit(nodes.v);
      visit(nodes.a);
      visit(nodes.force);
      visit(nodes.density_slope);
      visit(nodes.mass);
      visit(nodes.base_density);
      visit(nodes.density);
      visit(nodes.volume);
      visit(nodes.reference_volume);
      visit(nodes.stiffness_volume);
      visit(nodes.companion_mass);
      visit(nodes.hydrostatic_slope);
      visit(nodes.position_at_remesh);
      visit(nodes.contacts);
      visit(nodes.walls);
      visit(nodes.slip_conductance);
      visit(nodes.is_surface);
      visit(nodes.has_cells);
      visit(nodes.inflow);
    }

    void resize(const std::size_t size)
    {
      n = size;
      visit_arrays(*this, [size](auto &values) {
        values.resize(size);
      });
      number_in_triangulation.resize(size, no_cell);
    }

    /// Calls visit() with each array that a node takes along through a remesh; the others are made anew.
    template <class Visitor>
    void visit_carried(const Visitor &visit)
    {
      visit(xp);
      visit(v);
      visit(a);
      visit(mass);
      visit(base_density);
      visit(density);
      visit(contacts);
      visit(inflow);
      visit(is_surface);
      visit(has_cells);
      visit(number_in_triangulation);
    }

    /// Takes nodes away; the others keep their order. What is not carried through a remesh is void then.
    /// @pre no interface node leaves
    void remove(const std::vector<char> &leaves)
    {
      std::size_t n_left = 0;
      visit_carried([&](auto &values) {
        n_left = 0;
        for (std::size_t i = 0; i < n; ++i)
          if (!leaves[i])
            values[n_left++] = values[i];
      });
      resize(n_left);
    }

    /// True if the node's motion is given by another body or an inflow: only forces that tell of the fluid's stress
    /// act on it, nothing else moves it or changes its mass.
    bool is_driven(const std::size_t i) const { return i < n_interface || inflow[i] != 0; }

    /// True if the node takes part in the mass exchange.
    bool exchanges_mass(const std::size_t i) const { return has_cells[i] && !is_driven(i); }

    Vec<dim> position(const std::size_t i) const { return vec(xp[i]); }
    Vec<dim> velocity(const std::size_t i) const { return vec(v[i]); }

    /// Mass that resists a force on the node [kg].
    double inertia(const std::size_t i) const { return mass[i] + companion_mass[i]; }

    /// sum of m x cross v about the origin [kg m^2/s]; in 2D only the component along z is not zero.
    Vec<3> angular_momentum() const
    {
      Vec<3> result;
      for (std::size_t i = 0; i < n; ++i)
        for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
          {
            const int e = (d + 1) % 3, f = (d + 2) % 3;
            result[d] += mass[i] * (xp[i][e] * v[i][f] - xp[i][f] * v[i][e]);
          }
      return result;
    }

    static Vec<dim> vec(const Quad &q)
    {
      Vec<dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = q[d];
      return result;
    }

    /// The corners of a cell.
    Simplex<dim> corners(const typename SimplexMesh<dim>::Cell &cell) const
    {
      Simplex<dim> x;
      for (int a = 0; a <= dim; ++a)
        x[a] = position(cell[a]);
      return x;
    }

    std::vector<Vec<dim>> positions() const
    {
      std::vector<Vec<dim>> result(n);
      for (std::size_t i = 0; i < n; ++i)
        result[i] = position(i);
      return result;
    }
  };
} // namespace Breakwater
