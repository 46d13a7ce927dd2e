#include "tait.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// base^exponent for n <= block_size numbers by multiplication, in loops that the compiler vectorises.
    constexpr std::size_t block_size = 64;

    void integer_power(const double *base, unsigned int exponent, double *power, const std::size_t n)
    {
      double square[block_size];
      std::copy_n(base, n, square);
      std::fill_n(power, n, 1.);
      while (true)
        {
          if (exponent & 1u)
            for (std::size_t i = 0; i < n; ++i)
              power[i] *= square[i];
          exponent >>= 1u;
          if (exponent == 0)
            return;
          for (std::size_t i = 0; i < n; ++i)
            square[i] *= square[i];
        }
    }
  } // namespace


  void Tait::declare_parameters(ParameterReader &reader)
  {
    reader.add("Reference density", reference_density_, "Density at the reference pressure, rho0 [kg/m^3]",
               Range::positive());
    reader.add("Gamma", gamma_, "Exponent gamma; 7 for water", {1., 100.});
    reader.add("Reference pressure", reference_pressure_, "Pressure at the reference density, p0 [Pa]");
    reader.add("Bulk modulus", bulk_modulus_, "K [Pa]; 0: follows from the sound speed", Range::not_negative());
    reader.add("Sound speed", sound_speed_,
               "c0 = sqrt(gamma K / rho0) at the reference density [m/s]; 0: follows from the bulk modulus. "
               "Usual choice: 10 to 20 times the largest velocity",
               Range::not_negative());
  }


  // K = rho0 c0^2 / gamma;  A = K - p0,  rho_z = rho0 (1 - p0 / K)^(1 / gamma)
  void Tait::check_parameters(ParameterReader &reader)
  {
    if (bulk_modulus_ > 0 && sound_speed_ > 0)
      reader.fail("Bulk modulus", "give either \"Bulk modulus\" or \"Sound speed\", not both: "
                                  "one follows from the other, c0 = sqrt(gamma K / rho0)");
    if (!(bulk_modulus_ > 0) && !(sound_speed_ > 0))
      reader.fail("Sound speed", "the fluid's stiffness is missing: give \"Sound speed\" [m/s] "
                                 "(usually 10 to 20 times the largest velocity) or \"Bulk modulus\" [Pa]");
    const double bulk_modulus =
      bulk_modulus_ > 0 ? bulk_modulus_ : reference_density_ * sound_speed_ * sound_speed_ / gamma_;
    modulus_ = bulk_modulus - reference_pressure_;
    if (!(modulus_ > 0))
      reader.fail("Reference pressure", "must be below the bulk modulus, " + std::to_string(bulk_modulus) +
                                          " Pa: the liquid would have a pressure at any density");
    zero_density_ = reference_density_ * std::pow(modulus_ / bulk_modulus, 1 / gamma_);
  }


  // p = A [(rho / rho_z)^gamma - 1]
  void Tait::pressure(const double *density, double *pressure, const std::size_t n) const
  {
    const double inverse_density = 1 / zero_density_;
    if (gamma_ == std::floor(gamma_))
      {
        const unsigned int exponent = static_cast<unsigned int>(gamma_);
        double             ratio[block_size], power[block_size];
        for (std::size_t begin = 0; begin < n; begin += block_size)
          {
            const std::size_t size = std::min(block_size, n - begin);
            for (std::size_t i = 0; i < size; ++i)
              ratio[i] = density[begin + i] * inverse_density;
            integer_power(ratio, exponent, power, size);
            for (std::size_t i = 0; i < size; ++i)
              pressure[begin + i] = modulus_ * (power[i] - 1);
          }
      }
    else
      for (std::size_t i = 0; i < n; ++i)
        pressure[i] = modulus_ * (std::pow(density[i] * inverse_density, gamma_) - 1);
  }


  // rho = rho_z (1 + p / A)^(1 / gamma)
  double Tait::density(const double pressure) const
  {
    return zero_density_ * std::pow(1 + pressure / modulus_, 1 / gamma_);
  }


  // c = sqrt(gamma A / rho_z (rho / rho_z)^(gamma - 1))
  double Tait::sound_speed(const double density) const
  {
    return std::sqrt(gamma_ * modulus_ / zero_density_ * std::pow(density / zero_density_, gamma_ - 1));
  }


  // e = A / rho_z [(r^(gamma - 1) - 1) / (gamma - 1) + 1 / r - 1],  r = rho / rho_z = exp(l): written with expm1, as
  // the leading terms l cancel and e is only about c^2 l^2 / 2
  double Tait::specific_energy(const double density) const
  {
    const double l     = std::log1p((density - zero_density_) / zero_density_);
    const double first = gamma_ > 1 ? std::expm1((gamma_ - 1) * l) / (gamma_ - 1) : l;
    return modulus_ / zero_density_ * (first + std::expm1(-l));
  }
} // namespace Breakwater
