#include "alpha_shape.h"

#include <breakwater/mesh/quality.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <numeric>

namespace Breakwater
{
  namespace
  {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

    /// What 2D and 3D call by different names in CGAL.
    template <int dim>
    struct Traits;

    template <>
    struct Traits<2>
    {
      using Vertex        = CGAL::Triangulation_vertex_base_with_info_2<unsigned int, Kernel>;
      using Face          = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
      using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
      using Point         = Kernel::Point_2;
      using CellHandle    = Triangulation::Face_handle;
      using PointMap      = CGAL::Pointer_property_map<Point>::const_type;
      using SortTraits    = CGAL::Spatial_sort_traits_adapter_2<Kernel, PointMap>;

      static Point point(const Vec<2> &x) { return {x[0], x[1]}; }
      static auto  finite_cells(const Triangulation &t) { return t.finite_face_handles(); }
    };

    template <>
    struct Traits<3>
    {
      using Vertex = CGAL::Triangulation_vertex_base_with_info_3<unsigned int, Kernel>;
      using Cell =
        CGAL::Triangulation_cell_base_with_info_3<int, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
      using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
      using Point         = Kernel::Point_3;
      using CellHandle    = Triangulation::Cell_handle;
      using PointMap      = CGAL::Pointer_property_map<Point>::const_type;
      using SortTraits    = CGAL::Spatial_sort_traits_adapter_3<Kernel, PointMap>;

      static Point point(const Vec<3> &x) { return {x[0], x[1], x[2]}; }
      static auto  finite_cells(const Triangulation &t) { return t.finite_cell_handles(); }
    };

    template <int dim>
    std::vector<typename Traits<dim>::Point> points_of(const std::vector<Vec<dim>> &position)
    {
      std::vector<typename Traits<dim>::Point> points;
      points.reserve(position.size());
      for (const Vec<dim> &x : position)
        points.push_back(Traits<dim>::point(x));
      return points;
    }

    /// Facet of a cell opposite to its corner `opposite`, its normal out of the cell.
    template <int dim>
    typename SimplexMesh<dim>::Facet outward_facet(const typename SimplexMesh<dim>::Cell &cell, const int opposite)
    {
      if constexpr (dim == 2)
        return {cell[(opposite + 1) % 3], cell[(opposite + 2) % 3]};
      else
        {
          static constexpr int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
          return {cell[corners[opposite][0]], cell[corners[opposite][1]], cell[corners[opposite][2]]};
        }
    }

    /// Stable counting sort of the cells by their highest node number.
    template <int dim>
    void sort_cells_by_highest_node(std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::size_t n_nodes)
    {
      std::vector<unsigned int> start(n_nodes + 1, 0);
      for (const auto &cell : cells)
        ++start[*std::max_element(cell.begin(), cell.end()) + 1];
      std::partial_sum(start.begin(), start.end(), start.begin());
      std::vector<typename SimplexMesh<dim>::Cell> sorted(cells.size());
      for (const auto &cell : cells)
        sorted[start[*std::max_element(cell.begin(), cell.end())]++] = cell;
      cells.swap(sorted);
    }
  } // namespace


  template <int dim>
  SimplexMesh<dim> alpha_shape(const std::vector<Vec<dim>> &position, const double largest_circumradius,
                               const std::function<bool(const typename SimplexMesh<dim>::Cell &)> &keep,
                               const std::function<bool(const typename SimplexMesh<dim>::Cell &)> &is_small_anyway)
  {
    using T = Traits<dim>;
    typename T::Triangulation triangulation;

    // Nodes come numbered along a space-filling curve (or close to it): each is found from the one before. A large
    // cloud in a bad order is sorted by CGAL itself.
    const auto                                              points = points_of<dim>(position);
    std::vector<std::pair<typename T::Point, unsigned int>> numbered(points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      numbered[i] = {points[i], i};
    triangulation.insert(numbered.begin(), numbered.end());

    SimplexMesh<dim> mesh;
    if (static_cast<int>(triangulation.dimension()) < dim)
      return mesh;

    std::vector<typename T::CellHandle> kept;
    for (const typename T::CellHandle handle : T::finite_cells(triangulation))
      {
        typename SimplexMesh<dim>::Cell cell, sorted;
        Simplex<dim>                    corners;
        for (int a = 0; a <= dim; ++a)
          cell[a] = handle->vertex(a)->info();
        // The circumradius is computed on the sorted tuple, so that it does not depend on how the cell was found.
        sorted = cell;
        std::sort(sorted.begin(), sorted.end());
        for (int a = 0; a <= dim; ++a)
          corners[a] = position[sorted[a]];
        const bool is_small =
          circumradius(corners) <= largest_circumradius || (is_small_anyway && is_small_anyway(cell));
        const bool is_fluid = is_small && keep(cell);
        handle->info()      = is_fluid ? 1 : 0;
        if (is_fluid)
          {
            kept.push_back(handle);
            mesh.cells.push_back(cell);
          }
      }

    for (std::size_t c = 0; c < kept.size(); ++c)
      for (int a = 0; a <= dim; ++a)
        {
          const auto neighbor = kept[c]->neighbor(a);
          if (triangulation.is_infinite(neighbor) || neighbor->info() != 1)
            mesh.boundary.push_back(outward_facet<dim>(mesh.cells[c], a));
        }

    sort_cells_by_highest_node<dim>(mesh.cells, position.size());
    return mesh;
  }


  template <int dim>
  std::vector<unsigned int> hilbert_order(const std::vector<Vec<dim>> &position)
  {
    const auto               points = points_of<dim>(position);
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    CGAL::hilbert_sort(order.begin(), order.end(), typename Traits<dim>::SortTraits(CGAL::make_property_map(points)));
    return {order.begin(), order.end()};
  }


  template SimplexMesh<2>            alpha_shape<2>(const std::vector<Vec<2>> &, double,
                                         const std::function<bool(const SimplexMesh<2>::Cell &)> &,
                                         const std::function<bool(const SimplexMesh<2>::Cell &)> &);
  template SimplexMesh<3>            alpha_shape<3>(const std::vector<Vec<3>> &, double,
                                         const std::function<bool(const SimplexMesh<3>::Cell &)> &,
                                         const std::function<bool(const SimplexMesh<3>::Cell &)> &);
  template std::vector<unsigned int> hilbert_order<2>(const std::vector<Vec<2>> &);
  template std::vector<unsigned int> hilbert_order<3>(const std::vector<Vec<3>> &);
} // namespace Breakwater
