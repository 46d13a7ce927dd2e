#include "elastic_analogy.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// The solid around the bad cells, with its own numbers for nodes that move: 0 stands for all that do not. Lengths
    /// are in units of the spacing.
    template <int dim>
    class ElasticPatch
    {
    public:
      explicit ElasticPatch(const StarMesh<dim> &mesh)
        : mesh_(mesh)
      {
        collect_nodes();
        collect_cells();
        set_masses();
      }

      bool                             empty() const { return nodes_.empty(); }
      const std::vector<unsigned int> &nodes() const { return nodes_; } ///< those of the worst cells first

      /// Displacement of a node of the list [m].
      Vec<dim> displacement(const std::size_t k) const { return u_[k + 1] * mesh_.spacing(); }

      void relax(const ElasticControl &control)
      {
        std::vector<Vec<dim>> velocity(u_.size()), force(u_.size()), inner(u_.size());
        for (unsigned int n = 0; n < control.n_iterations; ++n)
          {
            add_stress_forces(inner);
            double stiffness = 0, inertia = 0;
            for (std::size_t k = 1; k < u_.size(); ++k)
              {
                force[k] = allowed(k, load_[k] - inner[k]);
                stiffness += dot(u_[k], inner[k]);
                inertia += mass_[k] * dot(u_[k], u_[k]);
              }
            const double damping = inertia > 0 ? std::min(1.9, 2 * std::sqrt(std::max(0., stiffness / inertia))) : 0.;
            double       moved = 0, size = 0;
            for (std::size_t k = 1; k < u_.size(); ++k)
              {
                velocity[k] =
                  velocity[k] * ((2 - damping) / (2 + damping)) + force[k] * (2 / (mass_[k] * (2 + damping)));
                u_[k] += velocity[k];
                moved += dot(velocity[k], velocity[k]);
                size += dot(u_[k], u_[k]);
              }
            if (moved <= control.tolerance * control.tolerance * size)
              break;
          }
      }

    private:
      struct SolidCell
      {
        std::array<unsigned int, dim + 1> node; ///< own numbers
        Simplex<dim>                      area; ///< A_a
        double                            volume;
      };

      void collect_nodes()
      {
        number_.assign(mesh_.positions().size(), 0);
        for (const unsigned int c : mesh_.bad_cells())
          for (const unsigned int node : mesh_.cell(c))
            if (number_[node] == 0 && mesh_.freedom(node) != NodeFreedom::fixed)
              {
                nodes_.push_back(node);
                number_[node] = nodes_.size();
                constraint_.emplace_back(mesh_, node);
              }
        u_.resize(nodes_.size() + 1);
        load_.resize(u_.size());
        mass_.resize(u_.size(), 1e-12);
      }

      void collect_cells()
      {
        constexpr double  smallest_r = 1e-4; // of the pressure and the stiffness of flat cells
        std::vector<char> is_in(mesh_.n_cells(), 0);
        const double      scale = 1. / mesh_.spacing();
        for (const unsigned int node : nodes_)
          for (const unsigned int c : mesh_.star(node))
            {
              if (is_in[c])
                continue;
              is_in[c] = 1;
              SolidCell    cell;
              Simplex<dim> x   = mesh_.corners_of(c);
              double       sum = 0;
              for (Vec<dim> &corner : x)
                corner *= scale;
              cell.area = area_vectors(x);
              for (int a = 0; a <= dim; ++a)
                {
                  cell.node[a] = number_[mesh_.cell(c)[a]];
                  sum += norm(cell.area[a]);
                }
              const double r        = std::max(mesh_.r(c), smallest_r);
              cell.volume           = r * reference_insphere_radius<dim>(1.) * sum;
              const double pressure = mesh_.r(c) < mesh_.target() ? 1. / r : 0.;
              for (int a = 0; a <= dim; ++a)
                load_[cell.node[a]] += pressure * cell.area[a];
              cells_.push_back(cell);
            }
      }

      // |K_ab| <= 2 G |A_a| |A_b| / V
      void set_masses()
      {
        for (const SolidCell &cell : cells_)
          {
            double sum = 0;
            for (const Vec<dim> &area : cell.area)
              sum += norm(area);
            for (int a = 0; a <= dim; ++a)
              mass_[cell.node[a]] += 0.25 * 2 * norm(cell.area[a]) * sum / cell.volume;
          }
      }

      /// K u.
      void add_stress_forces(std::vector<Vec<dim>> &force) const
      {
        std::fill(force.begin(), force.end(), Vec<dim>());
        for (const SolidCell &cell : cells_)
          {
            double gradient[dim][dim] = {};
            for (int a = 0; a <= dim; ++a)
              for (int d = 0; d < dim; ++d)
                for (int e = 0; e < dim; ++e)
                  gradient[d][e] += u_[cell.node[a]][d] * cell.area[a][e];
            double trace = 0;
            for (int d = 0; d < dim; ++d)
              trace += gradient[d][d];
            for (int d = 0; d < dim; ++d)
              {
                Vec<dim> stress;
                for (int e = 0; e < dim; ++e)
                  stress[e] = (gradient[d][e] + gradient[e][d] - (d == e ? 2. / dim * trace : 0.)) / cell.volume;
                for (int a = 0; a <= dim; ++a)
                  force[cell.node[a]][d] += dot(stress, cell.area[a]);
              }
          }
      }

      Vec<dim> allowed(const std::size_t k, const Vec<dim> &force) const
      {
        return constraint_[k - 1].allowed_part(force);
      }

      const StarMesh<dim>                            &mesh_;
      std::vector<unsigned int>                       nodes_, number_;
      std::vector<typename StarMesh<dim>::Constraint> constraint_; ///< of the nodes that move
      std::vector<SolidCell>                          cells_;
      std::vector<Vec<dim>>                           u_, load_;
      std::vector<double>                             mass_;
    };
  } // namespace


  void ElasticControl::declare(ParameterReader &reader)
  {
    reader.add("Rounds", n_rounds, "Largest number of solids that are relaxed one after another.", 1, 1000);
    reader.add("Iterations", n_iterations, "Largest number of steps of the dynamic relaxation of a solid.", 1, 10000);
    reader.add("Tolerance", tolerance,
               "The relaxation ends when a step changes the displacements by this part of them [-].", {0., 1.});
  }


  template <int dim>
  void relax_elastically(StarMesh<dim> &mesh, const ElasticControl &control)
  {
    constexpr double parts[] = {1., 0.5, 0.25};
    for (unsigned int round = 0; round < control.n_rounds; ++round)
      {
        ElasticPatch<dim> patch(mesh);
        if (patch.empty())
          return;
        patch.relax(control);
        unsigned int n_moved = 0;
        for (std::size_t k = 0; k < patch.nodes().size(); ++k)
          for (const double part : parts)
            if (mesh.try_move(patch.nodes()[k], patch.displacement(k) * part, mesh.smallest(patch.nodes()[k])))
              {
                ++n_moved;
                break;
              }
        if (n_moved == 0)
          return;
      }
  }


  template void relax_elastically<2>(StarMesh<2> &, const ElasticControl &);
  template void relax_elastically<3>(StarMesh<3> &, const ElasticControl &);
} // namespace Breakwater
