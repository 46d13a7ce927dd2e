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

  void JsonObject::add_member(const std::string &name, const std::string &json)
  {
    members_ += (members_.empty() ? "  " : ",\n  ") + json_of(name) + ": " + json;
  }

  void JsonObject::add(const std::string &name, const double value)
  {
    add_member(name, json_of(value));
  }
  void JsonObject::add(const std::string &name, const unsigned long value)
  {
    add_member(name, std::to_string(value));
  }
  void JsonObject::add(const std::string &name, const std::string &value)
  {
    add_member(name, json_of(value));
  }

  void JsonObject::add(const std::string &name, const std::vector<std::string> &values)
  {
    std::string text;
    for (const std::string &value : values)
      text += (text.empty() ? "" : ", ") + json_of(value);
    add_member(name, "[" + text + "]");
  }

  void JsonObject::add(const std::string &name, const std::vector<std::pair<std::string, double>> &members)
  {
    add_member(name, json_of(members));
  }

  void JsonObject::add(const std::string &name, const std::vector<std::pair<std::string, std::string>> &members)
  {
    add_member(name, json_of(members));
  }

  std::string JsonObject::text() const
  {
    return "{\n" + members_ + "\n}\n";
  }
} // namespace Breakwater
