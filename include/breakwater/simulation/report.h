#pragma once

#include <breakwater/simulation/json_object.h>

#include <filesystem>
#include <string>

namespace Breakwater
{
  /// A page about a run that needs no other file: what summary.json says as a table, and curves of what history.csv and
  /// remeshing.csv hold. Columns of one quantity (components, energies, bounds on the time step) share a picture;
  /// columns that never change are only named.
  /// @param directory where the two tables stand; a missing or empty one is left out
  /// @return HTML
  std::string report_html(const std::string &title, const JsonObject &summary, const std::filesystem::path &directory);
} // namespace Breakwater
