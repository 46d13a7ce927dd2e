#include "mass_exchange.h"

#include "kernels.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    template <int dim>
    class MassExchange
    {
    public:
      using Cells = std::vector<typename SimplexMesh<dim>::Cell>;

      MassExchange(FluidNodes<dim> &nodes, const Cells &cells, const NodePairs<dim> &pairs,
                   const double reference_density, const double spacing, const ExchangeControl &control)
        : nodes_(nodes)
        , cells_(cells)
        , pairs_(pairs)
        , control_(control)
        , least_mass_(0.05 * reference_density * regular_volume<dim>(spacing))
        , least_volume_(0.1 * regular_volume<dim>(spacing))
        , takes_part_(nodes.n)
        , volume_(nodes.n)
        , excess_(nodes.n)
        , psi_(nodes.n)
        , direction_(nodes.n)
        , image_(nodes.n)
      {
      }

      ExchangeReport run(const std::vector<double> &potential, const double allowed_work)
      {
        for (std::size_t i = 0; i < nodes_.n; ++i)
          {
            const bool takes_part = nodes_.exchanges_mass(i);
            takes_part_[i]        = takes_part ? 1. : 0.;
            volume_[i]            = takes_part ? std::max(nodes_.volume[i], least_volume_) : 0.;
            excess_[i]            = takes_part ? nodes_.mass[i] - nodes_.density[i] * nodes_.volume[i] : 0.;
          }
        residual_                   = excess_;
        unsigned int   n_iterations = solve(1. / control_.reach);
        ExchangeReport report;
        if (n_iterations == 0)
          return report;
        if (control_.far_reach > control_.reach)
          {
            const std::vector<double> near      = psi_;
            const double              near_work = work(1. / control_.reach, potential);
            for (std::size_t i = 0; i < nodes_.n; ++i)
              residual_[i] += volume_[i] * (1. / control_.reach - 1. / control_.far_reach) * psi_[i];
            n_iterations += solve(1. / control_.far_reach);
            const double far_work = work(1. / control_.far_reach, potential) - near_work;
            const double part     = std::abs(far_work) > allowed_work ? allowed_work / std::abs(far_work) : 1.;
            for (std::size_t i = 0; i < nodes_.n; ++i)
              psi_[i] = near[i] + part * (psi_[i] - near[i]);
            report.far_part = part;
          }
        carry_out();
        report.n_iterations = n_iterations;
        return report;
      }

    private:
      /// (L + V decay) psi = m - rho V by conjugate gradients with its diagonal, from psi and its residual.
      unsigned int solve(const double decay)
      {
        const std::size_t   n = nodes_.n;
        std::vector<double> diagonal(n), inverse(n);
        double              square = 0, product = 0, square_mass = 0;
        for (std::size_t i = 0; i < n; ++i)
          {
            diagonal[i]   = pairs_.conductance_sums()[i] + volume_[i] * decay;
            inverse[i]    = diagonal[i] > 0 ? 1. / diagonal[i] : 0.;
            direction_[i] = inverse[i] * residual_[i];
            product += residual_[i] * direction_[i];
            square += residual_[i] * residual_[i];
            square_mass += takes_part_[i] * nodes_.mass[i] * nodes_.mass[i];
          }
        const double enough = control_.tolerance * control_.tolerance * square_mass;
        unsigned int k      = 0;
        for (; k < control_.n_iterations && square > enough; ++k)
          {
            const double step = product / pairs_.exchange(diagonal, direction_, image_);
            double       next = 0;
            square            = 0;
            for (std::size_t i = 0; i < n; ++i)
              {
                psi_[i] += step * direction_[i];
                residual_[i] -= step * image_[i];
                square += residual_[i] * residual_[i];
                next += residual_[i] * inverse[i] * residual_[i];
              }
            for (std::size_t i = 0; i < n; ++i)
              direction_[i] = inverse[i] * residual_[i] + next / product * direction_[i];
            product = next;
          }
        return k;
      }

      /// Change of potential energy by the fluxes L psi [J].
      double work(const double decay, const std::vector<double> &potential) const
      {
        double sum = 0;
        for (std::size_t i = 0; i < nodes_.n; ++i)
          sum -= (excess_[i] - residual_[i] - volume_[i] * decay * psi_[i]) * potential[i];
        return sum;
      }

      /// The fluxes between the corners of each cell, once, with their momentum.
      void carry_out()
      {
        std::vector<double> part(nodes_.n, 0.), turnover(nodes_.n, 0.);
        std::vector<double> cell_weight(cells_.size());
        std::vector<Quad>   request(cells_.size()), received(nodes_.n);
        const auto         &passes = element_passes<dim>();
        passes.cell_volumes(cells_.front().data(), cells_.size(), nodes_.xp.data(), cell_weight.data());
        for (double &weight : cell_weight)
          weight = std::abs(weight) / (2 * (dim + 1));
        passes.exchange_requests(cells_.front().data(), cells_.size(), cell_weight.data(), psi_.data(),
                                 takes_part_.data(), request.data(), part.data(), turnover.data());
        for (std::size_t i = 0; i < nodes_.n; ++i)
          {
            const double allowed = std::max(0., 0.5 * (nodes_.mass[i] - least_mass_));
            turnover[i]          = nodes_.mass[i] > 0 ? (part[i] + turnover[i]) / nodes_.mass[i] : 0.;
            part[i]              = part[i] > allowed ? allowed / part[i] : 1.;
            nodes_.v[i][3]       = 1;
          }
        passes.exchange_transfers(cells_.front().data(), cells_.size(), request.data(), part.data(), turnover.data(),
                                  nodes_.v.data(), received.data());
        for (std::size_t i = 0; i < nodes_.n; ++i)
          {
            nodes_.v[i][3] = 0;
            if (!(takes_part_[i] > 0))
              continue;
            const double new_mass = nodes_.mass[i] + received[i][3];
            for (int d = 0; d < dim; ++d)
              nodes_.v[i][d] = (nodes_.mass[i] * nodes_.v[i][d] + received[i][d]) / new_mass;
            nodes_.mass[i] = new_mass;
          }
      }

      FluidNodes<dim>      &nodes_;
      const Cells          &cells_;
      const NodePairs<dim> &pairs_;
      const ExchangeControl control_;
      const double          least_mass_;   ///< that a donor keeps [kg]
      const double          least_volume_; ///< in the operator [m^dim]
      std::vector<double>   takes_part_, volume_, excess_, psi_, residual_, direction_, image_;
    };
  } // namespace


  template <int dim>
  ExchangeReport exchange_mass(FluidNodes<dim> &nodes, const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                               const NodePairs<dim> &pairs, const std::vector<double> &potential,
                               const double allowed_work, const double reference_density, const double spacing,
                               const ExchangeControl &control)
  {
    if (cells.empty() || control.n_iterations == 0)
      return {};
    return MassExchange<dim>(nodes, cells, pairs, reference_density, spacing, control).run(potential, allowed_work);
  }

  template ExchangeReport exchange_mass<2>(FluidNodes<2> &, const std::vector<SimplexMesh<2>::Cell> &,
                                           const NodePairs<2> &, const std::vector<double> &, double, double, double,
                                           const ExchangeControl &);
  template ExchangeReport exchange_mass<3>(FluidNodes<3> &, const std::vector<SimplexMesh<3>::Cell> &,
                                           const NodePairs<3> &, const std::vector<double> &, double, double, double,
                                           const ExchangeControl &);
} // namespace Breakwater
