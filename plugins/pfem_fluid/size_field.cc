#include "size_field.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/expression.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    /// Points of the grid: 0.1 to 1 s to sample, 1 % of the box's size apart in 3D.
    constexpr double n_points = 1e6;
  } // namespace


  template <int dim>
  SizeField<dim>::SizeField(const double spacing)
    : smallest_(spacing)
    , largest_(spacing)
  {
  }


  template <int dim>
  SizeField<dim>::SizeField(const std::string &text, const Vec<dim> &lower, const Vec<dim> &upper)
  {
    char *end = nullptr;
    smallest_ = largest_ = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && *end == '\0')
      {
        if (!(smallest_ > 0 && std::isfinite(smallest_)))
          throw InputError("the spacing must be a positive number [m]");
        return;
      }

    const Expression<dim> expression(text, 1, Expression<dim>::Variables::place);
    make_grid(lower, upper);
    std::size_t p = 0;
    for (unsigned int k = 0; k < n_[2]; ++k)
      for (unsigned int j = 0; j < n_[1]; ++j)
        for (unsigned int i = 0; i < n_[0]; ++i, ++p)
          {
            const unsigned int index[3] = {i, j, k};
            Vec<dim>           x        = lower_;
            for (int d = 0; d < dim; ++d)
              x[d] += index[d] * step_[d];
            samples_[p] = expression.value(x, 0);
            if (!(samples_[p] > 0 && std::isfinite(samples_[p])))
              {
                std::ostringstream message;
                message << "the spacing must be positive everywhere; it is " << samples_[p] << " m at (";
                for (int d = 0; d < dim; ++d)
                  message << (d == 0 ? "" : ", ") << x[d];
                throw InputError(message.str() + ") m");
              }
          }

    const auto [smallest, largest] = std::minmax_element(samples_.begin(), samples_.end());
    smallest_                      = *smallest;
    largest_                       = *largest;
    if (smallest_ == largest_)
      samples_.clear();
    else
      grade();
  }


  template <int dim>
  void SizeField<dim>::make_grid(const Vec<dim> &lower, const Vec<dim> &upper)
  {
    double volume = 1;
    for (int d = 0; d < dim; ++d)
      volume *= upper[d] - lower[d];
    const double step = std::pow(volume / n_points, 1. / dim);
    lower_            = lower;
    std::size_t n     = 1;
    for (int d = 0; d < dim; ++d)
      {
        n_[d]    = static_cast<unsigned int>(std::ceil((upper[d] - lower[d]) / step)) + 1;
        step_[d] = (upper[d] - lower[d]) / (n_[d] - 1);
        n *= n_[d];
      }
    samples_.resize(n);
  }


  template <int dim>
  void SizeField<dim>::grade()
  {
    // Sweeps through the grid in all directions, each point against its neighbours on the side that the sweep comes
    // from, diagonals included: the distance through the grid is then at most 8 % (2D) too long. Repeated until
    // nothing changes, which a path with a turn needs.
    struct Neighbour
    {
      int    offset[3] = {};
      double rise      = 0;
    };
    std::vector<Neighbour> neighbours;
    for (int k = dim == 3 ? -1 : 0; k <= (dim == 3 ? 1 : 0); ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          if (i != 0 || j != 0 || k != 0)
            {
              Neighbour neighbour{{i, j, k}, 0};
              Vec<dim>  distance;
              for (int d = 0; d < dim; ++d)
                distance[d] = neighbour.offset[d] * step_[d];
              neighbour.rise = largest_gradient * norm(distance);
              neighbours.push_back(neighbour);
            }
    const long n[3] = {n_[0], n_[1], n_[2]};

    const auto lower_by_neighbours = [&](const long i, const long j, const long k) {
      double &sample = samples_[(k * n[1] + j) * n[0] + i];
      double  least  = sample;
      for (const Neighbour &neighbour : neighbours)
        {
          const long a = i + neighbour.offset[0], b = j + neighbour.offset[1], c = k + neighbour.offset[2];
          if (a >= 0 && a < n[0] && b >= 0 && b < n[1] && c >= 0 && c < n[2])
            least = std::min(least, samples_[(c * n[1] + b) * n[0] + a] + neighbour.rise);
        }
      const bool is_too_large = least < sample * (1 - 1e-9);
      sample                  = least;
      return is_too_large;
    };

    bool has_changed = true;
    while (has_changed)
      {
        has_changed = false;
        for (const bool forwards : {true, false})
          {
            const long n_all = n[0] * n[1] * n[2];
            for (long q = 0; q < n_all; ++q)
              {
                const long p = forwards ? q : n_all - 1 - q;
                has_changed |= lower_by_neighbours(p % n[0], p / n[0] % n[1], p / (n[0] * n[1]));
              }
          }
        was_graded_ |= has_changed;
      }
    largest_ = *std::max_element(samples_.begin(), samples_.end());
  }


  template <int dim>
  double SizeField<dim>::interpolate(const Vec<dim> &x) const
  {
    std::size_t first = 0, stride[dim] = {};
    double      part[dim] = {};
    std::size_t all       = 1;
    for (int d = 0; d < dim; ++d)
      {
        const double place = std::clamp((x[d] - lower_[d]) / step_[d], 0., n_[d] - 1.);
        const auto   index = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(n_[d] - 2));
        part[d]            = place - index;
        stride[d]          = all;
        first += index * all;
        all *= n_[d];
      }
    double result = 0;
    for (int corner = 0; corner < 1 << dim; ++corner)
      {
        double      weight = 1;
        std::size_t p      = first;
        for (int d = 0; d < dim; ++d)
          {
            const bool is_upper = corner >> d & 1;
            weight *= is_upper ? part[d] : 1 - part[d];
            p += is_upper ? stride[d] : 0;
          }
        result += weight * samples_[p];
      }
    return result;
  }

  template class SizeField<2>;
  template class SizeField<3>;
} // namespace Breakwater
