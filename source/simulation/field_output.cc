#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/simulation/field_output.h>
#include <breakwater/simulation/vtu_text.h>

#include <cctype>
#include <fstream>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Nodes that no cell has.
    template <int dim>
    std::vector<unsigned int> loose_nodes(const OutputMesh<dim> &mesh)
    {
      std::vector<char> in_cell(mesh.position.size(), 0);
      for (const unsigned int node : mesh.cells)
        in_cell[node] = 1;
      std::vector<unsigned int> nodes;
      for (unsigned int node = 0; node < in_cell.size(); ++node)
        if (!in_cell[node])
          nodes.push_back(node);
      return nodes;
    }

    std::string file_stem(std::string name)
    {
      for (char &c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_')
          c = '_';
      return name;
    }

    std::string escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
      return result;
    }
  } // namespace

  void write_whole_file(const fs::path &file, const std::string &content)
  {
    const fs::path temporary = file.string() + ".new";
    {
      std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
      stream << content;
      stream.close();
      if (!stream)
        throw InputError("can't write " + file.string() + ": is the disk full, or the folder not yours?");
    }
    fs::rename(temporary, file);
  }

  FieldOutput::FieldOutput(fs::path directory)
    : directory_(std::move(directory))
  {
  }

  void FieldOutput::remove_earlier()
  {
    std::ifstream pvd(directory_ / "solution.pvd");
    for (std::string line; std::getline(pvd, line);)
      {
        const std::string start = "file=\"";
        const std::size_t begin = line.find(start);
        if (begin == std::string::npos)
          continue;
        const std::string file =
          line.substr(begin + start.size(), line.find('"', begin + start.size()) - begin - start.size());
        if (file.find('/') == std::string::npos)
          fs::remove(directory_ / file);
      }
    fs::remove(directory_ / "solution.pvd");
  }

  template <int dim>
  void FieldOutput::write(const double time, const std::vector<std::pair<std::string, OutputMesh<dim>>> &meshes)
  {
    ++n_times_;
    char number[16];
    std::snprintf(number, sizeof(number), "-%04u.vtu", n_times_);
    unsigned int part = 0;
    for (const auto &[name, mesh] : meshes)
      {
        // An empty mesh still gets its file: readers expect the same parts at every time.
        const std::string file = file_stem(name) + number;
        write_whole_file(directory_ / file, vtu_text(mesh, mesh.cells, mesh.vertices_per_cell, time));
        records_.push_back({time, part++, name, file});

        const std::vector<unsigned int> loose = loose_nodes(mesh);
        if (!loose.empty())
          {
            const std::string loose_file = file_stem(name) + "-nodes" + number;
            write_whole_file(directory_ / loose_file, vtu_text(mesh, loose, 1, time));
            records_.push_back(
              {time, static_cast<unsigned int>(meshes.size()) + part - 1, name + " (isolated nodes)", loose_file});
          }
      }
    write_pvd();
  }

  void FieldOutput::write_pvd() const
  {
    std::ostringstream text;
    text.precision(12);
    text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const Record &record : records_)
      text << "    <DataSet timestep=\"" << record.time << "\" group=\"\" part=\"" << record.part << "\" name=\""
           << escaped(record.name) << "\" file=\"" << record.file << "\"/>\n";
    text << "  </Collection>\n</VTKFile>\n";
    write_whole_file(directory_ / "solution.pvd", text.str());
  }

  void FieldOutput::save(std::ostream &stream) const
  {
    write_binary(stream, n_times_);
    write_binary(stream, static_cast<std::uint64_t>(records_.size()));
    for (const Record &record : records_)
      {
        write_binary(stream, record.time);
        write_binary(stream, record.part);
        write_binary(stream, record.name);
        write_binary(stream, record.file);
      }
  }

  void FieldOutput::load(std::istream &stream)
  {
    read_binary(stream, n_times_);
    std::uint64_t size = 0;
    read_binary(stream, size);
    records_.clear();
    for (std::uint64_t i = 0; i < size; ++i)
      {
        Record record;
        read_binary(stream, record.time);
        read_binary(stream, record.part);
        read_binary(stream, record.name);
        read_binary(stream, record.file);
        records_.push_back(record);
      }
    write_pvd();
  }

  template void FieldOutput::write<2>(double, const std::vector<std::pair<std::string, OutputMesh<2>>> &);
  template void FieldOutput::write<3>(double, const std::vector<std::pair<std::string, OutputMesh<3>>> &);
} // namespace Breakwater
