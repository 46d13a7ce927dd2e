#pragma once

namespace Breakwater
{
  class ParameterReader;

  /// Whatever a parameter file can choose by name: the base of all plugin interfaces.
  ///
  /// Every interface has two constants, `interface_name` (the word of the manual, e.g. "equation of state") and
  /// `dimension` (2, 3, or 0 where the interface does not depend on it); the registry files its plugins under them.
  class Plugin
  {
  public:
    virtual ~Plugin() = default;

    /// Binds members to the entries of the current section. Called several times while a file is read (see
    /// read_parameters()): it must do nothing else.
    virtual void declare_parameters(ParameterReader &) {}

    /// Checks combinations of entries once all are read, and digests them; reports through ParameterReader::fail().
    virtual void check_parameters(ParameterReader &) {}
  };
} // namespace Breakwater
