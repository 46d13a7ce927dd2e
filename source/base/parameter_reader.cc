#include <breakwater/base/nearest_name.h>
#include <breakwater/base/parameter_reader.h>

#include <sstream>

namespace Breakwater
{
  std::vector<std::string> split_list(const std::string &text)
  {
    std::vector<std::string> parts;
    std::istringstream       stream(text);
    for (std::string part; std::getline(stream, part, ',');)
      if (!trim(part).empty())
        parts.push_back(trim(part));
    return parts;
  }
} // namespace Breakwater
