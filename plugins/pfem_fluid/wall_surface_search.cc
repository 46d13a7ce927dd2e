#include "nearest_place.h"
#include "wall_surface.h"

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// Relative distance by which a piece counts as larger than it is, so that no path slips between two.
    constexpr double seam = 1e-9;

    /// True if a place in the plane of a piece is in it.
    template <int dim>
    bool contains(const std::array<Vec<dim>, dim> &piece, const Vec<dim> &place)
    {
      const Vec<dim> e1 = piece[1] - piece[0], r = place - piece[0];
      const double   g11 = dot(e1, e1), r1 = dot(r, e1);
      if constexpr (dim == 2)
        return r1 >= -seam * g11 && r1 <= (1 + seam) * g11;
      else
        {
          const Vec<3> e2  = piece[2] - piece[0];
          const double g12 = dot(e1, e2), g22 = dot(e2, e2), r2 = dot(r, e2), det = g11 * g22 - g12 * g12;
          const double w1 = (g22 * r1 - g12 * r2) / det, w2 = (g11 * r2 - g12 * r1) / det;
          return w1 >= -seam && w2 >= -seam && w1 + w2 <= 1 + seam;
        }
    }
  } // namespace


  template <int dim>
  std::vector<Vec<dim>> WallSurface<dim>::bounding_box() const
  {
    std::vector<Vec<dim>> corners(1 << dim, lower_);
    for (unsigned int k = 0; k < corners.size(); ++k)
      for (int d = 0; d < dim; ++d)
        if (k & (1u << d))
          corners[k][d] = upper_[d];
    return corners;
  }


  template <int dim>
  std::vector<Vec<dim>> WallSurface<dim>::places_on_edges(const double distance) const
  {
    std::vector<Vec<dim>> places;
    for (const auto &edge : edges_)
      {
        const Vec<dim> along = edge.back() - edge.front();
        const int      n     = std::max(1, static_cast<int>(std::ceil(norm(along) / distance)));
        for (int k = 0; k <= (dim == 2 ? 0 : n); ++k)
          places.push_back(edge.front() + along * (static_cast<double>(k) / n));
      }
    return places;
  }


  template <int dim>
  std::vector<Vec<dim>> WallSurface<dim>::places_on_patch(const unsigned int patch, const double distance) const
  {
    std::vector<Vec<dim>> places;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if (patch_[p] == patch)
        {
          const Piece   &x  = pieces_[p];
          const Vec<dim> e1 = x[1] - x[0], e2 = x[dim - 1] - x[0];
          const double   longest = std::max({norm(e1), norm(e2), norm(x[dim - 1] - x[1])});
          const int      n       = std::max(1, static_cast<int>(std::ceil(longest / distance)));
          for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= (dim == 2 ? 0 : n - i); ++j)
              places.push_back(x[0] + e1 * (static_cast<double>(i) / n) + e2 * (static_cast<double>(j) / n));
        }
    return places;
  }


  template <int dim>
  template <class Visitor>
  bool WallSurface<dim>::visit_near(const Vec<dim> &lower, const Vec<dim> &upper, const Visitor &visit) const
  {
    int first[3] = {}, last[3] = {};
    for (int d = 0; d < dim; ++d)
      {
        if (!(lower[d] <= upper_[d] && upper[d] >= lower_[d]))
          return true;
        first[d] = std::max(0, static_cast<int>((lower[d] - lower_[d]) / box_size_[d]));
        last[d] =
          std::min(n_boxes_[d] - 1, static_cast<int>((std::min(upper[d], upper_[d]) - lower_[d]) / box_size_[d]));
      }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i)
          {
            const int box = (k * n_boxes_[1] + j) * n_boxes_[0] + i;
            for (unsigned int n = box_start_[box]; n < box_start_[box + 1]; ++n)
              if (!visit(box_pieces_[n]))
                return false;
          }
    return true;
  }


  template <int dim>
  bool WallSurface<dim>::may_reach(const Vec<dim> &a, const Vec<dim> &b, const double reach) const
  {
    Vec<dim> lower, upper;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(a[d], b[d]) - reach;
        upper[d] = std::max(a[d], b[d]) + reach;
      }
    return !visit_near(lower, upper, [](const unsigned int) {
      return false;
    });
  }


  template <int dim>
  bool WallSurface<dim>::nearest(const Vec<dim> &x, const double reach, const unsigned int patch, Foot &foot) const
  {
    // Most places that are asked about lie close to the surface.
    return nearest_within(x, 0.1 * reach, patch, foot) || nearest_within(x, reach, patch, foot);
  }


  template <int dim>
  bool WallSurface<dim>::nearest_within(const Vec<dim> &x, const double reach, const unsigned int patch,
                                        Foot &foot) const
  {
    Vec<dim> lower = x, upper = x;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] -= reach;
        upper[d] += reach;
      }
    bool found    = false;
    foot.distance = reach;
    visit_near(lower, upper, [&](const unsigned int p) {
      if (patch != n_patches() && patch_[p] != patch)
        return true;
      const double least = std::abs(dot(normal_[p], x - pieces_[p][0]));
      if (least > foot.distance || (found && least == foot.distance))
        return true;
      double   weights[dim];
      Vec<dim> place;
      nearest_weights<dim>(pieces_[p].data(), x, weights);
      for (int k = 0; k < dim; ++k)
        place += pieces_[p][k] * weights[k];
      const double distance = norm(x - place);
      if (distance < foot.distance || (!found && distance <= reach))
        {
          found = true;
          foot  = {distance, place, normal_[p], patch_[p]};
        }
      return true;
    });
    return found;
  }


  template <int dim>
  std::vector<unsigned int> WallSurface<dim>::patches_near(const Vec<dim> &x, const double reach) const
  {
    std::vector<unsigned int> patches;
    Vec<dim>                  lower = x, upper = x;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] -= reach;
        upper[d] += reach;
      }
    visit_near(lower, upper, [&](const unsigned int p) {
      if (std::find(patches.begin(), patches.end(), patch_[p]) == patches.end())
        patches.push_back(patch_[p]);
      return true;
    });
    Foot foot;
    patches.erase(std::remove_if(patches.begin(), patches.end(),
                                 [&](const unsigned int patch) {
                                   return !nearest(x, reach, patch, foot);
                                 }),
                  patches.end());
    std::sort(patches.begin(), patches.end());
    return patches;
  }


  template <int dim>
  bool WallSurface<dim>::first_crossing(const Vec<dim> &a, const Vec<dim> &b, Crossing &crossing) const
  {
    double   best = 2; // part of the path
    Vec<dim> lower, upper;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(a[d], b[d]);
        upper[d] = std::max(a[d], b[d]);
      }
    visit_near(lower, upper, [&](const unsigned int p) {
      const double s_a = dot(normal_[p], a - pieces_[p][0]), s_b = dot(normal_[p], b - pieces_[p][0]);
      const bool   leaves = s_a >= 0 && s_b < 0, comes = side_ == FluidSide::both && s_a < 0 && s_b >= 0;
      if (!leaves && !comes)
        return true;
      const double   t     = s_a / (s_a - s_b);
      const Vec<dim> place = a + t * (b - a);
      if (t < best && contains<dim>(pieces_[p], place))
        {
          best     = t;
          crossing = {place, leaves ? normal_[p] : -1. * normal_[p], patch_[p]};
        }
      return true;
    });
    return best <= 1;
  }


  template <int dim>
  bool WallSurface<dim>::separates(const Vec<dim> &a, const Vec<dim> &b) const
  {
    constexpr double grazing = 0.4; // sine of the angle
    constexpr double alike   = 0.5; // cosine of the angle between the normals where a chord enters and leaves
    Vec<dim>         lower, upper;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(a[d], b[d]);
        upper[d] = std::max(a[d], b[d]);
      }
    const double    allowed = side_ == FluidSide::both ? 0. : grazing * norm(b - a);
    const Vec<dim> *grazed  = nullptr;
    return !visit_near(lower, upper, [&](const unsigned int p) {
      const double s_a = dot(normal_[p], a - pieces_[p][0]), s_b = dot(normal_[p], b - pieces_[p][0]);
      if ((s_a >= 0) == (s_b >= 0) || !contains<dim>(pieces_[p], a + (s_a / (s_a - s_b)) * (b - a)))
        return true;
      if (std::abs(s_a - s_b) > allowed || (grazed != nullptr && dot(*grazed, normal_[p]) < alike))
        return false;
      grazed = &normal_[p];
      return true;
    });
  }

#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template std::vector<Vec<dim>>     WallSurface<dim>::bounding_box() const;                                           \
  template std::vector<Vec<dim>>     WallSurface<dim>::places_on_edges(double) const;                                  \
  template std::vector<Vec<dim>>     WallSurface<dim>::places_on_patch(unsigned int, double) const;                    \
  template bool                      WallSurface<dim>::nearest(const Vec<dim> &, double, unsigned int, Foot &) const;  \
  template std::vector<unsigned int> WallSurface<dim>::patches_near(const Vec<dim> &, double) const;                   \
  template bool WallSurface<dim>::first_crossing(const Vec<dim> &, const Vec<dim> &, Crossing &) const;                \
  template bool WallSurface<dim>::separates(const Vec<dim> &, const Vec<dim> &) const;                                 \
  template bool WallSurface<dim>::may_reach(const Vec<dim> &, const Vec<dim> &, double) const;
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
