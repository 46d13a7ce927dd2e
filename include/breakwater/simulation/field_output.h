#pragma once

#include <breakwater/mesh/output_mesh.h>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Writes meshes with fields as VTU files and keeps solution.pvd, which lists them by time, whole:
  /// every file gets its name when it is complete.
  class FieldOutput
  {
  public:
    /// @param directory must exist
    explicit FieldOutput(std::filesystem::path directory);

    /// Removes the files of an earlier run: solution.pvd and those that it lists.
    void remove_earlier();

    /// Writes one mesh per domain at a time [s] as NAME-0001.vtu; nodes of a mesh that belong to no cell get a file
    /// of their own, NAME-nodes-0001.vtu.
    template <int dim>
    void write(double time, const std::vector<std::pair<std::string, OutputMesh<dim>>> &meshes);

    void save(std::ostream &stream) const;
    void load(std::istream &stream);

  private:
    struct Record
    {
      double       time;
      unsigned int part;
      std::string  name; ///< of the domain
      std::string  file;
    };

    void write_pvd() const;

    std::filesystem::path directory_;
    std::vector<Record>   records_;
    unsigned int          n_times_ = 0;
  };

  /// Writes a file under a temporary name that is then changed to its own: nobody ever sees half of it.
  void write_whole_file(const std::filesystem::path &file, const std::string &content);
} // namespace Breakwater
