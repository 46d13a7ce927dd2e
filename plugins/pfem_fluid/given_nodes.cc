#include "given_nodes.h"

#include "gmsh_mesh.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace Breakwater
{
  template <int dim>
  MeshRegion<dim>::MeshRegion(const std::string &file)
  {
    const GmshMesh mesh = read_gmsh(file);
    if constexpr (dim == 2)
      cells_ = mesh.triangles;
    else
      cells_ = mesh.tetrahedra;
    if (cells_.empty())
      throw InputError("the mesh \"" + file + "\" has no " + (dim == 2 ? "triangles" : "tetrahedra"));

    // Nodes without cells are left out: centers of arcs and the like.
    constexpr unsigned int    unused = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> number(mesh.position.size(), unused);
    for (auto &cell : cells_)
      for (unsigned int &node : cell)
        {
          if (number[node] == unused)
            {
              number[node] = position_.size();
              Vec<dim> x;
              std::copy_n(mesh.position[node].c, dim, x.c);
              position_.push_back(x);
            }
          node = number[node];
        }
    make_grid();
  }


  template <int dim>
  void MeshRegion<dim>::make_grid()
  {
    extent_ = {"box", position_.front(), position_.front()};
    for (const Vec<dim> &x : position_)
      for (int d = 0; d < dim; ++d)
        {
          extent_.lower[d] = std::min(extent_.lower[d], x[d]);
          extent_.upper[d] = std::max(extent_.upper[d], x[d]);
        }
    std::size_t n_all = 1;
    for (int d = 0; d < dim; ++d)
      {
        n_grid_[d]    = std::max(1l, std::lround(std::pow(cells_.size(), 1. / dim)));
        grid_step_[d] = (extent_.upper[d] - extent_.lower[d]) / n_grid_[d];
        n_all *= n_grid_[d];
      }
    grid_.resize(n_all);
    for (std::size_t c = 0; c < cells_.size(); ++c)
      {
        std::array<long, 3> first = grid_cell(position_[cells_[c][0]]), last = first;
        for (const unsigned int i : cells_[c])
          {
            const auto place = grid_cell(position_[i]);
            for (int d = 0; d < dim; ++d)
              {
                first[d] = std::min(first[d], place[d]);
                last[d]  = std::max(last[d], place[d]);
              }
          }
        for (long k = first[2]; k <= last[2]; ++k)
          for (long j = first[1]; j <= last[1]; ++j)
            for (long i = first[0]; i <= last[0]; ++i)
              grid_[grid_index({{i, j, k}})].push_back(c);
      }
  }


  template <int dim>
  std::array<long, 3> MeshRegion<dim>::grid_cell(const Vec<dim> &x) const
  {
    std::array<long, 3> place{};
    for (int d = 0; d < dim; ++d)
      place[d] = std::clamp(static_cast<long>((x[d] - extent_.lower[d]) / grid_step_[d]), 0l, n_grid_[d] - 1);
    return place;
  }


  template <int dim>
  std::size_t MeshRegion<dim>::grid_index(const std::array<long, 3> &cell) const
  {
    return (cell[2] * n_grid_[1] + cell[1]) * n_grid_[0] + cell[0];
  }


  template <int dim>
  double MeshRegion<dim>::distance(const Vec<dim> &x) const
  {
    // Inside a cell, the cells that x makes with its facets have volumes of the same sign as the cell.
    for (const unsigned int c : grid_[grid_index(grid_cell(x))])
      {
        const Simplex<dim> corner = corners(position_, cells_[c]);
        const double       volume = signed_volume(corner);
        bool               inside = true;
        for (int a = 0; a <= dim && inside; ++a)
          {
            Simplex<dim> part = corner;
            part[a]           = x;
            inside            = signed_volume(part) * volume >= -1e-9 * volume * volume;
          }
        if (inside)
          return -std::numeric_limits<double>::infinity();
      }
    return std::numeric_limits<double>::infinity();
  }


  template <int dim>
  void MeshRegion<dim>::add_nodes(const SizeField<dim> &, const Lattice &, NodeCandidates<dim> &nodes) const
  {
    nodes.given.insert(nodes.given.end(), position_.begin(), position_.end());
  }


  template <int dim>
  double Spray<dim>::distance(const Vec<dim> &) const
  {
    return std::numeric_limits<double>::infinity();
  }


  template <int dim>
  void Spray<dim>::add_nodes(const SizeField<dim> &, const Lattice &lattice, NodeCandidates<dim> &nodes) const
  {
    // The finest lattice of points in the middle of equal parts of the box that has n of them or more; of these,
    // every one that keeps the numbers even, displaced by up to a quarter of the parts.
    double volume = 1;
    for (int d = 0; d < dim; ++d)
      volume *= box_.upper[d] - box_.lower[d];
    unsigned int n[3] = {1, 1, 1};
    for (double step = std::pow(volume / n_, 1. / dim); n[0] * n[1] * n[2] < n_; step *= 0.99)
      for (int d = 0; d < dim; ++d)
        n[d] = std::max(1., std::floor((box_.upper[d] - box_.lower[d]) / step));

    std::mt19937        random(lattice.seed);
    const unsigned long n_all = static_cast<unsigned long>(n[0]) * n[1] * n[2];
    for (unsigned long k = 0; k < n_; ++k)
      {
        const unsigned long place    = k * n_all / n_;
        const unsigned long index[3] = {place % n[0], place / n[0] % n[1], place / n[0] / n[1]};
        Vec<dim>            x;
        for (int d = 0; d < dim; ++d)
          {
            const double move = 0.25 * (2. * random() / std::mt19937::max() - 1.);
            x[d]              = box_.lower[d] + (index[d] + 0.5 + move) * (box_.upper[d] - box_.lower[d]) / n[d];
          }
        nodes.given.push_back(x);
      }
  }

  template class MeshRegion<2>;
  template class MeshRegion<3>;
  template class Spray<2>;
  template class Spray<3>;
} // namespace Breakwater
