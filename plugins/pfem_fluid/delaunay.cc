#include "delaunay.h"

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
      using Face          = CGAL::Triangulation_face_base_with_info_2<unsigned int, Kernel>;
      using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
      using Point         = Kernel::Point_2;
      using PointMap      = CGAL::Pointer_property_map<Point>::const_type;
      using SortTraits    = CGAL::Spatial_sort_traits_adapter_2<Kernel, PointMap>;

      static Point point(const Vec<2> &x) { return {x[0], x[1]}; }
      static auto  all_cells(const Triangulation &t) { return t.all_face_handles(); }
      static auto  finite_cells(const Triangulation &t) { return t.finite_face_handles(); }
      static int   orientation(const std::array<Point, 3> &x)
      {
        return Kernel().orientation_2_object()(x[0], x[1], x[2]);
      }
      static int side_of_sphere(const std::array<Point, 3> &x, const Point &p)
      {
        return Kernel().side_of_oriented_circle_2_object()(x[0], x[1], x[2], p);
      }
    };

    template <>
    struct Traits<3>
    {
      using Vertex        = CGAL::Triangulation_vertex_base_with_info_3<unsigned int, Kernel>;
      using Cell          = CGAL::Triangulation_cell_base_with_info_3<unsigned int, Kernel,
                                                             CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
      using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
      using Point         = Kernel::Point_3;
      using PointMap      = CGAL::Pointer_property_map<Point>::const_type;
      using SortTraits    = CGAL::Spatial_sort_traits_adapter_3<Kernel, PointMap>;

      static Point point(const Vec<3> &x) { return {x[0], x[1], x[2]}; }
      static auto  all_cells(const Triangulation &t) { return t.all_cell_handles(); }
      static auto  finite_cells(const Triangulation &t) { return t.finite_cell_handles(); }
      static int   orientation(const std::array<Point, 4> &x)
      {
        return Kernel().orientation_3_object()(x[0], x[1], x[2], x[3]);
      }
      static int side_of_sphere(const std::array<Point, 4> &x, const Point &p)
      {
        return Kernel().side_of_oriented_sphere_3_object()(x[0], x[1], x[2], x[3], p);
      }
    };

    template <int dim>
    std::array<typename Traits<dim>::Point, dim + 1> points_of(const std::array<Vec<dim>, dim + 1> &x)
    {
      std::array<typename Traits<dim>::Point, dim + 1> points;
      for (int a = 0; a <= dim; ++a)
        points[a] = Traits<dim>::point(x[a]);
      return points;
    }
  } // namespace


  template <int dim>
  std::vector<LinkedCell<dim>> delaunay(const std::vector<Vec<dim>> &points)
  {
    using T = Traits<dim>;
    typename T::Triangulation                               triangulation;
    std::vector<std::pair<typename T::Point, unsigned int>> numbered(points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      numbered[i] = {T::point(points[i]), i};
    triangulation.insert(numbered.begin(), numbered.end());

    std::vector<LinkedCell<dim>> cells;
    if (static_cast<int>(triangulation.dimension()) < dim)
      return cells;
    for (const auto handle : T::all_cells(triangulation))
      handle->info() = no_cell;
    unsigned int n_cells = 0;
    for (const auto handle : T::finite_cells(triangulation))
      handle->info() = n_cells++;
    cells.reserve(n_cells);
    for (const auto handle : T::finite_cells(triangulation))
      {
        LinkedCell<dim> cell;
        for (int a = 0; a <= dim; ++a)
          {
            cell.node[a]     = handle->vertex(a)->info();
            cell.neighbor[a] = handle->neighbor(a)->info();
          }
        cells.push_back(cell);
      }
    return cells;
  }


  template <int dim>
  int exact_orientation(const std::array<Vec<dim>, dim + 1> &x)
  {
    return Traits<dim>::orientation(points_of<dim>(x));
  }


  template <int dim>
  bool exact_in_sphere(const std::array<Vec<dim>, dim + 1> &x, const Vec<dim> &point)
  {
    const auto corners = points_of<dim>(x);
    const auto p       = Traits<dim>::point(point);
    const int  side    = Traits<dim>::side_of_sphere(corners, p);
    if (side != 0)
      return side > 0;

    // The lexicographically largest point is lifted most: if that is the new one, it is out; if it is a corner, the
    // sphere moves away from the new point or towards it, as the corner replaced by the point is oriented.
    std::array<int, dim + 2> order;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const int a, const int b) {
      return std::lexicographical_compare((a <= dim ? x[a] : point).c, (a <= dim ? x[a] : point).c + dim,
                                          (b <= dim ? x[b] : point).c, (b <= dim ? x[b] : point).c + dim);
    });
    for (int i = dim + 1; i >= 0; --i)
      {
        if (order[i] > dim)
          return false;
        auto replaced      = corners;
        replaced[order[i]] = p;
        const int sign     = Traits<dim>::orientation(replaced);
        if (sign != 0)
          return sign > 0;
      }
    return false;
  }


  template <int dim>
  std::vector<unsigned int> hilbert_order(const std::vector<Vec<dim>> &position)
  {
    std::vector<typename Traits<dim>::Point> points;
    points.reserve(position.size());
    for (const Vec<dim> &x : position)
      points.push_back(Traits<dim>::point(x));
    const typename Traits<dim>::PointMap map(points.data());
    std::vector<std::size_t>             order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    CGAL::hilbert_sort(order.begin(), order.end(), typename Traits<dim>::SortTraits(map));
    return {order.begin(), order.end()};
  }


#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template std::vector<LinkedCell<dim>> delaunay<dim>(const std::vector<Vec<dim>> &);                                  \
  template int                          exact_orientation<dim>(const std::array<Vec<dim>, dim + 1> &);                 \
  template bool                         exact_in_sphere<dim>(const std::array<Vec<dim>, dim + 1> &, const Vec<dim> &); \
  template std::vector<unsigned int>    hilbert_order<dim>(const std::vector<Vec<dim>> &);
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
