#include "gmsh_mesh.h"

#include <breakwater/base/exceptions.h>

#include <fstream>
#include <sstream>
#include <unordered_map>

namespace Breakwater
{
  namespace
  {
    class GmshReader
    {
    public:
      explicit GmshReader(const std::string &file)
        : file_(file)
        , stream_(file)
      {
        if (!stream_)
          throw InputError("can't read the file \"" + file + "\"");
      }

      GmshMesh read()
      {
        bool has_format = false;
        while (next_line())
          if (line_ == "$MeshFormat")
            {
              read_format();
              has_format = true;
            }
          else if (!has_format)
            fail("a gmsh file starts with $MeshFormat");
          else if (line_ == "$Nodes")
            is_version_4_ ? read_nodes_4() : read_nodes_2();
          else if (line_ == "$Elements")
            is_version_4_ ? read_elements_4() : read_elements_2();
        if (mesh_.position.empty())
          fail("the file has no nodes");
        return mesh_;
      }

    private:
      [[noreturn]] void fail(const std::string &message) const
      {
        throw InputError(file_ + ":" + std::to_string(number_) + ": " + message);
      }

      bool next_line()
      {
        if (!std::getline(stream_, line_))
          return false;
        if (!line_.empty() && line_.back() == '\r')
          line_.pop_back();
        ++number_;
        return true;
      }

      /// The numbers of the next line, at least n of them.
      std::vector<double> numbers(const std::size_t n)
      {
        if (!next_line())
          fail("the file ends too early");
        std::vector<double> result;
        std::istringstream  words(line_);
        double              value = 0;
        while (words >> value)
          result.push_back(value);
        if (result.size() < n || !words.eof())
          fail("expected " + std::to_string(n) + " numbers or more, found \"" + line_ + "\"");
        return result;
      }

      void read_format()
      {
        const std::vector<double> format = numbers(3);
        is_version_4_                    = format[0] == 4.1;
        if (!is_version_4_ && format[0] != 2.2)
          fail("format " + line_.substr(0, line_.find(' ')) + " can't be read; save the mesh as 2.2 or 4.1");
        if (format[1] != 0)
          fail("binary files can't be read; save the mesh in ASCII");
      }

      void add_node(const double tag, const double *x)
      {
        node_of_tag_[static_cast<unsigned long>(tag)] = mesh_.position.size();
        mesh_.position.push_back({{x[0], x[1], x[2]}});
      }

      void read_nodes_2()
      {
        const double n = numbers(1)[0];
        for (double i = 0; i < n; ++i)
          {
            const std::vector<double> values = numbers(4);
            add_node(values[0], &values[1]);
          }
      }

      void read_nodes_4()
      {
        const double n_blocks = numbers(4)[0];
        for (double block = 0; block < n_blocks; ++block)
          {
            const double        n = numbers(4)[3];
            std::vector<double> tags;
            for (double i = 0; i < n; ++i)
              tags.push_back(numbers(1)[0]);
            for (const double tag : tags)
              add_node(tag, numbers(3).data());
          }
      }

      template <std::size_t n>
      void add_element(const std::vector<double> &values, const std::size_t first,
                       std::vector<std::array<unsigned int, n>> &elements)
      {
        if (values.size() < first + n)
          fail("an element of " + std::to_string(n) + " nodes is expected");
        elements.emplace_back();
        for (std::size_t a = 0; a < n; ++a)
          {
            const auto node = node_of_tag_.find(static_cast<unsigned long>(values[first + a]));
            if (node == node_of_tag_.end())
              fail("node " + std::to_string(static_cast<unsigned long>(values[first + a])) + " is not in the file");
            elements.back()[a] = node->second;
          }
      }

      void add_element(const int type, const std::vector<double> &values, const std::size_t first)
      {
        if (type == 1)
          add_element(values, first, mesh_.lines);
        else if (type == 2)
          add_element(values, first, mesh_.triangles);
        else if (type == 4)
          add_element(values, first, mesh_.tetrahedra);
      }

      void read_elements_2()
      {
        const double n = numbers(1)[0];
        for (double i = 0; i < n; ++i)
          {
            const std::vector<double> values = numbers(4);
            add_element(static_cast<int>(values[1]), values, 3 + static_cast<std::size_t>(values[2]));
          }
      }

      void read_elements_4()
      {
        const double n_blocks = numbers(4)[0];
        for (double block = 0; block < n_blocks; ++block)
          {
            const std::vector<double> head = numbers(4);
            for (double i = 0; i < head[3]; ++i)
              add_element(static_cast<int>(head[2]), numbers(2), 1);
          }
      }

      std::string                                     file_, line_;
      std::ifstream                                   stream_;
      unsigned long                                   number_       = 0;
      bool                                            is_version_4_ = false;
      GmshMesh                                        mesh_;
      std::unordered_map<unsigned long, unsigned int> node_of_tag_;
    };
  } // namespace


  GmshMesh read_gmsh(const std::string &file)
  {
    return GmshReader(file).read();
  }
} // namespace Breakwater
