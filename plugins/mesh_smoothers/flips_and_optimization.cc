#include "flips_and_optimization.h"

#include "flips.h"
#include "node_step.h"
#include "peel.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <limits>

namespace Breakwater
{
  namespace
  {
    template <int dim>
    class Repair
    {
    public:
      Repair(StarMesh<dim> &mesh, const VolumeBudget &budget, SmoothingReport &report)
        : mesh_(mesh)
        , flips_(mesh)
        , node_step_(mesh)
        , peel_(mesh, budget)
        , report_(report)
        , moved_in_vain_(mesh.positions().size(), never)
        , lifted_in_vain_(mesh.positions().size(), never)
      {
      }

      void run(const unsigned int n_passes)
      {
        std::fill(moved_in_vain_.begin(), moved_in_vain_.end(), never);
        std::fill(lifted_in_vain_.begin(), lifted_in_vain_.end(), never);
        tried_.clear();
        const unsigned int n_cells = mesh_.n_cells();
        for (unsigned int c = 0; c < n_cells; ++c)
          if (is_bad(c))
            flip(c);
        for (unsigned int pass = 0; pass < n_passes && repair_worst_first(); ++pass)
          {
          }
        tried_.clear();
        for (unsigned int pass = 0; pass < n_passes && change_surface(); ++pass)
          {
          }
      }

      void finish()
      {
        peel_.finish(report_);
        report_.n_lifts       = node_step_.n_lifts();
        report_.lifted_volume = node_step_.lifted_volume();
      }

      /// True if no cell is left for which the surface may change.
      bool is_good() const
      {
        const std::vector<unsigned int> bad = mesh_.bad_cells();
        return bad.empty() || mesh_.r(bad.front()) >= wanted_at_least();
      }

    private:
      /// What is below this may have a surface that is a little other.
      double wanted_at_least() const { return 0.75 * mesh_.target(); }

      /// Part of the largest peel that may be spent on coming from there to the target.
      static constexpr double for_target = 0.1;

      bool is_bad(const unsigned int c) const { return mesh_.is_alive(c) && mesh_.r(c) < mesh_.target(); }

      bool flip(const unsigned int c)
      {
        const unsigned int n = flips_.improve(c);
        report_.n_flips += n;
        return n > 0;
      }

      /// Cells that were tried and have not changed since, nor the stars of their nodes, are not tried again.
      bool may_help(const unsigned int c)
      {
        if (tried_.size() <= c)
          tried_.resize(mesh_.n_cells(), never);
        const auto &cell     = mesh_.cell(c);
        const bool  may_help = std::any_of(cell.begin(), cell.end(), [&](const unsigned int node) {
          return has_changed_since(node, tried_[c]);
        });
        tried_[c]            = mesh_.clock();
        return may_help;
      }

      bool has_changed_since(const unsigned int node, const unsigned int time) const
      {
        return time == never || mesh_.changed_at(node) > time;
      }

      /// The smallest r decides: where a cell is stuck, no room is made for better ones. @return whether a further pass
      /// may help
      bool repair_worst_first()
      {
        const std::vector<unsigned int> bad         = mesh_.bad_cells();
        const bool                      are_few     = 100 * bad.size() < mesh_.n_cells();
        bool                            has_changed = false;
        double                          stuck       = std::numeric_limits<double>::infinity(); // r of the worst such
        for (const unsigned int c : bad)
          if (is_bad(c))
            {
              const bool may_need_room = are_few && mesh_.r(c) <= stuck;
              if (may_help(c) && (flip(c) || move_nodes(c) || (may_need_room && make_room(c, false))))
                has_changed = true;
              else
                stuck = std::min(stuck, mesh_.r(c));
            }
        for (const unsigned int c : bad)
          if (is_bad(c))
            has_changed = peel(c, {for_target, false}) || has_changed;
        return has_changed;
      }

