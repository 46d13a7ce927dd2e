#include "fluid_shape.h"

#include "given_nodes.h"
#include "shape_text.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace Breakwater
{
  namespace
  {
    /// What a region may depend on besides its own text.
    template <int dim>
    struct Scene
    {
      const BoxShape<dim>   &walls;
      const ParameterReader &reader;
    };

    template <int dim>
    BoxShape<dim> read_box(const ShapeText &text, const std::vector<double> &numbers)
    {
      const BoxShape<dim> box = {"box", vec<dim>(numbers, 0), vec<dim>(numbers, dim)};
      for (int d = 0; d < dim; ++d)
        if (!(box.lower[d] < box.upper[d]))
          text.fail("the second corner must be larger than the first in every coordinate");
      return box;
    }

    void require_positive(const ShapeText &text, const std::vector<double> &numbers, const std::size_t first)
    {
      for (std::size_t i = first; i < numbers.size(); ++i)
        if (!(numbers[i] > 0))
          text.fail("radii must be positive");
    }

    Polygon read_polygon(const ShapeText &text, const std::vector<double> &numbers, const std::size_t first)
    {
      const std::size_t n = numbers.size() - std::min(first, numbers.size());
      if (n < 6 || n % 2 != 0)
        text.fail("a polygon needs three corners x, y or more");
      Polygon polygon;
      for (std::size_t i = first; i < numbers.size(); i += 2)
        polygon.vertices.push_back(vec<2>(numbers, i));
      if (polygon.crosses_itself() || !(std::abs(polygon.area()) > 0))
        text.fail("the edges of the polygon cross each other or enclose nothing");
      return polygon;
    }

    /// What a half space cuts out of the box around all walls.
    template <int dim>
    std::unique_ptr<Region<dim>> make_half_space(const ShapeText &text, const Scene<dim> &scene)
    {
      const auto values = text.numbers(2 * dim, dim == 2 ? "(x, y; nx, ny)" : "(x, y, z; nx, ny, nz)");
      const auto point = vec<dim>(values, 0), normal = vec<dim>(values, dim);
      if (!(norm(normal) > 0))
        text.fail("the normal is zero");
      const BoxShape<dim> &walls = scene.walls;
      if (walls.kind.empty())
        text.fail("a half space fills the box around all walls, and there are no walls");
      int along = -1, n_along = 0;
      for (int d = 0; d < dim; ++d)
        if (normal[d] != 0)
          {
            along = d;
            ++n_along;
          }
      bool          is_empty = false;
      BoxShape<dim> box      = walls;
      if (n_along == 1)
        {
          if (normal[along] > 0)
            box.upper[along] = std::min(box.upper[along], point[along]);
          else
            box.lower[along] = std::max(box.lower[along], point[along]);
          is_empty = !(box.lower[along] < box.upper[along]);
          if (!is_empty)
            return std::make_unique<BoxRegion<dim>>(box);
        }
      else if constexpr (dim == 2)
        {
          const Vec<2> &a = walls.lower, &b = walls.upper;
          const Polygon left = {cut<2>({a, {{b[0], a[1]}}, b, {{a[0], b[1]}}}, point, normal)};
          is_empty           = left.vertices.empty();
          if (!is_empty)
            return std::make_unique<Prism<2>>(left, 0., 0.);
        }
      else
        {
          auto region = std::make_unique<CutBox>(walls, point, normal);
          is_empty    = region->empty();
          if (!is_empty)
            return region;
        }
      text.fail("nothing of the box around all walls is on the side opposite to the normal");
    }

    template <int dim>
    using Maker = std::function<std::unique_ptr<Region<dim>>(const ShapeText &, const Scene<dim> &)>;

    template <int dim>
    struct Kind
    {
      std::string word;
      Maker<dim>  make;
    };

    const std::string place[] = {"", "", "x, y", "x, y, z"}, corner[] = {"", "", "X, Y", "X, Y, Z"},
                      half_axes[] = {"", "", "a, b", "a, b, c"};

    template <int dim>
    std::vector<Kind<dim>> kinds()
    {
      std::vector<Kind<dim>> result = {
        {"box",
         [](const ShapeText &text, const Scene<dim> &) {
           const auto values = text.numbers(2 * dim, "(" + place[dim] + "; " + corner[dim] + ")");
           return std::make_unique<BoxRegion<dim>>(read_box<dim>(text, values));
         }},
        {"sphere",
         [](const ShapeText &text, const Scene<dim> &) {
           const auto values = text.numbers(dim + 1, "(" + place[dim] + "; r)");
           require_positive(text, values, dim);
           Vec<dim> radii;
           std::fill_n(radii.c, dim, values[dim]);
           return std::make_unique<Ellipsoid<dim>>(vec<dim>(values, 0), radii);
         }},
        {dim == 2 ? "ellipse" : "ellipsoid",
         [](const ShapeText &text, const Scene<dim> &) {
           const auto values = text.numbers(2 * dim, "(" + place[dim] + "; " + half_axes[dim] + ")");
           require_positive(text, values, dim);
           return std::make_unique<Ellipsoid<dim>>(vec<dim>(values, 0), vec<dim>(values, dim));
         }},
        {"half space", make_half_space<dim>},
        {"mesh",
         [](const ShapeText &text, const Scene<dim> &scene) {
           return std::make_unique<MeshRegion<dim>>(scene.reader.file_path(text.inside).string());
         }},
        {"spray", [](const ShapeText &text, const Scene<dim> &) {
           const auto values = text.numbers(2 * dim + 1, "(" + place[dim] + "; " + corner[dim] + "; n)");
           if (!(values.back() >= 1 && values.back() <= 1e7) || std::floor(values.back()) != values.back())
             text.fail("the number of nodes must be a whole number, at least 1");
           return std::make_unique<Spray<dim>>(read_box<dim>(text, values), static_cast<unsigned int>(values.back()));
         }}};
      if constexpr (dim == 2)
        result.push_back({"polygon", [](const ShapeText &text, const Scene<2> &) {
                            return std::make_unique<Prism<2>>(read_polygon(text, text.numbers(), 0), 0., 0.);
                          }});
      else
        {
          result.push_back({"prism", [](const ShapeText &text, const Scene<3> &) {
                              const auto values  = text.numbers();
                              const auto polygon = read_polygon(text, values, 2);
                              if (!(values[0] < values[1]))
                                text.fail("the first number, the lowest z, must be less than the second, the highest");
                              return std::make_unique<Prism<3>>(polygon, values[0], values[1]);
                            }});
          result.push_back({"cylinder", [](const ShapeText &text, const Scene<3> &) {
                              const auto values = text.numbers(7, "(x, y, z; X, Y, Z; r)");
                              require_positive(text, values, 6);
                              const Vec<3> start = vec<3>(values, 0), end = vec<3>(values, 3);
                              if (!(norm(end - start) > 0))
                                text.fail("the two ends of the axis are the same");
                              return std::make_unique<Cylinder>(start, end, values[6]);
                            }});
        }
      return result;
    }

    template <int dim>
    std::unique_ptr<Region<dim>> make_region(const ShapeText &text, const Scene<dim> &scene)
    {
      std::vector<std::string> words;
      for (const auto &kind : kinds<dim>())
        {
          if (kind.word == text.word)
            return kind.make(text, scene);
          words.push_back(kind.word);
        }
      fail_unknown_word(text.word, words, dim);
    }
  } // namespace


  template <int dim>
  std::string FluidShape<dim>::documentation()
  {
    return "Where the fluid is at time 0: shapes joined by `+` and taken away by `-`, from left to right [m]: `box(" +
           place[dim] + "; " + corner[dim] + ")`, `sphere(" + place[dim] + "; r)`, `" +
           (dim == 2 ? "ellipse" : "ellipsoid") + "(" + place[dim] + "; " + half_axes[dim] + ")`, " +
           (dim == 2 ? "`polygon(x, y; x, y; ...)`" :
                       "`cylinder(x, y, z; X, Y, Z; r)`, `prism(lowest z, highest z; x, y; x, y; ...)`") +
           ", `half space(" + place[dim] +
           "; normal)` (what is on the side opposite to the normal in the box around all walls), `mesh(FILE.msh)` "
           "(nodes of a gmsh file of format 2.2 or 4.1, as they are), `spray(" +
           place[dim] + "; " + corner[dim] + "; n)` (n nodes in a box, each alone).";
  }


  template <int dim>
  FluidShape<dim>::FluidShape(const std::string &text, const BoxShape<dim> &walls, const ParameterReader &reader)
  {
    if (trim(text).empty())
      throw InputError("no shape is given. " + documentation());
    bool        is_taken_away = false;
    std::size_t cursor        = 0;
    while (cursor != std::string::npos)
      {
        parts_.push_back({make_region<dim>(ShapeText::next(text, cursor), {walls, reader}), is_taken_away});
        if (cursor != std::string::npos)
          {
            is_taken_away = text[cursor] == '-';
            if (text[cursor] != '+' && text[cursor] != '-')
              throw InputError("expected + or - between two shapes, found \"" + text.substr(cursor) + "\"");
            ++cursor;
          }
      }
  }


  template <int dim>
  double FluidShape<dim>::distance(const Vec<dim> &x) const
  {
    double result = std::numeric_limits<double>::infinity();
    for (const Part &part : parts_)
      {
        const double distance = part.region->distance(x);
        result                = part.is_taken_away ? std::max(result, -distance) : std::min(result, distance);
      }
    return result;
  }


  template <int dim>
  BoxShape<dim> FluidShape<dim>::extent() const
  {
    BoxShape<dim> box = parts_.front().region->extent();
    for (const Part &part : parts_)
      if (!part.is_taken_away)
        {
          const BoxShape<dim> other = part.region->extent();
          for (int d = 0; d < dim; ++d)
            {
              box.lower[d] = std::min(box.lower[d], other.lower[d]);
              box.upper[d] = std::max(box.upper[d], other.upper[d]);
            }
        }
    return box;
  }

  template class FluidShape<2>;
  template class FluidShape<3>;
} // namespace Breakwater
