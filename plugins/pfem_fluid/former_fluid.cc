#include "former_fluid.h"

#include <algorithm>
#include <utility>

namespace Breakwater
{
  namespace
  {
    /// The same facet, the same side up, with its lowest node first.
    std::array<unsigned int, 3> rotated(std::array<unsigned int, 3> facet)
    {
      std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
      return facet;
    }
    std::array<unsigned int, 2> rotated(const std::array<unsigned int, 2> &facet)
    {
      return facet;
    }

    template <class Cell>
    unsigned int highest_node(const Cell &cell)
    {
      return *std::max_element(cell.begin(), cell.end());
    }
  } // namespace


  template <int dim>
  FormerFluid<dim>::FormerFluid(SimplexMesh<dim> mesh, std::vector<unsigned int> old_number)
    : mesh_(std::move(mesh))
    , old_number_(std::move(old_number))
  {
    for (const Facet &facet : mesh_.boundary)
      surface_.push_back(rotated(facet));
    std::sort(surface_.begin(), surface_.end());
  }


  template <int dim>
  bool FormerFluid<dim>::had(const Cell &cell) const
  {
    Cell old_cell;
    for (int a = 0; a <= dim; ++a)
      old_cell[a] = old_number_[cell[a]];
    const unsigned int highest = highest_node(old_cell);
    auto               found   = std::lower_bound(mesh_.cells.begin(), mesh_.cells.end(), highest,
                                                  [](const Cell &candidate, const unsigned int node) {
                                    return highest_node(candidate) < node;
                                  });
    for (; found != mesh_.cells.end() && highest_node(*found) == highest; ++found)
      if (std::is_permutation(found->begin(), found->end(), old_cell.begin()))
        return true;
    return false;
  }


  template <int dim>
  bool FormerFluid<dim>::had_surface_of(const Cell &cell) const
  {
    for (int opposite = 0; opposite <= dim; ++opposite)
      {
        Facet facet = outward_facet<dim>(cell, opposite);
        for (unsigned int &i : facet)
          i = old_number_[i];
        if (std::binary_search(surface_.begin(), surface_.end(), rotated(facet)))
          return true;
      }
    return false;
  }

  template class FormerFluid<2>;
  template class FormerFluid<3>;
} // namespace Breakwater
