#include <breakwater/simulation/json_object.h>

#include <cmath>
#include <cstdio>

namespace Breakwater
{
  namespace
  {
    std::string json_of(const double value)
    {
      if (!std::isfinite(value))
        return "null";
      char text[40];
      std::snprintf(text, sizeof(text), "%.10g", value);
      return text;
    }

    std::string json_of(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        if (c == '"' || c == '\\')
          result += std::string("\\") + c;
        else if (static_cast<unsigned char>(c) < 0x20)
          {
            char code[8];
            std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned int>(static_cast<unsigned char>(c)));
            result += code;
          }
        else
          result += c;
      return result + "\"";
    }

    template <class T>
    std::string json_of(const std::vector<std::pair<std::string, T>> &members)
    {
      std::string text;
      for (const auto &[name, value] : members)
        text += (text.empty() ? "" : ", ") + json_of(name) + ": " + json_of(value);
      return "{" + text + "}";
    }
  } // namespace

  void JsonObject::add(const std::string &name, const double value)
  {
    members_.emplace_back(name, json_of(value));
  }
  void JsonObject::add(const std::string &name, const unsigned long value)
  {
    members_.emplace_back(name, std::to_string(value));
  }
  void JsonObject::add(const std::string &name, const std::string &value)
  {
    members_.emplace_back(name, json_of(value));
  }

  void JsonObject::add(const std::string &name, const std::vector<std::string> &values)
  {
    std::string text;
    for (const std::string &value : values)
      text += (text.empty() ? "" : ", ") + json_of(value);
    members_.emplace_back(name, "[" + text + "]");
  }

  void JsonObject::add(const std::string &name, const std::vector<std::pair<std::string, double>> &members)
  {
    members_.emplace_back(name, json_of(members));
  }

  void JsonObject::add(const std::string &name, const std::vector<std::pair<std::string, std::string>> &members)
  {
    members_.emplace_back(name, json_of(members));
  }

  std::string JsonObject::text() const
  {
    std::string text;
    for (const auto &[name, json] : members_)
      text += (text.empty() ? "  " : ",\n  ") + json_of(name) + ": " + json;
    return "{\n" + text + "\n}\n";
  }
} // namespace Breakwater
