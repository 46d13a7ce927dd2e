#include "wall_shapes.h"

#include "gmsh_mesh.h"
#include "shapes.h"
#include "stl_file.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    /// "x, y; X, Y" as groups of numbers. @throws InputError
    std::vector<std::vector<double>> number_groups(const std::string &text)
    {
      std::vector<std::vector<double>> groups;
      std::istringstream               stream(text);
      for (std::string group; std::getline(stream, group, ';');)
        {
          groups.emplace_back();
          for (const std::string &word : split_list(group))
            {
              char *end = nullptr;
              groups.back().push_back(std::strtod(word.c_str(), &end));
              if (*end != '\0')
                throw InputError("\"" + word + "\" is no number");
            }
        }
      return groups;
    }

    /// The points of a polygon or a line. @throws InputError
    std::vector<Vec<2>> points_of(const std::vector<std::vector<double>> &groups, const std::size_t n_least)
    {
      std::vector<Vec<2>> points;
      for (const auto &group : groups)
        {
          if (group.size() != 2)
            throw InputError("each point has two coordinates, and a semicolon stands between two points");
          points.push_back({{group[0], group[1]}});
        }
      if (points.size() < n_least)
        throw InputError("at least " + std::to_string(n_least) + " points are needed");
      return points;
    }

    double turn(const Vec<2> &a, const Vec<2> &b, const Vec<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    /// Triangles of a simple polygon, by cutting off ears. @throws InputError if it crosses itself
    std::vector<std::array<Vec<2>, 3>> cut_into_triangles(std::vector<Vec<2>> points)
    {
      double area = 0;
      for (std::size_t k = 0; k < points.size(); ++k)
        area += turn(points[0], points[k], points[(k + 1) % points.size()]);
      if (area < 0)
        std::reverse(points.begin(), points.end());
      std::vector<std::array<Vec<2>, 3>> triangles;
      while (points.size() > 2)
        {
          const std::size_t n       = points.size();
          bool              has_ear = false;
          for (std::size_t k = 0; k < n && !has_ear; ++k)
            {
              const Vec<2> &a = points[(k + n - 1) % n], &b = points[k], &c = points[(k + 1) % n];
              if (!(turn(a, b, c) >= 0))
                continue;
              has_ear = std::none_of(points.begin(), points.end(), [&](const Vec<2> &x) {
                return turn(a, b, x) > 0 && turn(b, c, x) > 0 && turn(c, a, x) > 0;
              });
              if (has_ear)
                {
                  triangles.push_back({a, b, c});
                  points.erase(points.begin() + k);
                }
            }
          if (!has_ear)
            throw InputError("the polygon crosses itself");
        }
      return triangles;
    }

    Vec<3> at_height(const Vec<2> &x, const double z)
    {
      return {{x[0], x[1], z}};
    }

    /// The sides of an extruded polygon or line, and the lids of a polygon.
    std::vector<std::array<Vec<3>, 3>> extrude(const std::vector<Vec<2>> &points, const bool is_closed, const double z,
                                               const double Z)
    {
      std::vector<std::array<Vec<3>, 3>> pieces;
      for (std::size_t k = 0; k + 1 < points.size() + is_closed; ++k)
        {
          const Vec<2> &a = points[k], &b = points[(k + 1) % points.size()];
          pieces.push_back({at_height(a, z), at_height(b, z), at_height(b, Z)});
          pieces.push_back({at_height(a, z), at_height(b, Z), at_height(a, Z)});
        }
      if (is_closed)
        for (const auto &[a, b, c] : cut_into_triangles(points))
          {
            pieces.push_back({at_height(a, z), at_height(c, z), at_height(b, z)});
            pieces.push_back({at_height(a, Z), at_height(b, Z), at_height(c, Z)});
          }
      return pieces;
    }

    /// A polygon or a line of points, extruded in 3D, where the first group of numbers is z, Z. @throws InputError
    template <int dim>
    std::vector<typename WallSurface<dim>::Piece> polygon_pieces(std::vector<std::vector<double>> groups,
                                                                 const bool                       is_closed)
    {
      const std::size_t n_least = is_closed ? 3 : 2;
      if constexpr (dim == 2)
        {
          const std::vector<Vec<2>>          points = points_of(groups, n_least);
          std::vector<std::array<Vec<2>, 2>> pieces;
          for (std::size_t k = 0; k + 1 < points.size() + is_closed; ++k)
            pieces.push_back({points[k], points[(k + 1) % points.size()]});
          return pieces;
        }
      else
        {
          if (groups.empty() || groups.front().size() != 2 || !(groups.front()[0] < groups.front()[1]))
            throw InputError("the numbers start with the lower and the upper z");
          const std::vector<double> heights = groups.front();
          groups.erase(groups.begin());
          return extrude(points_of(groups, n_least), is_closed, heights[0], heights[1]);
        }
    }

    template <int dim>
    std::vector<typename WallSurface<dim>::Piece> box_pieces(const BoxShape<dim> &box)
    {
      const Vec<dim>                  &a = box.lower, &b = box.upper;
      std::vector<std::vector<double>> groups = {{a[0], a[1]}, {b[0], a[1]}, {b[0], b[1]}, {a[0], b[1]}};
      if (dim == 3)
        groups.insert(groups.begin(), {a[dim - 1], b[dim - 1]});
      return polygon_pieces<dim>(groups, true);
    }

    template <int dim>
    typename WallShape<dim>::Plane parse_plane(const std::vector<std::vector<double>> &groups)
    {
      typename WallShape<dim>::Plane plane;
      if (groups.size() != 2 || groups[0].size() != dim || groups[1].size() != dim)
        throw InputError("a plane has a point and a normal of " + std::to_string(dim) + " numbers each");
      std::copy_n(groups[0].begin(), dim, plane.place.c);
      std::copy_n(groups[1].begin(), dim, plane.normal.c);
      const double length = norm(plane.normal);
      if (!(length > 0))
        throw InputError("the normal must not be zero");
      plane.normal *= 1 / length;
      return plane;
    }

    template <int dim>
    WallShape<dim> parse_box_wall(const std::string &text, const FluidSide side, const ParameterReader &reader)
    {
      const BoxShape<dim> box     = parse_box<dim>(text, reader, "Shape", {"box", "open box"});
      const bool          is_open = box.kind == "open box";
      WallShape<dim>      shape;
      shape.corners = {box.lower, box.upper};
      if (side != FluidSide::inside)
        {
          if (is_open)
            reader.fail("Shape", "an open box has the fluid inside; with Fluid side = outside or both, take a box, or "
                                 "a line in 2D and a sheet in 3D");
          shape.pieces = box_pieces(box);
          return shape;
        }
      for (int d = 0; d < dim; ++d)
        {
          Vec<dim> normal;
          normal[d] = 1;
          shape.planes.push_back({box.lower, normal});
          if (!(is_open && d == 1))
            shape.planes.push_back({box.upper, -1. * normal});
        }
      return shape;
    }

    template <int dim>
    std::vector<typename WallSurface<dim>::Piece> read_surface(const std::string &file, const bool is_stl)
    {
      if (is_stl)
        {
          if constexpr (dim == 2)
            throw InputError("an STL file has triangles, which are walls in 3D only");
          else
            return read_stl(file);
        }
      const GmshMesh                                mesh = read_gmsh(file);
      std::vector<typename WallSurface<dim>::Piece> pieces;
      const auto                                    add = [&](const auto &nodes) {
        pieces.emplace_back();
        for (int k = 0; k < dim; ++k)
          std::copy_n(mesh.position[nodes[k]].c, dim, pieces.back()[k].c);
      };
      if constexpr (dim == 2)
        std::for_each(mesh.lines.begin(), mesh.lines.end(), add);
      else
        std::for_each(mesh.triangles.begin(), mesh.triangles.end(), add);
      if (pieces.empty())
        throw InputError("\"" + file + "\" has no " + (dim == 2 ? "lines" : "triangles"));
      return pieces;
    }

    /// A shape other than a box that the text gives in numbers. @throws InputError
    template <int dim>
    void parse_numbers(const std::string &text, const FluidSide side, WallShape<dim> &shape)
    {
      const std::string polygon = dim == 2 ? "polygon" : "prism", line = dim == 2 ? "line" : "sheet";
      const std::size_t open = text.find('('), close = text.rfind(')');
      const std::string kind = trim(text.substr(0, open));
      if (kind != "plane" && kind != polygon && kind != line)
        throw InputError((text.empty() ? "no shape is given" : "unknown shape '" + kind + "'") +
                         "; allowed: box, open box, plane, " + polygon + ", " + line +
                         (dim == 2 ? ", FILE.msh" : ", FILE.stl, FILE.msh"));
      if (close == std::string::npos || close < open)
        throw InputError("the numbers in brackets are missing");
      const auto groups = number_groups(text.substr(open + 1, close - open - 1));
      if (kind == "plane")
        {
          if (side != FluidSide::inside)
            throw InputError("the normal of a plane says where the fluid is: leave out \"Fluid side\"");
          shape.planes.push_back(parse_plane<dim>(groups));
        }
      else if (kind == line && side != FluidSide::both)
        throw InputError("a " + line + " has no inside: set Fluid side = both");
      else
        shape.pieces = polygon_pieces<dim>(groups, kind == polygon);
    }
  } // namespace


  template <int dim>
  std::string wall_shape_documentation()
  {
    if (dim == 2)
      return "The wall, lengths in m: `box(x, y; X, Y)`, with the fluid inside of all its sides unless \"Fluid side\" "
             "says otherwise; `open box(...)` leaves the side of the largest y open; `plane(x, y; nx, ny)` with the "
             "normal into the fluid, without end; `polygon(x, y; X, Y; ...)`, closed; `line(x, y; X, Y; ...)`, with "
             "fluid on both sides; or a gmsh file, `NAME.msh`, in the folder of the parameter file.";
    return "The wall, lengths in m: `box(x, y, z; X, Y, Z)`, with the fluid inside of all its sides unless \"Fluid "
           "side\" says otherwise; `open box(...)` leaves the side of the largest y open; `plane(x, y, z; nx, ny, nz)` "
           "with the normal into the fluid, without end; `prism(z, Z; x, y; X, Y; ...)`, a polygon from z to Z; "
           "`sheet(z, Z; x, y; X, Y; ...)`, a line from z to Z with fluid on both sides; or a file in the folder of "
           "the parameter file, `NAME.stl` or `NAME.msh` (gmsh).";
  }


  template <int dim>
  WallShape<dim> parse_wall_shape(const std::string &text, const FluidSide side, const ParameterReader &reader)
  {
    const std::string kind       = trim(text.substr(0, text.find('(')));
    const auto        has_ending = [&](const std::string &ending) {
      return text.size() > ending.size() && lower_case(text.substr(text.size() - ending.size())) == ending;
    };
    if (kind == "box" || kind == "open box")
      return parse_box_wall<dim>(text, side, reader);
    WallShape<dim> shape;
    try
      {
        if (has_ending(".stl") || has_ending(".msh"))
          shape.pieces = read_surface<dim>(reader.file_path(text).string(), has_ending(".stl"));
        else
          parse_numbers<dim>(text, side, shape);
      }
    catch (const InputError &error)
      {
        reader.fail("Shape", error.what());
      }
    for (const auto &piece : shape.pieces)
      shape.corners.insert(shape.corners.end(), piece.begin(), piece.end());
    return shape;
  }

  template struct WallShape<2>;
  template struct WallShape<3>;
  template std::string  wall_shape_documentation<2>();
  template std::string  wall_shape_documentation<3>();
  template WallShape<2> parse_wall_shape<2>(const std::string &, FluidSide, const ParameterReader &);
  template WallShape<3> parse_wall_shape<3>(const std::string &, FluidSide, const ParameterReader &);
} // namespace Breakwater
