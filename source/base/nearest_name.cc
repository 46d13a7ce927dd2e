#include <breakwater/base/nearest_name.h>

#include <algorithm>
#include <cctype>

namespace Breakwater
{
  std::string lower_case(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) {
      return std::tolower(c);
    });
    return text;
  }

  std::string trim(const std::string &text)
  {
    const char *const white = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(white);
    if (begin == std::string::npos)
      return "";
    return text.substr(begin, text.find_last_not_of(white) - begin + 1);
  }

  unsigned int edit_distance(const std::string &a, const std::string &b)
  {
    const std::string s = lower_case(a), t = lower_case(b);
    const std::size_t columns = t.size() + 1;
    // d(i, j): distance of the first i letters of s to the first j of t, row by row.
    std::vector<unsigned int> d((s.size() + 1) * columns);
    for (std::size_t i = 0; i <= s.size(); ++i)
      for (std::size_t j = 0; j <= t.size(); ++j)
        {
          unsigned int &here = d[i * columns + j];
          if (i == 0 || j == 0)
            {
              here = i + j;
              continue;
            }
          here = std::min({d[(i - 1) * columns + j] + 1, d[i * columns + j - 1] + 1,
                           d[(i - 1) * columns + j - 1] + (s[i - 1] == t[j - 1] ? 0u : 1u)});
          if (i > 1 && j > 1 && s[i - 1] == t[j - 2] && s[i - 2] == t[j - 1])
            here = std::min(here, d[(i - 2) * columns + j - 2] + 1);
        }
    return d.back();
  }

  std::string nearest_name(const std::string &name, const std::vector<std::string> &known)
  {
    std::string  best;
    unsigned int least = std::max<unsigned int>(1, name.size() / 3) + 1;
    for (const std::string &candidate : known)
      {
        const unsigned int distance = edit_distance(name, candidate);
        if (distance < least)
          {
            least = distance;
            best  = candidate;
          }
      }
    return best;
  }

  std::string suggestion(const std::string &name, const std::vector<std::string> &known)
  {
    std::string       text;
    const std::string nearest = nearest_name(name, known);
    if (!nearest.empty())
      text += "; did you mean \"" + nearest + "\"?";
    text += nearest.empty() ? "; allowed here: " : " Allowed here: ";
    if (known.empty())
      return text + "nothing";
    for (std::size_t i = 0; i < known.size(); ++i)
      text += (i == 0 ? "" : ", ") + known[i];
    return text;
  }
} // namespace Breakwater
