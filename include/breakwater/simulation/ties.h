#pragma once

#include <string>
#include <utility>
#include <vector>

namespace Breakwater
{
  /// Names of two bodies that are tied to each other.
  using TiedNames = std::pair<std::string, std::string>;

  /// Reads "Fluid and Gate" from each text. @throws InputError where one has another form
  std::vector<TiedNames> parse_ties(const std::vector<std::string> &texts);

  /// What the entry "Ties" says about the bodies of a scene, or what goes without saying: the fluid is tied to every
  /// structure; without a fluid, two structures are tied to each other.
  /// @param structures their names
  /// @throws InputError about names that no body has, bodies tied to themselves or twice, structures that nothing ties
  /// to the fluid, or if it does not go without saying
  std::vector<TiedNames> find_ties(const std::vector<std::string> &texts, bool has_fluid,
                                   const std::vector<std::string> &structures);

  /// Stops because two tied bodies share no node. @param ties_place where the scene says that they are tied
  /// @throws InputError
  [[noreturn]] void fail_without_common_node(const std::string &ties_place, const std::string &first,
                                             const std::string &second);

  /// The fluid's name in ties and output.
  inline constexpr const char *fluid_name = "Fluid";
} // namespace Breakwater
