#include "star_mesh.h"

#include <algorithm>
#include <limits>

namespace Breakwater
{
  template <int dim>
  StarMesh<dim>::StarMesh(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask &task)
    : mesh_(mesh)
    , position_(position)
    , task_(task)
    , inverse_radius_(1. / reference_insphere_radius<dim>(task.spacing))
    , r_(mesh.cells.size())
    , rows_(position.size())
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
    position_[node] = x;
    std::size_t k   = 0;
    for (const unsigned int c : star(node))
      r_[c] = r[k++];
  }


  template <int dim>
  void StarMesh<dim>::move(const unsigned int node, const Vec<dim> &x)
  {
    position_[node] = x;
    for (const unsigned int c : star(node))
      r_[c] = quality(corners_of(c));
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
        numbers.push_back(c);
      }
  }


  template <int dim>
  void StarMesh<dim>::remove(const unsigned int c)
  {
    for (const unsigned int node : mesh_.cells[c])
      remove_from_star(node, c);
    mesh_.cells[c].fill(0);
    r_[c] = std::numeric_limits<double>::infinity();
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
  void StarMesh<dim>::boundary_facets(const unsigned int node, std::vector<Facet> &facets) const
  {
    // A facet that two cells have cancels; the key is the same for both.
    std::vector<std::pair<Facet, Facet>> found;
    for (const unsigned int c : star(node))
      for (int a = 0; a <= dim; ++a)
        if (mesh_.cells[c][a] != node)
          {
            const Facet facet = outward_facet<dim>(mesh_.cells[c], a);
            Facet       key   = facet;
            std::sort(key.begin(), key.end());
            found.emplace_back(key, facet);
          }
    std::sort(found.begin(), found.end());
    facets.clear();
    for (std::size_t k = 0; k < found.size(); ++k)
      if (k + 1 < found.size() && found[k].first == found[k + 1].first)
        ++k;
      else
        facets.push_back(found[k].second);
  }


  template <int dim>
  bool StarMesh<dim>::faces_outward(const std::vector<Facet> &facets, const Vec<dim> &area_vector) const
  {
    for (const Facet &facet : facets)
      {
        const Vec<dim> e = position_[facet[1]] - position_[facet[0]];
        Vec<dim>       normal;
        if constexpr (dim == 2)
          normal = {{e[1], -e[0]}};
        else
          normal = cross(e, position_[facet[2]] - position_[facet[0]]);
        if (dot(normal, area_vector) < 0)
          return false;
      }
    return true;
  }


  template <int dim>
  void StarMesh<dim>::finish()
  {
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
  Vec<dim> allowed_part(const StarMesh<dim> &mesh, const unsigned int node, Vec<dim> displacement)
  {
    if (mesh.freedom(node) == NodeFreedom::fixed)
      return {};
    if (slides(mesh.freedom(node)))
      {
        const Vec<dim> area   = mesh.area_vector(node);
        const double   square = dot(area, area);
        if (square > 0)
          displacement -= area * (dot(area, displacement) / square);
      }
    return displacement;
  }

  template class StarMesh<2>;
  template class StarMesh<3>;
  template Vec<2> allowed_part<2>(const StarMesh<2> &, unsigned int, Vec<2>);
  template Vec<3> allowed_part<3>(const StarMesh<3> &, unsigned int, Vec<3>);
} // namespace Breakwater