      /// Changes the surface where cells are still far below the target. @return whether a further pass may help
      bool change_surface()
      {
        bool has_changed = false;
        for (const unsigned int c : mesh_.bad_cells())
          if (mesh_.r(c) < wanted_at_least() && may_help(c))
            has_changed = flip(c) || move_nodes(c) || lift_nodes(c) || peel(c, {1., false}) || make_room(c, true) ||
                          peel(c, {1., true}) || peel_.free_nodes(c) || has_changed;
        return has_changed;
      }

      bool lift_nodes(const unsigned int c)
      {
        const auto cell      = mesh_.cell(c);
        bool       has_moved = false;
        for (const unsigned int node : cell)
          if (mesh_.r(c) < wanted_at_least())
            has_moved = lift_node(node, 1.05 * wanted_at_least()) || has_moved;
        return has_moved;
      }

      bool peel(const unsigned int c, const typename Peel<dim>::Limits &limits) { return peel_.try_cell(c, limits); }

      bool move_nodes(const unsigned int c)
      {
        const auto cell      = mesh_.cell(c);
        bool       has_moved = false;
        for (const unsigned int node : cell)
          if (is_bad(c))
            has_moved = move_node(node, 1.05 * mesh_.target()) || has_moved;
        return has_moved;
      }

      bool move_node(const unsigned int node, const double wanted)
      {
        if (!has_changed_since(node, moved_in_vain_[node]))
          return false;
        const bool has_moved = node_step_.improve(node, wanted);
        if (!has_moved && mesh_.smallest(node) < wanted)
          moved_in_vain_[node] = mesh_.clock();
        return has_moved;
      }

      bool lift_node(const unsigned int node, const double wanted)
      {
        if (!has_changed_since(node, lifted_in_vain_[node]))
          return false;
        const bool has_moved = node_step_.lift(node, wanted, peel_.budget());
        if (!has_moved && mesh_.smallest(node) < wanted)
          lifted_in_vain_[node] = mesh_.clock();
        return has_moved;
      }

      /// What is in the way of a cell that nothing helps are neighbours that are hardly better: these come first.
      bool make_room(const unsigned int c, const bool may_lift)
      {
        std::vector<unsigned int> nodes;
        for (const unsigned int node : mesh_.cell(c))
          for (const unsigned int other : mesh_.star(node))
            if (mesh_.r(other) < 1.2 * mesh_.target())
              nodes.insert(nodes.end(), mesh_.cell(other).begin(), mesh_.cell(other).end());
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        bool has_moved = false;
        for (const unsigned int node : nodes)
          has_moved =
            move_node(node, 1.3 * mesh_.target()) || (may_lift && lift_node(node, mesh_.target())) || has_moved;
        return has_moved;
      }

      StarMesh<dim>   &mesh_;
      Flips<dim>       flips_;
      NodeStep<dim>    node_step_;
      Peel<dim>        peel_;
      SmoothingReport &report_;

      static constexpr unsigned int never = std::numeric_limits<unsigned int>::max();
      // By the clock of the mesh.
      std::vector<unsigned int> tried_;                          ///< when a cell was last tried
      std::vector<unsigned int> moved_in_vain_, lifted_in_vain_; ///< when no step helped a node
    };
  } // namespace


  template <int dim>
  void FlipsAndOptimization<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add(
      "Passes", n_passes_,
      "Largest number of passes over the bad cells after the first flips; as many again may change the surface.", 0,
      100);
    Peel<dim>::declare(reader, largest_peel_);
  }


  template <int dim>
  void FlipsAndOptimization<dim>::improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position,
                                          const SmoothingTask<dim> &task, SmoothingReport &report)
  {
    StarMesh<dim> work(mesh, position, task);
    Repair<dim>   repair(work, VolumeBudget(largest_peel_ * work.volume()), report);
    repair.run(n_passes_);
    if (!repair.is_good())
      {
        // Once more, from the places reached, and with what is left of the largest peel.
        work.restart();
        repair.run(n_passes_);
      }
    repair.finish();
    work.finish(report);
  }

  template class FlipsAndOptimization<2>;
  template class FlipsAndOptimization<3>;
} // namespace Breakwater
