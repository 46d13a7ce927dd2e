#include "lattice.h"

#include <cmath>
#include <random>

namespace Breakwater
{
  template <int dim>
  std::vector<Vec<dim>> fill_box(const BoxShape<dim> &box, const Lattice &lattice, const double spacing)
  {
    const double side = lattice.body_centred ? std::pow(2., 1. / dim) * spacing : spacing;
    unsigned int n[3] = {1, 1, 0};
    Vec<dim>     step;
    for (int d = 0; d < dim; ++d)
      {
        const double length = box.upper[d] - box.lower[d];
        n[d]                = std::max(1l, std::lround(length / side));
        step[d]             = length / n[d];
      }

    // The engine's own integers are the same everywhere; the distributions of the standard library are not.
    std::mt19937 random(lattice.seed);
    const auto   jitter = [&]() {
      return lattice.jitter * spacing * (2. * random() / std::mt19937::max() - 1.);
    };

    std::vector<Vec<dim>> nodes;
    for (const double offset : {0., 0.5})
      {
        if (offset > 0 && !lattice.body_centred)
          break;
        for (unsigned int k = 0; k <= n[2]; ++k)
          for (unsigned int j = 0; j <= n[1]; ++j)
            for (unsigned int i = 0; i <= n[0]; ++i)
              {
                const unsigned int index[3] = {i, j, k};
                bool               inside   = true;
                Vec<dim>           x;
                for (int d = 0; d < dim; ++d)
                  {
                    inside = inside && index[d] + offset <= n[d];
                    x[d]   = box.lower[d] + (index[d] + offset) * step[d];
                    if (index[d] + offset == n[d])
                      x[d] = box.upper[d];
                    else if (index[d] + offset > 0)
                      x[d] += jitter();
                  }
                if (inside)
                  nodes.push_back(x);
              }
      }
    return nodes;
  }

  template std::vector<Vec<2>> fill_box<2>(const BoxShape<2> &, const Lattice &, double);
  template std::vector<Vec<3>> fill_box<3>(const BoxShape<3> &, const Lattice &, double);
} // namespace Breakwater
