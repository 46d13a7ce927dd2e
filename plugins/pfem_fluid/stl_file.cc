#include "stl_file.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

namespace Breakwater
{
  namespace
  {
    std::string whole_file(const std::string &file)
    {
      std::ifstream stream(file, std::ios::binary);
      if (!stream)
        throw InputError("can't read the file \"" + file + "\"");
      return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }

    /// The words of a text, one after the other, with the line for messages.
    class Words
    {
    public:
      Words(std::string file, std::string text)
        : file_(std::move(file))
        , text_(std::move(text))
      {
      }

      [[noreturn]] void fail(const std::string &message) const
      {
        const auto line = 1 + std::count(text_.begin(), text_.begin() + start_, '\n');
        throw InputError(file_ + ":" + std::to_string(line) + ": " + message);
      }

      /// Empty at the end.
      std::string next()
      {
        start_               = std::min(text_.find_first_not_of(blanks, end_), text_.size());
        end_                 = std::min(text_.find_first_of(blanks, start_), text_.size());
        const std::string it = text_.substr(start_, end_ - start_);
        return it;
      }

      double number(const std::string &meaning)
      {
        const std::string word   = next();
        char             *end    = nullptr;
        const double      result = std::strtod(word.c_str(), &end);
        if (word.empty() || *end != '\0' || !std::isfinite(result))
          fail("wanted " + meaning + ", found " + (word.empty() ? "the end of the file" : "\"" + word + "\""));
        return result;
      }

      void expect(const std::string &wanted)
      {
        const std::string word = next();
        if (word != wanted)
          fail("wanted \"" + wanted + "\", found " + (word.empty() ? "the end of the file" : "\"" + word + "\""));
      }

      void next_line() { end_ = std::min(text_.find('\n', end_), text_.size()); }

    private:
      static constexpr const char *blanks = " \t\r\n";
      std::string                  file_, text_;
      std::size_t                  start_ = 0, end_ = 0; ///< of the last word
    };

    constexpr std::size_t stl_header = 84, stl_triangle = 50; // bytes

    std::vector<std::array<Vec<3>, 3>> read_binary_stl(const std::string &text, const std::uint32_t n_triangles)
    {
      std::vector<std::array<Vec<3>, 3>> triangles(n_triangles);
      for (std::uint32_t t = 0; t < n_triangles; ++t)
        {
          float numbers[12]; // the normal and three corners
          std::memcpy(numbers, text.data() + stl_header + t * stl_triangle, sizeof(numbers));
          for (int k = 0; k < 3; ++k)
            for (int d = 0; d < 3; ++d)
              triangles[t][k][d] = numbers[3 + 3 * k + d];
        }
      return triangles;
    }

    std::vector<std::array<Vec<3>, 3>> read_ascii_stl(Words words)
    {
      std::vector<std::array<Vec<3>, 3>> triangles;
      words.expect("solid");
      words.next_line(); // the rest of it is a name
      for (std::string word = words.next(); !word.empty(); word = words.next())
        {
          if (word == "endsolid" || word == "solid")
            {
              words.next_line();
              continue;
            }
          if (word != "facet")
            words.fail("wanted \"facet\" or \"endsolid\", found \"" + word + "\"");
          words.expect("normal");
          for (int d = 0; d < 3; ++d)
            words.next();
          words.expect("outer");
          words.expect("loop");
          triangles.emplace_back();
          for (Vec<3> &corner : triangles.back())
            {
              words.expect("vertex");
              for (int d = 0; d < 3; ++d)
                corner[d] = words.number("a coordinate");
            }
          words.expect("endloop");
          words.expect("endfacet");
        }
      return triangles;
    }
  } // namespace


  std::vector<std::array<Vec<3>, 3>> read_stl(const std::string &file)
  {
    const std::string text = whole_file(file);
    // A binary file may start with "solid" too: what tells is its length.
    std::uint32_t n_triangles = 0;
    if (text.size() >= stl_header)
      std::memcpy(&n_triangles, text.data() + stl_header - 4, sizeof(n_triangles));
    const bool fits = text.size() == stl_header + stl_triangle * static_cast<std::size_t>(n_triangles);
    if (!(fits && text.size() >= stl_header) && text.substr(0, 5) != "solid")
      throw InputError("\"" + file + "\" is no STL file: it does not start with \"solid\", and its " +
                       std::to_string(text.size()) + " bytes do not fit the " + std::to_string(n_triangles) +
                       " triangles that a binary file would have");
    const auto triangles =
      fits && text.size() >= stl_header ? read_binary_stl(text, n_triangles) : read_ascii_stl(Words(file, text));
    if (triangles.empty())
      throw InputError("\"" + file + "\" has no triangles");
    return triangles;
  }
} // namespace Breakwater
