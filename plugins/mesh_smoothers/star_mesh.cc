#include "star_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Breakwater
{
  namespace
  {
    /// Sines of angles that are none: between directions, and between a wall and facets of nodes that lie on it but for
    /// a twentieth of the spacing. A node on such facets keeps the volume as exactly as the facets lie on the wall: what it
    /// changes is reported.
    constexpr double small_sine = 1e-3, small_tilt = 0.2;
  } // namespace


  template <int dim>
  StarMesh<dim>::StarMesh(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task)
    : mesh_(mesh)
    , position_(position)
    , start_(position)
    , task_(task)
    , freedom_(task.freedom)
    , inverse_radius_(1. / reference_insphere_radius<dim>(task.spacing))
    , r_(mesh.cells.size())
    , rows_(position.size())
    , changed_at_(position.size(), 0)
    , is_on_boundary_(position.size(), 0)
  {
    constexpr unsigned int spare = 6; // entries of each row for cells that come by flips
    for (const auto &cell : mesh.cells)
      for (const unsigned int node : cell)
        ++rows_[node].capacity;
    unsigned int begin = 0;
    for (Row &row : rows_)
      {
        row.begin = begin;
        row.capacity += spare;
        begin += row.capacity;
      }
    entries_.resize(begin);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        r_[c] = quality(corners_of(c));
        if (r_[c] < task.target)
          bad_.push_back(c);
        for (const unsigned int node : mesh.cells[c])
          {
            Row &row                         = rows_[node];
            entries_[row.begin + row.size++] = c;
          }
      }
    for (const auto &facet : mesh.boundary)
      for (const unsigned int node : facet)
        is_on_boundary_[node] = 1;
  }


  template <int dim>
  std::vector<unsigned int> StarMesh<dim>::bad_cells() const
  {
    std::vector<unsigned int> bad;
    std::copy_if(bad_.begin(), bad_.end(), std::back_inserter(bad), [this](const unsigned int c) {
      return r_[c] < target();
    });
    std::sort(bad.begin(), bad.end(), [this](const unsigned int a, const unsigned int b) {
      return r_[a] < r_[b] || (r_[a] == r_[b] && a < b);
    });
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    return bad;
  }


  template <int dim>
  double StarMesh<dim>::volume() const
  {
    double volume = 0;
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (is_alive(c))
        volume += signed_volume(corners_of(c));
    return volume;
  }


  template <int dim>
  double StarMesh<dim>::smallest(const unsigned int node) const
  {
    double result = std::numeric_limits<double>::infinity();
    for (const unsigned int c : star(node))
      result = std::min(result, r_[c]);
    return result;
  }


  template <int dim>
  void StarMesh<dim>::move(const unsigned int node, const Vec<dim> &x, const std::vector<double> &r)
  {
    const bool slides_on_walls =
      freedom(node) == NodeFreedom::slides_on_wall || freedom(node) == NodeFreedom::slides_on_edge;
    if (slides_on_walls && !is_at_surface(node))
      slid_volume_ += dot(area_vector(node), x - position_[node]);
    position_[node] = x;
    ++clock_;
    std::size_t k = 0;
    for (const unsigned int c : star(node))
      {
        r_[c] = r[k++];
        note_change(c);
      }
  }


  template <int dim>
  void StarMesh<dim>::note_change(const unsigned int c)
  {
    for (const unsigned int node : mesh_.cells[c])
      changed_at_[node] = clock_;
    if (r_[c] < target())
      bad_.push_back(c);
  }


  template <int dim>
  void StarMesh<dim>::replace(const std::vector<unsigned int> &old_cells, const std::vector<Cell> &new_cells,
                              std::vector<unsigned int> &numbers)
  {
    for (const unsigned int c : old_cells)
      remove(c);
    numbers.clear();
    for (const Cell &cell : new_cells)
      {
        unsigned int c = mesh_.cells.size();
        if (dead_.empty())
          {
            mesh_.cells.push_back(cell);
            r_.push_back(0);
          }
        else
          {
            c = dead_.back();
            dead_.pop_back();
            mesh_.cells[c] = cell;
          }
        r_[c] = quality(corners_of(c));
        for (const unsigned int node : cell)
          add_to_star(node, c);
        note_change(c);
        numbers.push_back(c);
      }
  }


  template <int dim>
  void StarMesh<dim>::remove(const unsigned int c)
  {
    r_[c] = std::numeric_limits<double>::infinity();
    ++clock_;
    note_change(c);
    for (const unsigned int node : mesh_.cells[c])
      remove_from_star(node, c);
    mesh_.cells[c].fill(0);
    dead_.push_back(c);
  }


  template <int dim>
  void StarMesh<dim>::add_to_star(const unsigned int node, const unsigned int c)
  {
    Row &row = rows_[node];
    if (row.size == row.capacity)
      {
        const unsigned int begin = entries_.size();
        entries_.resize(begin + 2 * row.capacity);
        std::copy_n(entries_.begin() + row.begin, row.size, entries_.begin() + begin);
        row.begin = begin;
        row.capacity *= 2;
      }
    entries_[row.begin + row.size++] = c;
  }


  template <int dim>
  void StarMesh<dim>::remove_from_star(const unsigned int node, const unsigned int c)
  {
    Row          &row                      = rows_[node];
    unsigned int *first                    = entries_.data() + row.begin;
    *std::find(first, first + row.size, c) = first[row.size - 1];
    --row.size;
  }


  template <int dim>
  Vec<dim> StarMesh<dim>::area_vector(const unsigned int node) const
  {
    Vec<dim> sum;
    for (const unsigned int c : star(node))
      {
        const Simplex<dim> area = area_vectors(corners_of(c));
        const Cell        &cell = mesh_.cells[c];
        sum += area[std::find(cell.begin(), cell.end(), node) - cell.begin()];
      }
    return sum;
  }


  template <int dim>
  Vec<dim> StarMesh<dim>::normal_of(const Facet &facet, const unsigned int node, const Vec<dim> &x) const
  {
    const auto place = [&](const unsigned int other) {
      return other == node ? x : position(other);
    };
    const Vec<dim> e = place(facet[1]) - place(facet[0]);
    if constexpr (dim == 2)
      return {{e[1], -e[0]}};
    else
      return cross(e, place(facet[2]) - place(facet[0]));
  }


  template <int dim>
  void StarMesh<dim>::boundary_facets(const unsigned int node, std::vector<Facet> &facets) const
  {
    facets.clear();
    for (const unsigned int c : star(node))
      for (int a = 0; a <= dim; ++a)
        {
          if (mesh_.cells[c][a] == node)
            continue;
          Facet      facet    = outward_facet<dim>(mesh_.cells[c], a);
          const bool is_inner = std::any_of(facet.begin(), facet.end(), [this](const unsigned int other) {
            return !is_on_boundary_[other];
          });
          if (is_inner)
            continue;
          if constexpr (dim == 3)
            while (facet[2] != node)
              facet = {{facet[1], facet[2], facet[0]}};
          // A facet that two cells have cancels: the other has it the other way round.
          Facet opposite = facet;
          std::swap(opposite[0], opposite[1]);
          const auto same = std::find(facets.begin(), facets.end(), opposite);
          if (same == facets.end())
            facets.push_back(facet);
          else
            {
              *same = facets.back();
              facets.pop_back();
            }
        }
  }


  template <int dim>
  StarMesh<dim>::Constraint::Constraint(const StarMesh &mesh, const unsigned int node, const bool keeps_volume)
    : node_(node)
  {
    const NodeFreedom freedom = mesh.freedom(node);
    is_fixed_                 = freedom == NodeFreedom::fixed || (keeps_volume && freedom == NodeFreedom::ends_on_edge);
    if (is_fixed_ || freedom == NodeFreedom::free)
      return;
    const auto unit = [](Vec<dim> vector, const double least) {
      const double length = norm(vector);
      vector *= length > least ? 1. / length : 0.;
      return vector;
    };
    area_                = mesh.area_vector(node);
    const Vec<dim> &wall = mesh.task_.wall_normal[node];
    if (!keeps_volume && mesh.is_at_surface(node))
      {
        if (freedom == NodeFreedom::slides_on_line || freedom == NodeFreedom::slides_on_wall)
          across_[0] = wall;
        if (freedom == NodeFreedom::ends_on_edge || freedom == NodeFreedom::slides_on_edge)
          set_direction(wall);
        return;
      }
    if (freedom == NodeFreedom::slides_on_edge)
      {
        set_direction(wall);
        is_fixed_ = is_fixed_ || mesh.is_at_surface(node);
        return;
      }
    if (freedom == NodeFreedom::slides_on_wall && !mesh.is_at_surface(node))
      {
        across_[0] = wall;
        return;
      }
    across_[0] = unit(area_, 0.);
    if (freedom == NodeFreedom::slides_on_line || freedom == NodeFreedom::slides_on_wall)
      {
        // Where the area vector is the wall's normal, nothing tells where the line goes.
        across_[1] = unit(wall - across_[0] * dot(across_[0], wall), small_sine);
        is_fixed_  = dim == 2 || !(norm(across_[1]) > 0);
      }
  }


  template <int dim>
  bool StarMesh<dim>::is_at_surface(const unsigned int node) const
  {
    const Vec<dim> area = area_vector(node), &wall = task_.wall_normal[node];
    switch (freedom(node))
      {
        case NodeFreedom::slides_on_wall:
          return norm(area - wall * dot(area, wall)) > small_tilt * norm(area);
        case NodeFreedom::slides_on_edge:
          return std::abs(dot(area, wall)) > small_tilt * norm(area);
        default:
          return is_on_surface(freedom(node));
      }
  }


  template <int dim>
  void StarMesh<dim>::Constraint::set_direction(const Vec<dim> &direction)
  {
    if constexpr (dim == 2)
      is_fixed_ = true; // two walls meet in a point
    else
      {
        Vec<dim> other; // along the axis that is farthest from the direction
        other[std::min_element(direction.c, direction.c + dim,
                               [](const double a, const double b) {
                                 return std::abs(a) < std::abs(b);
                               }) -
              direction.c] = 1;
        across_[0]         = cross(direction, other);
        across_[0] *= 1. / norm(across_[0]);
        across_[1] = cross(direction, across_[0]);
      }
  }


  template <int dim>
  bool StarMesh<dim>::Constraint::faces_outward(const StarMesh &mesh, const std::vector<Facet> &facets,
                                                const Vec<dim> &x) const
  {
    return std::all_of(facets.begin(), facets.end(), [&](const Facet &facet) {
      return dot(mesh.normal_of(facet, node_, x), area_) >= 0;
    });
  }


  template <int dim>
  void StarMesh<dim>::finish(SmoothingReport &report)
  {
    report.slid_volume = slid_volume_;
    if (dead_.empty())
      return;
    auto &cells = mesh_.cells;
    cells.erase(std::remove_if(cells.begin(), cells.end(),
                               [](const Cell &cell) {
                                 return cell[0] == cell[1];
                               }),
                cells.end());
    dead_.clear();
  }


  template <int dim>
  bool StarMesh<dim>::try_move(const unsigned int node, const Vec<dim> &displacement, const double least)
  {
    const Constraint constraint(*this, node);
    const Vec<dim>   step = within_reach(node, constraint.allowed_part(displacement)), before = position_[node];
    if (!(norm(step) > 0) || !is_reachable(node, before + step))
      return false;
    new_r_.clear();
    position_[node] = before + step;
    bool is_good    = true;
    for (const unsigned int c : star(node))
      {
        new_r_.push_back(quality(corners_of(c)));
        if (!(new_r_.back() >= std::min(r_[c], std::max(0., least))))
          {
            is_good = false;
            break;
          }
      }
    if (is_good && slides(freedom(node)))
      {
        boundary_facets(node, facets_);
        is_good = constraint.faces_outward(*this, facets_, position_[node]);
      }
    const Vec<dim> x = position_[node];
    position_[node]  = before;
    if (is_good)
      move(node, x, new_r_);
    return is_good;
  }


  template <int dim>
  Vec<dim> StarMesh<dim>::within_reach(const unsigned int node, const Vec<dim> &step, const bool keeps_volume) const
  {
    const double   reach  = (keeps_volume && freedom(node) == NodeFreedom::slides_on_surface ? 0.3 : 0.5) * spacing();
    const Vec<dim> offset = position_[node] - start_[node];
    // |offset + t step| = reach
    const double a = dot(step, step), b = dot(offset, step), c = dot(offset, offset) - reach * reach;
    if (!(a > 0) || a + 2 * b + c <= 0)
      return step;
    return step * std::max(0., (std::sqrt(std::max(0., b * b - a * c)) - b) / a);
  }

  template class StarMesh<2>;
  template class StarMesh<3>;
} // namespace Breakwater
