#include "wall_surface.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/area_vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

// How a surface is made of its pieces; what can be asked of it: wall_surface_search.cc.

namespace Breakwater
{
  namespace
  {
    /// Volume between a piece and the origin, signed [m^dim].
    template <int dim>
    double cone_volume(const std::array<Vec<dim>, dim> &piece)
    {
      return dot(area_vector<dim>(piece), piece[0]) / dim;
    }

    /// Part of all directions that a piece covers as seen from x, signed.
    /// 3D: van Oosterom and Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30 (1983).
    template <int dim>
    double covered_directions(const std::array<Vec<dim>, dim> &piece, const Vec<dim> &x)
    {
      const Vec<dim> a = piece[0] - x, b = piece[1] - x;
      if constexpr (dim == 2)
        return std::atan2(a[0] * b[1] - a[1] * b[0], dot(a, b)) / (2 * M_PI);
      else
        {
          const Vec<3> c  = piece[2] - x;
          const double la = norm(a), lb = norm(b), lc = norm(c);
          return std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) /
                 (2 * M_PI);
        }
    }

    /// The group that i belongs to; every group has one root.
    unsigned int root_of(std::vector<unsigned int> &parent, unsigned int i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }
  } // namespace


  /// Which pieces meet at which ridges: at corners in 2D, at edges in 3D.
  template <int dim>
  struct WallSurface<dim>::Topology
  {
    using Ridge = std::array<unsigned int, dim - 1>; ///< numbers of its corners, increasing
    struct Use
    {
      unsigned int piece;
      bool         is_forward; ///< direction in which the piece goes round it
    };
    std::map<Ridge, std::vector<Use>> uses;
    std::vector<Vec<dim>>             corners; ///< by number

    explicit Topology(const std::vector<Piece> &pieces)
    {
      std::map<std::array<double, dim>, unsigned int> numbers;
      for (unsigned int p = 0; p < pieces.size(); ++p)
        {
          unsigned int corner[dim];
          for (int k = 0; k < dim; ++k)
            {
              std::array<double, dim> key;
              std::copy_n(pieces[p][k].c, dim, key.begin());
              corner[k] = numbers.emplace(key, numbers.size()).first->second;
              if (corner[k] == corners.size())
                corners.push_back(pieces[p][k]);
            }
          for (int k = 0; k < dim; ++k)
            if constexpr (dim == 2)
              uses[{corner[k]}].push_back({p, k == 0});
            else
              {
                const unsigned int a = corner[k], b = corner[(k + 1) % 3];
                uses[{std::min(a, b), std::max(a, b)}].push_back({p, a < b});
              }
        }
    }
  };


  template <int dim>
  WallSurface<dim>::WallSurface(const std::vector<Piece> &pieces, const FluidSide side)
    : side_(side)
  {
    double longest = 0;
    for (const Piece &piece : pieces)
      longest = std::max(longest, norm(piece[1] - piece[0]));
    for (const Piece &piece : pieces)
      if (norm(area_vector<dim>(piece)) > 1e-12 * std::pow(longest, dim - 1))
        pieces_.push_back(piece);
    if (pieces_.empty())
      throw InputError("the surface has no pieces");

    Topology topology(pieces_);
    if (side_ != FluidSide::both)
      for (const auto &[ridge, uses] : topology.uses)
        if (uses.size() != 2)
          {
            const Vec<dim> &x = pieces_[uses.front().piece][0];
            std::string     place;
            for (int d = 0; d < dim; ++d)
              place += (d == 0 ? "(" : ", ") + std::to_string(x[d]);
            throw InputError("the surface is not closed: near " + place + ") m an edge has " +
                             std::to_string(uses.size()) +
                             " pieces instead of two, so there is no inside. Set Fluid side = both, or close it");
          }
    orient(topology);
    normal_.clear();
    for (const Piece &piece : pieces_)
      normal_.push_back(area_vector<dim>(piece) * (1 / norm(area_vector<dim>(piece))));
    join_patches(topology);
    make_grid();
  }


  template <int dim>
  void WallSurface<dim>::orient(Topology &topology)
  {
    // Neighbours go round their common ridge in opposite directions.
    std::vector<std::vector<std::pair<unsigned int, bool>>> neighbors(pieces_.size()); // piece, same direction
    for (const auto &[ridge, uses] : topology.uses)
      if (uses.size() == 2)
        {
          const bool same = uses[0].is_forward == uses[1].is_forward;
          neighbors[uses[0].piece].push_back({uses[1].piece, same});
          neighbors[uses[1].piece].push_back({uses[0].piece, same});
        }
    std::vector<std::vector<unsigned int>> components;
    std::vector<char>                      is_flipped(pieces_.size(), 2); // 2: not known yet
    for (unsigned int first = 0; first < pieces_.size(); ++first)
      if (is_flipped[first] == 2)
        {
          is_flipped[first] = 0;
          components.push_back({first});
          for (std::size_t k = 0; k < components.back().size(); ++k)
            for (const auto &[other, same] : neighbors[components.back()[k]])
              if (is_flipped[other] == 2)
                {
                  is_flipped[other] = is_flipped[components.back()[k]] != same;
                  components.back().push_back(other);
                }
        }
    const auto flip = [&](const unsigned int p) {
      std::swap(pieces_[p][0], pieces_[p][1]);
    };
    for (unsigned int p = 0; p < pieces_.size(); ++p)
      if (is_flipped[p])
        flip(p);
    if (side_ == FluidSide::both)
      return;

    // Normals out of what a component encloses, into it if it is a hole in another one; and then into the fluid.
    for (const auto &component : components)
      {
        double volume = 0;
        for (const unsigned int p : component)
          volume += cone_volume<dim>(pieces_[p]);
        unsigned int n_around = 0;
        for (const auto &other : components)
          n_around += &other != &component && std::abs(winding(pieces_[component.front()][0], other)) > 0.5;
        const bool is_inwards = (volume < 0) != (n_around % 2 == 1);
        if (is_inwards != (side_ == FluidSide::inside))
          std::for_each(component.begin(), component.end(), flip);
      }
  }


  template <int dim>
  double WallSurface<dim>::winding(const Vec<dim> &x, const std::vector<unsigned int> &pieces) const
  {
    double sum = 0;
    for (const unsigned int p : pieces)
      sum += covered_directions<dim>(pieces_[p], x);
    return sum;
  }


  template <int dim>
  bool WallSurface<dim>::is_in_solid(const Vec<dim> &x) const
  {
    if (side_ == FluidSide::both)
      return false;
    std::vector<unsigned int> all(pieces_.size());
    std::iota(all.begin(), all.end(), 0u);
    return (std::abs(winding(x, all)) > 0.5) != (side_ == FluidSide::inside);
  }


  template <int dim>
  void WallSurface<dim>::join_patches(const Topology &topology)
  {
    static const double       cosine = std::cos(M_PI / 6);
    std::vector<unsigned int> parent(pieces_.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (const auto &[ridge, uses] : topology.uses)
      if (uses.size() == 2 && dot(normal_[uses[0].piece], normal_[uses[1].piece]) > cosine)
        parent[root_of(parent, uses[0].piece)] = root_of(parent, uses[1].piece);

    std::map<unsigned int, unsigned int> number; // of a patch by its root
    patch_.resize(pieces_.size());
    for (unsigned int p = 0; p < pieces_.size(); ++p)
      {
        patch_[p] = number.emplace(root_of(parent, p), number.size()).first->second;
        if (patch_[p] == first_piece_.size())
          {
            first_piece_.push_back(p);
            is_flat_.push_back(true);
          }
        if (norm(normal_[p] - normal_[first_piece_[patch_[p]]]) > 1e-6)
          is_flat_[patch_[p]] = false;
      }
    for (const auto &[ridge, uses] : topology.uses)
      if (uses.size() == 2 && patch_[uses[0].piece] != patch_[uses[1].piece])
        {
          edges_.emplace_back();
          for (std::size_t k = 0; k < ridge.size(); ++k)
            edges_.back()[k] = topology.corners[ridge[k]];
        }
  }


  template <int dim>
  void WallSurface<dim>::make_grid()
  {
    lower_ = upper_ = pieces_[0][0];
    for (const Piece &piece : pieces_)
      for (const Vec<dim> &x : piece)
        for (int d = 0; d < dim; ++d)
          {
            lower_[d] = std::min(lower_[d], x[d]);
            upper_[d] = std::max(upper_[d], x[d]);
          }
    double longest = 0;
    for (int d = 0; d < dim; ++d)
      longest = std::max(longest, upper_[d] - lower_[d]);
    const double size =
      longest / std::clamp(2 * std::pow(static_cast<double>(pieces_.size()), 1. / (dim - 1)), 32., 128.);
    Vec<dim> half;
    for (int d = 0; d < dim; ++d)
      {
        lower_[d] -= 1e-6 * longest;
        upper_[d] += 1e-6 * longest;
        n_boxes_[d]  = std::max(1, static_cast<int>(std::ceil((upper_[d] - lower_[d]) / size)));
        box_size_[d] = (upper_[d] - lower_[d]) / n_boxes_[d];
        half[d]      = 0.5 * box_size_[d];
      }

    std::vector<std::vector<unsigned int>> boxes(n_boxes_[0] * n_boxes_[1] * n_boxes_[2]);
    for (unsigned int p = 0; p < pieces_.size(); ++p)
      {
        int first[3] = {}, last[3] = {};
        for (int d = 0; d < dim; ++d)
          {
            const auto [least, most] =
              std::minmax_element(pieces_[p].begin(), pieces_[p].end(), [d](const Vec<dim> &a, const Vec<dim> &b) {
                return a[d] < b[d];
              });
            const auto box = [&](const double x) {
              return std::clamp(static_cast<int>((x - lower_[d]) / box_size_[d]), 0, n_boxes_[d] - 1);
            };
            first[d] = box((*least)[d] - 1e-6 * longest);
            last[d]  = box((*most)[d] + 1e-6 * longest);
          }
        // Of the boxes around the piece, those that its plane goes through.
        double reach = 1e-6 * longest;
        for (int d = 0; d < dim; ++d)
          reach += std::abs(normal_[p][d]) * half[d];
        for (int k = first[2]; k <= last[2]; ++k)
          for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0]; i <= last[0]; ++i)
              {
                const int index[3] = {i, j, k};
                Vec<dim>  center;
                for (int d = 0; d < dim; ++d)
                  center[d] = lower_[d] + (index[d] + 0.5) * box_size_[d];
                if (std::abs(dot(normal_[p], center - pieces_[p][0])) <= reach)
                  boxes[(k * n_boxes_[1] + j) * n_boxes_[0] + i].push_back(p);
              }
      }
    box_start_ = {0};
    for (const auto &box : boxes)
      {
        box_pieces_.insert(box_pieces_.end(), box.begin(), box.end());
        box_start_.push_back(box_pieces_.size());
      }
  }


  template class WallSurface<2>;
  template class WallSurface<3>;
} // namespace Breakwater
