#include <breakwater/simulation/report.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

namespace Breakwater
{
  namespace
  {
    namespace fs = std::filesystem;

    struct Column
    {
      std::string         name;
      std::vector<double> values;
    };

    /// Columns of one quantity, drawn over the first column of their table.
    struct Chart
    {
      std::string                 title;
      std::vector<const Column *> curves;
      bool                        is_logarithmic = false;
    };

    constexpr double width = 460, height = 230, left = 64, right = 10, top = 10, bottom = 24;

    /// The chosen colours differ in brightness, too.
    const char *const colours[] = {"#0b5394", "#e07b00", "#38761d", "#a61c3c",
                                   "#674ea7", "#7f6000", "#45818e", "#999999"};

    std::vector<Column> read_table(const fs::path &file)
    {
      std::ifstream       stream(file);
      std::vector<Column> columns;
      std::string         line, word;
      if (!std::getline(stream, line))
        return columns;
      for (std::istringstream names(line); std::getline(names, word, ',');)
        columns.push_back({word, {}});
      while (std::getline(stream, line))
        {
          std::istringstream row(line);
          for (Column &column : columns)
            column.values.push_back(std::getline(row, word, ',') ? std::strtod(word.c_str(), nullptr) : std::nan(""));
        }
      return columns;
    }

    bool ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    bool is_constant(const Column &column)
    {
      return std::all_of(column.values.begin(), column.values.end(), [&column](const double value) {
        return value == column.values.front();
      });
    }

    /// Columns of one title share a chart.
    std::string chart_title(const std::string &name)
    {
      for (const char *shared : {"energy [J]", "energy change [J]", "bound [s]", "[CPU s]"})
        if (ends_with(name, shared))
          return shared;
      const std::size_t unit = name.rfind(" [");
      if (unit == std::string::npos || unit < 2 || name[unit - 2] != ' ' || name[unit - 1] < 'x' ||
          name[unit - 1] > 'z')
        return name;
      return name.substr(0, unit - 2) + name.substr(unit);
    }

    std::vector<Chart> charts_of(const std::vector<Column> &columns, std::string &constants)
    {
      std::vector<Chart> charts;
      for (std::size_t i = 1; i < columns.size(); ++i)
        {
          if (is_constant(columns[i]))
            {
              constants += (constants.empty() ? "" : ", ") + columns[i].name;
              continue;
            }
          const std::string title = chart_title(columns[i].name);
          auto              chart = std::find_if(charts.begin(), charts.end(), [&title](const Chart &c) {
            return c.title == title;
          });
          if (chart == charts.end())
            chart = charts.insert(charts.end(), {title, {}, title == "bound [s]"});
          chart->curves.push_back(&columns[i]);
        }
      return charts;
    }

    std::string escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
      return result;
    }

    std::string number(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.4g", value);
      return text;
    }

    struct Range
    {
      double lower = INFINITY, upper = -INFINITY;

      void add(const double value)
      {
        if (std::isfinite(value))
          {
            lower = std::min(lower, value);
            upper = std::max(upper, value);
          }
      }
      double part(const double value) const { return upper > lower ? (value - lower) / (upper - lower) : 0.5; }
    };

    /// Points of a curve in the chart; of many points, the lowest and the highest of each of 400 bins.
    std::string points(const std::vector<double> &x, const std::vector<double> &y, const Range &x_range,
                       const Range &y_range)
    {
      const std::size_t n_bins = 400, per_bin = std::max<std::size_t>(1, x.size() / n_bins);
      std::string       text;
      const auto        add = [&](const std::size_t i) {
        if (std::isfinite(x[i]) && std::isfinite(y[i]))
          text += number(left + x_range.part(x[i]) * (width - left - right)) + "," +
                  number(height - bottom - y_range.part(y[i]) * (height - top - bottom)) + " ";
      };
      for (std::size_t first = 0; first < x.size(); first += per_bin)
        {
          const auto begin = y.begin() + first, end = y.begin() + std::min(x.size(), first + per_bin);
          const auto [low, high]  = std::minmax_element(begin, end);
          const auto [next, last] = std::minmax(low, high);
          add(next - y.begin());
          if (last != next)
            add(last - y.begin());
        }
      return text;
    }

