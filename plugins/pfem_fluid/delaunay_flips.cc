#include "delaunay_mesh.h"
#include "predicates.h"

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    /// Corners of the facet opposite to a corner of a tetrahedron: followed by that corner, an even permutation.
    constexpr unsigned int facet_corners[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
  } // namespace


  template <int dim>
  void DelaunayMesh<dim>::flip_all()
  {
    // Each flip lowers the lifted surface: this ends. A facet that can't be flipped now may be when its surroundings
    // have changed.
    std::size_t n_flips_before;
    do
      {
        n_flips_before = report_.n_flips;
        to_check_.insert(to_check_.end(), stuck_.begin(), stuck_.end());
        stuck_.clear();
        while (!to_check_.empty())
          {
            const Facet facet = to_check_.back();
            to_check_.pop_back();
            if (!needs_flip(facet))
              continue;
            if (try_flip(facet))
              ++report_.n_flips;
            else
              stuck_.push_back(facet);
          }
      }
    while (!stuck_.empty() && report_.n_flips > n_flips_before);
    stuck_.erase(std::remove_if(stuck_.begin(), stuck_.end(),
                                [&](const Facet &facet) {
                                  return !needs_flip(facet);
                                }),
                 stuck_.end());
  }


  template <int dim>
  bool DelaunayMesh<dim>::needs_flip(const Facet &facet) const
  {
    const unsigned int neighbor = cells_[facet.cell].neighbor[facet.opposite];
    if (neighbor == no_cell)
      return false;
    const Cell &cell = cells_[facet.cell];
    return Circumsphere<dim>(corners_of(cell.node)).contains(position_[node_across(cell, facet.opposite)]);
  }


  template <int dim>
  int DelaunayMesh<dim>::orientation(const std::array<unsigned int, dim + 1> &node) const
  {
    return Circumsphere<dim>(corners_of(node)).orientation();
  }


  template <int dim>
  typename DelaunayMesh<dim>::Facet DelaunayMesh<dim>::outside_of(const unsigned int cell,
                                                                  const unsigned int node) const
  {
    const unsigned int neighbor = cells_[cell].neighbor[corner_at(cell, node)];
    return {neighbor, neighbor == no_cell ? 0 : corner_towards(neighbor, cell)};
  }


  template <int dim>
  template <std::size_t n_old, std::size_t n_new>
  void DelaunayMesh<dim>::replace(const std::array<unsigned int, n_old>               &old_cells,
                                  const std::array<Cell, n_new>                       &new_cells,
                                  const std::array<std::array<Facet, dim + 1>, n_new> &outside)
  {
    std::array<unsigned int, n_new> number;
    for (std::size_t k = 0; k < n_new; ++k)
      {
        number[k] = k < n_old ? old_cells[k] : new_cell(new_cells[k].node);
        set_nodes(number[k], new_cells[k].node);
      }
    for (std::size_t k = n_new; k < n_old; ++k)
      delete_cell(old_cells[k]);

    for (std::size_t k = 0; k < n_new; ++k)
      {
        Cell &cell = cells_[number[k]];
        for (unsigned int a = 0; a <= dim; ++a)
          {
            const unsigned int inside = new_cells[k].neighbor[a];
            if (inside != no_cell)
              cell.neighbor[a] = number[inside];
            else
              {
                cell.neighbor[a] = outside[k][a].cell;
                if (outside[k][a].cell != no_cell)
                  cells_[outside[k][a].cell].neighbor[outside[k][a].opposite] = number[k];
              }
            // Facets between the new cells of a flip of dim + 2 points are right.
            if (inside == no_cell || n_old == 4)
              to_check_.push_back({number[k], a});
          }
      }
  }


  template <int dim>
  bool DelaunayMesh<dim>::try_flip(const Facet &facet)
  {
    if constexpr (dim == 2)
      return try_flip_in_2d(facet);
    else
      return try_flip_in_3d(facet);
  }


  template <int dim>
  bool DelaunayMesh<dim>::try_flip_in_2d(const Facet &facet)
  {
    if constexpr (dim == 2)
      {
        // Edge ab between c in cell A and d in cell B becomes edge cd.
        const unsigned int A = facet.cell, B = cells_[A].neighbor[facet.opposite];
        const unsigned int a = cells_[A].node[(facet.opposite + 1) % 3], b = cells_[A].node[(facet.opposite + 2) % 3],
                           c = cells_[A].node[facet.opposite], d = node_across(cells_[A], facet.opposite);
        if (orientation({a, d, c}) <= 0 || orientation({d, b, c}) <= 0)
          return false;
        constexpr Facet none{no_cell, 0};
        replace<2, 2>({A, B}, {{{{a, d, c}, {1, no_cell, no_cell}}, {{d, b, c}, {no_cell, 0, no_cell}}}},
                      {{{none, outside_of(A, b), outside_of(B, b)}, {outside_of(A, a), none, outside_of(B, a)}}});
        return true;
      }
    else
      return false;
  }


  template <int dim>
  bool DelaunayMesh<dim>::try_flip_in_3d(const Facet &facet)
  {
    if constexpr (dim == 3)
      {
        // Facet (f0, f1, f2) between d in cell A and e in cell B.
        const unsigned int  A = facet.cell, B = cells_[A].neighbor[facet.opposite];
        const unsigned int *corner = facet_corners[facet.opposite];
        const unsigned int  f[3]   = {cells_[A].node[corner[0]], cells_[A].node[corner[1]], cells_[A].node[corner[2]]};
        const unsigned int  d = cells_[A].node[facet.opposite], e = node_across(cells_[A], facet.opposite);
        constexpr Facet     none{no_cell, 0};

        // Cell i of those around a new edge de holds the edge (f_i, f_i+1).
        int sign[3];
        for (int i = 0; i < 3; ++i)
          sign[i] = orientation({f[i], f[(i + 1) % 3], e, d});
        const int n_positive = (sign[0] > 0) + (sign[1] > 0) + (sign[2] > 0);
        if (n_positive < 2)
          return false;

        for (int i = 0; i < 3; ++i)
          {
            const unsigned int a = f[i], b = f[(i + 1) % 3], c = f[(i + 2) % 3];
            if (sign[(i + 1) % 3] <= 0 || sign[(i + 2) % 3] <= 0)
              continue;
            const Facet to_C = outside_of(A, c), to_D = outside_of(B, c);
            if (to_C.cell == no_cell || to_D.cell == no_cell)
              continue;
            const unsigned int C = to_C.cell, D = to_D.cell;
            if (C == D && sign[i] <= 0)
              {
                // Three cells around edge ab become two on both sides of the facet (c, d, e).
                replace<3, 2>(
                  {A, B, C},
                  {{{{b, c, e, d}, {1, no_cell, no_cell, no_cell}}, {{c, a, e, d}, {no_cell, 0, no_cell, no_cell}}}},
                  {{{none, outside_of(C, a), outside_of(A, a), outside_of(B, a)},
                    {outside_of(C, b), none, outside_of(A, b), outside_of(B, b)}}});
                return true;
              }
            const unsigned int g = cells_[C].node[to_C.opposite];
            if (C != D && sign[i] == 0 && cells_[D].node[to_D.opposite] == g &&
                cells_[C].neighbor[corner_at(C, d)] == D && orientation({b, g, d, e}) > 0 &&
                orientation({g, a, d, e}) > 0)
              {
                // Four cells around edge ab become four around edge de.
                replace<4, 4>({A, B, C, D},
                              {{{{b, c, e, d}, {1, 2, no_cell, no_cell}},
                                {{c, a, e, d}, {3, 0, no_cell, no_cell}},
                                {{b, g, d, e}, {3, 0, no_cell, no_cell}},
                                {{g, a, d, e}, {1, 2, no_cell, no_cell}}}},
                              {{{none, none, outside_of(A, a), outside_of(B, a)},
                                {none, none, outside_of(A, b), outside_of(B, b)},
                                {none, none, outside_of(D, a), outside_of(C, a)},
                                {none, none, outside_of(D, b), outside_of(C, b)}}});
                return true;
              }
          }
        if (n_positive < 3)
          return false;
        std::array<Cell, 3>                 cells;
        std::array<std::array<Facet, 4>, 3> outside;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int c = f[(i + 2) % 3];
            cells[i]             = {{f[i], f[(i + 1) % 3], e, d}, {(i + 1) % 3, (i + 2) % 3, no_cell, no_cell}};
            outside[i]           = {none, none, outside_of(A, c), outside_of(B, c)};
          }
        replace<2, 3>({A, B}, cells, outside);
        return true;
      }
    else
      return false;
  }

  template class DelaunayMesh<2>;
  template class DelaunayMesh<3>;
} // namespace Breakwater
