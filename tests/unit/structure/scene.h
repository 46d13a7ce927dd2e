#pragma once

#include <breakwater/base/parameter_file.h>
#include <breakwater/base/plugin_library.h>
#include <breakwater/structure/structure.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace Breakwater
{
  /// The same acceleration everywhere.
  template <int dim>
  class UniformAcceleration : public BodyForce<dim>
  {
  public:
    explicit UniformAcceleration(const Vec<dim> &acceleration)
      : acceleration_(acceleration)
    {
    }

    void add_acceleration(double, const std::vector<Vec<dim>> &, std::vector<Vec<dim>> &acceleration) const override
    {
      for (Vec<dim> &a : acceleration)
        a += acceleration_;
    }
    double potential(const Vec<dim> &position) const override { return -dot(acceleration_, position); }
    bool   is_uniform() const override { return true; }

  private:
    Vec<dim> acceleration_;
  };

  /// A folder that is removed with all that is in it.
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      std::string name = (std::filesystem::temp_directory_path() / "breakwater-XXXXXX").string();
      path_            = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
  };

  /// A structure made from the text of its section, with the real library of materials.
  template <int dim>
  class Scene
  {
  public:
    explicit Scene(const std::string &parameters, const bool set_up = true, const Vec<dim> &acceleration = {})
      : context(folder_.path())
    {
      PluginLibraries libraries({BREAKWATER_TEST_PLUGIN_FOLDER});
      libraries.load("materials", registry_);
      structure = make_structure<dim>();
      std::istringstream stream(parameters);
      read_parameters(*structure, registry_, scan_parameters(stream, "test.prm"));
      if (dot(acceleration, acceleration) > 0)
        body_forces_.push_back(std::make_unique<UniformAcceleration<dim>>(acceleration));
      if (set_up)
        structure->setup("Beam", body_forces_, context);
    }

    void step(const double time_step)
    {
      structure->advance_free(time_step);
      structure->end_step();
    }

    /// Steps of equal length up to `duration` [s], each followed by a call observe(time). The length follows the
    /// stable step at the beginning. @return the number of steps
    template <class Observer>
    unsigned int run(const double duration, const Observer &observe)
    {
      const unsigned int n_steps = std::ceil(duration / structure->stable_time_step());
      for (unsigned int n = 1; n <= n_steps; ++n)
        {
          step(duration / n_steps);
          observe(n * duration / n_steps);
        }
      return n_steps;
    }

    unsigned int run(const double duration)
    {
      return run(duration, [](double) {});
    }

  private:
    TemporaryFolder folder_;
    PluginRegistry  registry_;
    BodyForces<dim> body_forces_;

  public:
    RunContext                           context;
    std::unique_ptr<ExplicitDomain<dim>> structure;
  };

  /// The section "Material" of a parameter file.
  inline std::string material_section(const std::string &model, const double density, const double youngs_modulus,
                                      const double poissons_ratio)
  {
    std::ostringstream text;
    text << "subsection Material\n  set Model = " << model << "\n  subsection " << model
         << "\n    set Density = " << density << "\n    set Young's modulus = " << youngs_modulus
         << "\n    set Poisson's ratio = " << poissons_ratio << "\n  end\nend\n";
    return text.str();
  }
} // namespace Breakwater