    std::string svg_text(const double x, const double y, const char *anchor, const std::string &text)
    {
      return "<text x='" + number(x) + "' y='" + number(y) + "' text-anchor='" + anchor + "'>" + escaped(text) +
             "</text>";
    }

    std::string svg(const Chart &chart, const Column &abscissa)
    {
      Range                            x_range, y_range;
      std::vector<std::vector<double>> values;
      for (const Column *curve : chart.curves)
        {
          values.push_back(curve->values);
          if (chart.is_logarithmic)
            for (double &value : values.back())
              value = std::log10(value); // not finite where there is none: left out
          for (const double value : values.back())
            y_range.add(value);
        }
      for (const double x : abscissa.values)
        x_range.add(x);
      const auto label = [&chart](const double value) {
        return number(chart.is_logarithmic ? std::pow(10., value) : value);
      };

      std::string text = "<figure><svg viewBox='0 0 " + number(width) + " " + number(height) + "'>";
      text += "<rect x='" + number(left) + "' y='" + number(top) + "' width='" + number(width - left - right) +
              "' height='" + number(height - top - bottom) + "'/>";
      for (std::size_t i = 0; i < values.size(); ++i)
        text += "<polyline stroke='" + std::string(colours[i % std::size(colours)]) + "' points='" +
                points(abscissa.values, values[i], x_range, y_range) + "'/>";
      text += svg_text(left - 4, top + 8, "end", label(y_range.upper));
      text += svg_text(left - 4, height - bottom, "end", label(y_range.lower));
      text += svg_text(left, height - 8, "start", number(x_range.lower));
      text += svg_text(width - right, height - 8, "end", number(x_range.upper));
      text += svg_text((left + width - right) / 2, height - 8, "middle", abscissa.name);
      text += "</svg><figcaption>";
      for (std::size_t i = 0; i < chart.curves.size(); ++i)
        text += "<span style='color:" + std::string(colours[i % std::size(colours)]) + "'>" +
                escaped(chart.curves[i]->name) + "</span> ";
      return text + "</figcaption></figure>\n";
    }

    std::string section(const std::string &heading, const fs::path &file)
    {
      const std::vector<Column> columns = read_table(file);
      if (columns.empty() || columns.front().values.size() < 2)
        return "";
      std::string constants, text = "<h2>" + heading + "</h2>\n";
      for (const Chart &chart : charts_of(columns, constants))
        text += svg(chart, columns.front());
      return text + (constants.empty() ? "" : "<p>Never changed: " + escaped(constants) + ".</p>\n");
    }

    const char *const style = "body{font:14px/1.4 sans-serif;margin:2em auto;max-width:1460px;padding:0 1em}"
                              "td{padding:1px 1em 1px 0;vertical-align:top;overflow-wrap:anywhere}"
                              "td:first-child{white-space:nowrap}"
                              "figure{display:inline-block;vertical-align:top;width:460px;margin:0 8px 12px 0}"
                              "svg{display:block;width:460px;height:230px}rect{fill:none;stroke:#ccc}"
                              "polyline{fill:none;stroke-width:1.3}text{font-size:11px;fill:#444}"
                              "figcaption{font-size:12px;text-align:center}figcaption span{margin-right:.8em}";
  } // namespace


  std::string report_html(const std::string &title, const JsonObject &summary, const fs::path &directory)
  {
    const std::string name = title.empty() ? "A run of Breakwater" : escaped(title);
    std::string       text = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>" + name +
                       "</title><style>" + style + "</style></head><body>\n<h1>" + name + "</h1>\n<table>\n";
    for (const auto &[key, value] : summary.members())
      text += "<tr><td>" + escaped(key) + "</td><td>" + escaped(value) + "</td></tr>\n";
    text +=
      "</table>\n" + section("History", directory / "history.csv") + section("Remeshes", directory / "remeshing.csv");
    return text + "</body></html>\n";
  }
} // namespace Breakwater
