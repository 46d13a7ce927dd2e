#include "mesh_description.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace Breakwater
{
  namespace
  {
    std::string trimmed_lower(const std::string &text)
    {
      const auto  first = std::find_if_not(text.begin(), text.end(), [](unsigned char c) {
        return std::isspace(c);
      });
      const auto  last  = std::find_if_not(text.rbegin(), text.rend(), [](unsigned char c) {
        return std::isspace(c);
      });
      std::string result;
      if (first < last.base())
        std::transform(first, last.base(), std::back_inserter(result), [](unsigned char c) {
          return std::tolower(c);
        });
      return result;
    }

    std::vector<std::string> split(const std::string &text, const char separator)
    {
      std::vector<std::string> parts(1);
      for (const char c : text)
        if (c == separator)
          parts.emplace_back();
        else
          parts.back() += c;
      for (std::string &part : parts)
        part = trimmed_lower(part);
      return parts;
    }

    template <int dim>
    [[noreturn]] void fail_box(const std::string &text, const std::string &reason)
    {
      throw InputError(
        (text.empty() ? "no mesh is given" : "\"" + text + "\" is no mesh: " + reason) + "; expected is " +
        (dim == 3 ? "box(x0, y0, z0; x1, y1, z1; nx, ny, nz): two opposite corners [m] and the number of cells in each "
                    "direction, e.g. box(0, 0, 0; 0.012, 0.08, 0.15; 1, 6, 8)" :
                    "box(x0, y0; x1, y1; nx, ny): two opposite corners [m] and the number of cells in each direction, "
                    "e.g. box(0, 0; 0.012, 0.08; 1, 6)"));
    }

    template <int dim>
    [[noreturn]] void fail_stop(const std::string &text, const std::string &reason)
    {
      throw InputError("\"" + text + "\" is no plane: " + reason + "; expected is " +
                       (dim == 3 ? "x, y, z; nx, ny, nz: a point [m] and the normal to the allowed side, e.g. 0, 0, 0; "
                                   "0, 1, 0" :
                                   "x, y; nx, ny: a point [m] and the normal to the allowed side, e.g. 0, 0; 0, 1"));
    }

    /// The numbers of one part of a text; fail(reason) throws.
    template <int dim, class Fail>
    Vec<dim> parse_numbers(const std::string &part, const Fail &fail)
    {
      const std::vector<std::string> words = split(part, ',');
      if (words.size() != dim)
        fail("\"" + part + "\" has " + std::to_string(words.size()) + " numbers where " + std::to_string(dim) +
             " are needed");
      Vec<dim> numbers;
      for (int d = 0; d < dim; ++d)
        {
          char *end  = nullptr;
          numbers[d] = std::strtod(words[d].c_str(), &end);
          if (words[d].empty() || *end != '\0' || !std::isfinite(numbers[d]))
            fail("\"" + words[d] + "\" is no number");
        }
      return numbers;
    }
  } // namespace


  template <int dim>
  BoxMesh<dim> parse_box_mesh(const std::string &text)
  {
    const std::string trimmed = trimmed_lower(text);
    if (trimmed.empty())
      fail_box<dim>("", "");
    const std::size_t open = trimmed.find('(');
    if (open == std::string::npos || trimmed.back() != ')' || trimmed_lower(trimmed.substr(0, open)) != "box")
      fail_box<dim>(text, "it does not read box(...)");
    const std::vector<std::string> parts = split(trimmed.substr(open + 1, trimmed.size() - open - 2), ';');
    if (parts.size() != 3)
      fail_box<dim>(text, "it has " + std::to_string(parts.size()) + " parts between semicolons where 3 are needed");

    const auto fail = [&text](const std::string &reason) {
      fail_box<dim>(text, reason);
    };
    const Vec<dim> lower = parse_numbers<dim>(parts[0], fail), upper = parse_numbers<dim>(parts[1], fail),
                   n_cells = parse_numbers<dim>(parts[2], fail);
    BoxMesh<dim> box;
    for (int d = 0; d < dim; ++d)
      {
        if (!(lower[d] < upper[d]))
          fail_box<dim>(text, "the first corner must be smaller than the second in every coordinate");
        if (n_cells[d] < 1 || n_cells[d] > 1e6 || n_cells[d] != std::floor(n_cells[d]))
          fail_box<dim>(text, "the numbers of cells must be whole, from 1 to 1000000");
        box.lower[d]   = lower[d];
        box.upper[d]   = upper[d];
        box.n_cells[d] = static_cast<unsigned int>(n_cells[d]);
      }
    return box;
  }


  template <int dim>
  std::vector<Stop<dim>> parse_stops(const std::string &text)
  {
    std::vector<Stop<dim>> stops;
    if (trimmed_lower(text).empty())
      return stops;
    for (const std::string &plane : split(text, '|'))
      {
        const auto fail = [&plane](const std::string &reason) {
          fail_stop<dim>(plane, reason);
        };
        const std::vector<std::string> parts = split(plane, ';');
        if (parts.size() != 2)
          fail("it has " + std::to_string(parts.size()) + " parts between semicolons where 2 are needed");
        const Vec<dim> place = parse_numbers<dim>(parts[0], fail), normal = parse_numbers<dim>(parts[1], fail);
        if (!(norm(normal) > 0))
          fail("the normal has no length");
        stops.push_back({place, normal * (1 / norm(normal))});
      }
    return stops;
  }


  template <int dim>
  std::vector<std::string> boundary_names()
  {
    const std::vector<std::string> names = {"left", "right", "bottom", "top", "front", "back"};
    return {names.begin(), names.begin() + 2 * dim};
  }


  template <int dim>
  std::array<bool, 2 * dim> parse_boundaries(const std::vector<std::string> &names)
  {
    const std::vector<std::string> known  = boundary_names<dim>();
    std::array<bool, 2 *dim>       marked = {};
    for (const std::string &name : names)
      {
        const auto found = std::find(known.begin(), known.end(), trimmed_lower(name));
        if (found == known.end())
          {
            std::string list;
            for (const std::string &k : known)
              list += (list.empty() ? "" : ", ") + k;
            throw InputError("there is no boundary \"" + name + "\"; a box has " + list);
          }
        if (marked[found - known.begin()])
          throw InputError("the boundary \"" + name + "\" is named twice");
        marked[found - known.begin()] = true;
      }
    return marked;
  }

  template BoxMesh<2>               parse_box_mesh<2>(const std::string &);
  template BoxMesh<3>               parse_box_mesh<3>(const std::string &);
  template std::vector<Stop<2>>     parse_stops<2>(const std::string &);
  template std::vector<Stop<3>>     parse_stops<3>(const std::string &);
  template std::vector<std::string> boundary_names<2>();
  template std::vector<std::string> boundary_names<3>();
  template std::array<bool, 4>      parse_boundaries<2>(const std::vector<std::string> &);
  template std::array<bool, 6>      parse_boundaries<3>(const std::vector<std::string> &);
} // namespace Breakwater
