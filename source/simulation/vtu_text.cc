#include <breakwater/simulation/vtu_text.h>

#include <array>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include <zlib.h>

namespace Breakwater
{
  namespace
  {
    constexpr unsigned int no_point = static_cast<unsigned int>(-1);

    /// Base64 (RFC 4648, section 4).
    std::string encoded(const unsigned char *bytes, const std::size_t n)
    {
      const char *letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::string text;
      text.reserve((n + 2) / 3 * 4);
      for (std::size_t i = 0; i < n; i += 3)
        {
          const std::uint32_t three =
            bytes[i] << 16 | (i + 1 < n ? bytes[i + 1] << 8 : 0) | (i + 2 < n ? bytes[i + 2] : 0);
          text += letters[three >> 18];
          text += letters[three >> 12 & 63];
          text += i + 1 < n ? letters[three >> 6 & 63] : '=';
          text += i + 2 < n ? letters[three & 63] : '=';
        }
      return text;
    }

    /// An array as one compressed block behind its sizes: number of blocks, of bytes in each, in a last shorter one,
    /// and of compressed bytes.
    template <class T>
    std::string compressed(const std::vector<T> &values)
    {
      if (values.empty())
        return encoded(std::vector<unsigned char>(3 * sizeof(std::uint32_t), 0).data(), 3 * sizeof(std::uint32_t));
      const auto                *bytes = reinterpret_cast<const unsigned char *>(values.data());
      const uLong                n     = values.size() * sizeof(T);
      std::vector<unsigned char> packed(compressBound(n));
      uLongf                     n_packed = packed.size();
      if (compress2(packed.data(), &n_packed, bytes, n, Z_BEST_SPEED) != Z_OK)
        throw std::runtime_error("zlib could not compress a field");
      const auto                         size  = static_cast<std::uint32_t>(n);
      const std::array<std::uint32_t, 4> sizes = {{1, size, size, static_cast<std::uint32_t>(n_packed)}};
      return encoded(reinterpret_cast<const unsigned char *>(sizes.data()), sizeof(sizes)) +
             encoded(packed.data(), n_packed);
    }

    template <class T>
    void add_array(std::ostream &text, const std::string &name, const std::vector<T> &values,
                   const unsigned int n_components = 1)
    {
      const char *type = std::is_same<T, float>::value ? "Float32" : sizeof(T) == 1 ? "UInt8" : "Int32";
      text << "<DataArray type=\"" << type << (name.empty() ? "" : "\" Name=\"") << name << "\" NumberOfComponents=\""
           << n_components << "\" format=\"binary\">" << compressed(values) << "</DataArray>\n";
    }

    /// The nodes that cells have, as points of the file.
    struct Points
    {
      std::vector<unsigned int> node;         ///< [point]
      std::vector<std::int32_t> connectivity; ///< points of the cells [cell][vertex]

      Points(const std::vector<unsigned int> &cells, const std::size_t n_nodes)
      {
        std::vector<unsigned int> point(n_nodes, no_point);
        connectivity.reserve(cells.size());
        for (const unsigned int i : cells)
          {
            if (point[i] == no_point)
              {
                point[i] = node.size();
                node.push_back(i);
              }
            connectivity.push_back(point[i]);
          }
      }

      /// The values at the points, of all nodes' values(node)[component]; vectors get three components.
      template <class Values>
      std::vector<float> vectors(const unsigned int n_components, const Values &values) const
      {
        std::vector<float> result(3 * node.size(), 0.f);
        for (std::size_t p = 0; p < node.size(); ++p)
          for (unsigned int i = 0; i < n_components; ++i)
            result[3 * p + i] = static_cast<float>(values(node[p])[i]);
        return result;
      }
    };

    /// VTK's type of a cell, and its order of vertices in ours.
    template <int dim>
    std::pair<std::uint8_t, std::vector<unsigned int>> vtk_cell(const unsigned int vertices_per_cell)
    {
      if (vertices_per_cell == 1)
        return {1, {0}};
      if (vertices_per_cell == 4 && dim == 2)
        return {9, {0, 1, 3, 2}};
      if (vertices_per_cell == 8)
        return {12, {0, 1, 3, 2, 4, 5, 7, 6}};
      return vertices_per_cell == 3 ? std::pair<std::uint8_t, std::vector<unsigned int>>{5, {0, 1, 2}} :
                                      std::pair<std::uint8_t, std::vector<unsigned int>>{10, {0, 1, 2, 3}};
    }
  } // namespace


  template <int dim>
  std::string vtu_text(const OutputMesh<dim> &mesh, const std::vector<unsigned int> &cells,
                       const unsigned int vertices_per_cell, const double time)
  {
    const auto [type, order]          = vtk_cell<dim>(vertices_per_cell);
    const std::size_t         n_cells = cells.size() / vertices_per_cell;
    std::vector<unsigned int> in_order(cells.size());
    std::vector<std::int32_t> ends(n_cells);
    for (std::size_t c = 0; c < n_cells; ++c)
      {
        for (unsigned int v = 0; v < vertices_per_cell; ++v)
          in_order[c * vertices_per_cell + v] = cells[c * vertices_per_cell + order[v]];
        ends[c] = (c + 1) * vertices_per_cell;
      }
    const Points points(in_order, mesh.position.size());

    std::ostringstream text;
    text.precision(9);
    text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" "
         << "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n<FieldData>\n<DataArray type=\"Float32\" "
         << "Name=\"TIME\" NumberOfTuples=\"1\" format=\"ascii\">" << time << "</DataArray>\n</FieldData>\n"
         << "<Piece NumberOfPoints=\"" << points.node.size() << "\" NumberOfCells=\"" << n_cells << "\">\n<Points>\n";
    add_array(text, "",
              points.vectors(dim,
                             [&](const unsigned int i) {
                               return mesh.position[i].c;
                             }),
              3);
    text << "</Points>\n<Cells>\n";
    add_array(text, "connectivity", points.connectivity);
    add_array(text, "offsets", ends);
    add_array(text, "types", std::vector<std::uint8_t>(n_cells, type));
    text << "</Cells>\n<PointData>\n";
    for (const auto &field : mesh.fields)
      if (field.n_components > 1)
        add_array(text, field.name,
                  points.vectors(field.n_components,
                                 [&](const unsigned int i) {
                                   return field.values.data() + i * field.n_components;
                                 }),
                  3);
      else
        {
          std::vector<float> values;
          for (const unsigned int i : points.node)
            values.push_back(static_cast<float>(field.values[i]));
          add_array(text, field.name, values);
        }
    text << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return text.str();
  }

  template std::string vtu_text<2>(const OutputMesh<2> &, const std::vector<unsigned int> &, unsigned int, double);
  template std::string vtu_text<3>(const OutputMesh<3> &, const std::vector<unsigned int> &, unsigned int, double);
} // namespace Breakwater
