#include "alpha_shape.h"
#include "pfem_fluid.h"
#include "remesh_record.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

// The state at time 0.

namespace Breakwater
{
  namespace
  {
    /// The value of an expression of the initial state. @throws InputError if it is not finite
    template <int dim>
    double finite_value(const Expression<dim> &expression, const Vec<dim> &x, const unsigned int component,
                        const std::string &entry)
    {
      const double value = expression.value(x, 0, component);
      if (!std::isfinite(value))
        {
          std::ostringstream message;
          message << "The expression of Fluid/Pfem/Initial state/" << entry << " has no finite value at (";
          for (int d = 0; d < dim; ++d)
            message << (d == 0 ? "" : ", ") << x[d];
          throw InputError(message.str() + ") m.");
        }
      return value;
    }

    /// For each node one of its body: nodes are of the same body if a chain of cells connects them.
    template <int dim>
    std::vector<unsigned int> bodies(const SimplexMesh<dim> &mesh, const std::size_t n_nodes)
    {
      std::vector<unsigned int> parent(n_nodes);
      std::iota(parent.begin(), parent.end(), 0u);
      const auto root = [&](unsigned int i) {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      };
      for (const auto &cell : mesh.cells)
        for (int a = 1; a <= dim; ++a)
          parent[root(cell[a])] = root(cell[0]);
      for (std::size_t i = 0; i < n_nodes; ++i)
        parent[i] = root(i);
      return parent;
    }
  } // namespace


  template <int dim>
  void PfemFluid<dim>::make_initial_state()
  {
    place_initial_nodes();
    update_body_acceleration();
    triangulate([&](const auto &cell) {
      Vec<dim> center;
      for (const unsigned int i : cell)
        center += nodes_.position(i) * (1. / (dim + 1));
      return parameters_.initial_state.shape->distance(center) <= 0.1 * parameters_.size(center);
    });
    RemeshRecord record;
    smooth_mesh(record);
    set_initial_velocity();
    set_initial_pressure();
    update_volumes();
    classify_nodes();
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        nodes_.mass[i] = nodes_.density[i] * nodes_.volume[i];
        if (i >= nodes_.n_interface && !nodes_.has_cells[i])
          nodes_.mass[i] = nodes_.density[i] * regular_volume<dim>(parameters_.size(nodes_.position(i)));
      }
    find_slip_neighbours();
    set_references(NodePairs<dim>(nodes_, mesh_.cells));
    update_pressure();
    update_forces();
    accelerate(0);
    refresh_surface();
  }


  template <int dim>
  void PfemFluid<dim>::place_initial_nodes()
  {
    const InitialState<dim> &initial = parameters_.initial_state;
    std::vector<Vec<dim>>    place;
    if (initial.shape)
      place = initial.shape->place_nodes(parameters_.size, initial.lattice);
    place.erase(std::remove_if(place.begin(), place.end(),
                               [&](const Vec<dim> &x) {
                                 const double h = parameters_.size(x);
                                 return !adopted_.empty() && adopted_.signed_distance(x, h) < 0.4 * h;
                               }),
                place.end());
    if (initial.shape)
      place = parameters_.walls.fit(place, parameters_.size, [&](const Vec<dim> &x) {
        return initial.shape->distance(x) <= 1e-3 * parameters_.spacing;
      });
    if (place.empty() && initial.shape)
      throw InputError("The initial state of the fluid has no nodes: its spacing of " +
                       std::to_string(parameters_.spacing) + " m is too large for its shape.");
    const std::vector<unsigned int> order = hilbert_order(place);

    const WetSurface<dim> &surface = adopted_.surface();
    set_up_slip();
    nodes_.n_interface = adopted_.n_nodes();
    nodes_.resize(nodes_.n_interface + place.size());
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      {
        nodes_.companion_mass[i] = surface.mass[i];
        for (int d = 0; d < dim; ++d)
          {
            nodes_.xp[i][d] = surface.position[i][d];
            nodes_.v[i][d]  = surface.velocity[i][d];
          }
      }
    for (std::size_t k = 0; k < place.size(); ++k)
      {
        const std::size_t i = nodes_.n_interface + k;
        const Vec<dim>   &x = place[order[k]];
        for (int d = 0; d < dim; ++d)
          nodes_.xp[i][d] = x[d];
        nodes_.contacts[i] = parameters_.walls.faces_at(x, 1e-9 * parameters_.spacing);
      }
  }


  template <int dim>
  void PfemFluid<dim>::set_up_slip()
  {
    try
      {
        const std::vector<char> slips = parameters_.law_at_structures.slips(adopted_.surface());
        if (std::any_of(slips.begin(), slips.end(), [](const char slips_here) {
              return slips_here;
            }))
          slip_.set_up(adopted_.surface(), slips);
      }
    catch (const InputError &error)
      {
        throw InputError(parameters_.law_place + ": " + error.what());
      }
  }


  template <int dim>
  void PfemFluid<dim>::set_initial_velocity()
  {
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      for (int d = 0; d < dim; ++d)
        nodes_.v[i][d] = finite_value(*parameters_.initial_state.velocity_at, nodes_.position(i), d, "Velocity");
  }


  template <int dim>
  void PfemFluid<dim>::set_initial_pressure()
  {
    const InitialState<dim> &initial = parameters_.initial_state;
    const EquationOfState   &state   = parameters_.equation_of_state.front();
    if (initial.pressure == "hydrostatic" && !body_force_is_uniform_)
      throw InputError("The initial pressure of the fluid can't be hydrostatic, because a body force changes in space "
                       "or time. Set Fluid/Pfem/Initial state/Pressure to zero or to an expression.");

    // The highest place of each body against the body force: the least g . x of its nodes.
    const Vec<dim>                  g    = body_acceleration_.front();
    const std::vector<unsigned int> body = bodies(mesh_, nodes_.n);
    std::vector<double>             highest(nodes_.n, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < nodes_.n; ++i)
      highest[body[i]] = std::min(highest[body[i]], dot(g, nodes_.position(i)));

    const double c = state.sound_speed(state.reference_density());
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const Vec<dim> x        = nodes_.position(i);
        double         pressure = 0;
        if (initial.pressure == "hydrostatic")
          {
            // dp/ds = rho(p) g s along the force, to second order in compressibility
            const double head = dot(g, x) - highest[body[i]];
            pressure          = state.reference_density() * head * (1 + 0.5 * head / (c * c));
          }
        else if (initial.pressure_at)
          pressure = finite_value(*initial.pressure_at, x, 0, "Pressure");
        nodes_.base_density[i] = nodes_.density[i] = state.density(pressure);
      }
  }

  template class PfemFluid<2>;
  template class PfemFluid<3>;
} // namespace Breakwater
