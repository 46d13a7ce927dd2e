#pragma once

#include <breakwater/base/vec.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// The spacing h(x) that the nodes of the fluid are meant to have at a place [m]: one number, or a function of
  /// place that is graded, |grad h| <= largest_gradient, so that neighbouring cells are of similar size.
  ///
  /// A function is sampled once on a grid over the scene, graded there by h(x) = min over y of
  /// h(y) + gradient |x - y| (Persson, Mesh size functions for implicit geometries and PDE-based gradient limiting,
  /// Engineering with Computers 22, 2006), and interpolated linearly in each coordinate. Outside of the grid it has
  /// the value of the nearest place of it.
  template <int dim>
  class SizeField
  {
  public:
    static constexpr double largest_gradient = 0.3;

    explicit SizeField(double spacing = 0.01); ///< [m], the same everywhere

    /// @param text a number [m], or an expression of x, y, z [m] in the syntax of muParser
    /// @param lower, upper corners of the box to sample [m]
    /// @throws InputError without the name of the entry, if the text is no expression or not positive somewhere
    SizeField(const std::string &text, const Vec<dim> &lower, const Vec<dim> &upper);

    /// Spacing at a place [m].
    double operator()(const Vec<dim> &x) const { return is_uniform() ? smallest_ : interpolate(x); }

    bool   is_uniform() const { return samples_.empty(); }
    double smallest() const { return smallest_; } ///< [m]
    double largest() const { return largest_; }   ///< [m]

    /// True if the function was steeper than largest_gradient somewhere and has been made smaller there.
    bool was_graded() const { return was_graded_; }

  private:
    double interpolate(const Vec<dim> &x) const;
    void   make_grid(const Vec<dim> &lower, const Vec<dim> &upper);
    void   grade();

    double              smallest_ = 0, largest_ = 0;
    bool                was_graded_ = false;
    Vec<dim>            lower_, step_; ///< of the grid [m]
    unsigned int        n_[3] = {1, 1, 1};
    std::vector<double> samples_; ///< at the grid's points, x fastest [m]
  };
} // namespace Breakwater
