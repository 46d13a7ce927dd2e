#include "solid_mesh.h"

#include <breakwater/base/exceptions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    constexpr unsigned int power(const unsigned int base, const unsigned int exponent)
    {
      return exponent == 0 ? 1 : base * power(base, exponent - 1);
    }

    template <int dim>
    dealii::Point<dim> as_point(const Vec<dim> &x)
    {
      dealii::Point<dim> point;
      for (int d = 0; d < dim; ++d)
        point[d] = x[d];
      return point;
    }

    template <int dim>
    std::string text(const dealii::Point<dim> &point)
    {
      std::ostringstream stream;
      stream << '(';
      for (int d = 0; d < dim; ++d)
        stream << (d > 0 ? ", " : "") << point[d];
      stream << ") m";
      return stream.str();
    }

    [[noreturn]] void fail_mapped_cell(const std::string &place)
    {
      throw InputError("the cell of the mapped mesh " + place +
                       " has no volume there or is turned inside out: the mapping must keep the sense of rotation, and "
                       "may not fold the box or draw a corner of a cell out to a straight line");
    }

    /// Cells are multilinear between their vertices. In 2D the Jacobian is the smallest at a corner.
    template <int dim>
    void check_corners(const dealii::Triangulation<dim> &triangulation)
    {
      using Geometry = dealii::GeometryInfo<dim>;
      for (const auto &cell : triangulation.active_cell_iterators())
        {
          dealii::Point<dim>     corner[Geometry::vertices_per_cell];
          dealii::Tensor<0, dim> volume[Geometry::vertices_per_cell]; // of the edges that meet there
          for (const unsigned int v : cell->vertex_indices())
            corner[v] = cell->vertex(v);
          Geometry::alternating_form_at_vertices(corner, volume);
          for (const unsigned int v : cell->vertex_indices())
            if (!(volume[v] > 1e-14 * std::pow(cell->diameter(), dim)))
              fail_mapped_cell("with a corner at " + text(corner[v]));
        }
    }

    /// Turns a facet so that its normal points away from a place inside its cell.
    void orient(std::array<unsigned int, 2> &facet, const std::vector<Vec<2>> &nodes, const Vec<2> &inside)
    {
      const Vec<2> tangent = nodes[facet[1]] - nodes[facet[0]];
      if (dot(Vec<2>{{tangent[1], -tangent[0]}}, nodes[facet[0]] - inside) < 0)
        std::swap(facet[0], facet[1]);
    }

    void orient(std::array<unsigned int, 4> &facet, const std::vector<Vec<3>> &nodes, const Vec<3> &inside)
    {
      const Vec<3> normal = cross(nodes[facet[2]] - nodes[facet[0]], nodes[facet[3]] - nodes[facet[1]]);
      if (dot(normal, nodes[facet[0]] - inside) < 0)
        std::swap(facet[1], facet[3]);
    }

    /// Adds the linear facets of face 2 direction + side of a cell, whose nodes stand in `cell_nodes`.
    template <int dim>
    void add_facets(SolidMesh<dim> &mesh, const unsigned int *cell_nodes, const unsigned int face,
                    const unsigned int boundary, const Vec<dim> &inside)
    {
      const unsigned int n         = mesh.degree + 1;
      const unsigned int direction = face / 2;
      const unsigned int start     = (face % 2) * mesh.degree * power(n, direction);
      const unsigned int stride_1  = direction == 0 ? n : 1;
      const unsigned int stride_2  = direction == 2 ? n : n * n;
      for (unsigned int j = 0; j < (dim == 3 ? mesh.degree : 1); ++j)
        for (unsigned int i = 0; i < mesh.degree; ++i)
          {
            const unsigned int            *corner = cell_nodes + start + i * stride_1 + j * stride_2;
            typename SolidMesh<dim>::Facet facet;
            facet.boundary = boundary;
            facet.nodes[0] = corner[0];
            facet.nodes[1] = corner[stride_1];
            if constexpr (dim == 3)
              {
                facet.nodes[2] = corner[stride_1 + stride_2];
                facet.nodes[3] = corner[stride_2];
              }
            orient(facet.nodes, mesh.nodes, inside);
            mesh.facets.push_back(facet);
          }
    }
  } // namespace


  template <int dim>
  Vec<dim> SolidMesh<dim>::cell_centre(const unsigned int cell) const
  {
    Vec<dim> sum;
    for (unsigned int i = 0; i < nodes_per_cell(); ++i)
      sum += nodes[cell_nodes[cell * nodes_per_cell() + i]];
    return sum * (1. / nodes_per_cell());
  }


  template <int dim>
  SolidMesh<dim> make_solid_mesh(const BoxMesh<dim> &box, const unsigned int degree,
                                 const std::function<Vec<dim>(const Vec<dim> &)> &place)
  {
    using namespace dealii;
    if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) != 1)
      throw InputError("a structure runs on one rank only so far: start the program without mpirun, or with -n 1");

    parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
    const std::vector<unsigned int>           n_cells(box.n_cells.begin(), box.n_cells.end());
    GridGenerator::subdivided_hyper_rectangle(triangulation, n_cells, as_point(box.lower), as_point(box.upper), true);
    if (place)
      GridTools::transform(
        [&place](const Point<dim> &point) {
          Vec<dim> x;
          for (int d = 0; d < dim; ++d)
            x[d] = point[d];
          return as_point(place(x));
        },
        triangulation);
    check_corners(triangulation);
    const FE_Q<dim> fe(degree);
    DoFHandler<dim> dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);

    const MappingQ<dim>             mapping(1);
    const std::vector<unsigned int> hierarchic = FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
    FEValues<dim> at_points(mapping, fe, QGauss<dim>(degree + 1), update_inverse_jacobians | update_JxW_values);
    FEValues<dim> at_nodes(mapping, fe, QGaussLobatto<dim>(degree + 1), update_quadrature_points | update_JxW_values);

    SolidMesh<dim> mesh;
    mesh.degree = degree;
    mesh.nodes.resize(dof_handler.n_dofs());
    const unsigned int n_nodes = fe.n_dofs_per_cell();
    mesh.cell_nodes.reserve(triangulation.n_active_cells() * n_nodes);
    std::vector<types::global_dof_index> dofs(n_nodes);
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        at_points.reinit(cell);
        at_nodes.reinit(cell);
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            const unsigned int node = dofs[hierarchic[i]];
            mesh.cell_nodes.push_back(node);
            for (int d = 0; d < dim; ++d)
              mesh.nodes[node][d] = at_nodes.quadrature_point(i)[d];
            mesh.node_volume.push_back(at_nodes.JxW(i));
            mesh.point_volume.push_back(at_points.JxW(i));
            for (int k = 0; k < dim; ++k)
              for (int j = 0; j < dim; ++j)
                mesh.inverse_jacobian.push_back(at_points.inverse_jacobian(i)[k][j]);
          }
      }

    // In 3D, corners that are right do not say that all of the cell is.
    for (std::size_t i = 0; i < mesh.point_volume.size(); ++i)
      if (!(mesh.point_volume[i] > 0 && mesh.node_volume[i] > 0))
        fail_mapped_cell("at " + text(as_point(mesh.nodes[mesh.cell_nodes[i]])));
    unsigned int index = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        for (const unsigned int face : cell->face_indices())
          if (cell->face(face)->at_boundary())
            add_facets(mesh, &mesh.cell_nodes[index * n_nodes], face, cell->face(face)->boundary_id(),
                       mesh.cell_centre(index));
        ++index;
      }
    return mesh;
  }

  template struct SolidMesh<2>;
  template struct SolidMesh<3>;
  template SolidMesh<2> make_solid_mesh(const BoxMesh<2> &, unsigned int,
                                        const std::function<Vec<2>(const Vec<2> &)> &);
  template SolidMesh<3> make_solid_mesh(const BoxMesh<3> &, unsigned int,
                                        const std::function<Vec<3>(const Vec<3> &)> &);
} // namespace Breakwater
