#include "power_law.h"

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


  PowerLaw PowerLaw::through(const double density, const double pressure, const double modulus, const double gamma)
  {
    return {modulus, density * std::pow(modulus / (modulus + pressure), 1 / gamma), gamma};
  }


  // p = A [(rho / rho_z)^gamma - 1]
  void PowerLaw::pressure_of(const double *density, double *pressure, const std::size_t n) const
  {
    const double inverse_density = 1 / zero_density;
    if (gamma == std::floor(gamma))
      {
        const unsigned int exponent = static_cast<unsigned int>(gamma);
        double             ratio[block_size], power[block_size];
        for (std::size_t begin = 0; begin < n; begin += block_size)
          {
            const std::size_t size = std::min(block_size, n - begin);
            for (std::size_t i = 0; i < size; ++i)
              ratio[i] = density[begin + i] * inverse_density;
            integer_power(ratio, exponent, power, size);
            for (std::size_t i = 0; i < size; ++i)
              pressure[begin + i] = modulus * (power[i] - 1);
          }
      }
    else
      for (std::size_t i = 0; i < n; ++i)
        pressure[i] = modulus * (std::pow(density[i] * inverse_density, gamma) - 1);
  }


  // rho = rho_z (1 + p / A)^(1 / gamma)
  double PowerLaw::density_at(const double pressure) const
  {
    return zero_density * std::pow(1 + pressure / modulus, 1 / gamma);
  }


  // c = sqrt(gamma A / rho_z (rho / rho_z)^(gamma - 1))
  double PowerLaw::sound_speed_at(const double density) const
  {
    return std::sqrt(gamma * modulus / zero_density * std::pow(density / zero_density, gamma - 1));
  }


  // e = A / rho_z [(r^(gamma - 1) - 1) / (gamma - 1) + 1 / r - 1],  r = rho / rho_z = exp(l): written with expm1, as
  // the leading terms l cancel and e is only about c^2 l^2 / 2
  double PowerLaw::specific_energy_at(const double density) const
  {
    const double l     = std::log1p((density - zero_density) / zero_density);
    const double first = gamma > 1 ? std::expm1((gamma - 1) * l) / (gamma - 1) : l;
    return modulus / zero_density * (first + std::expm1(-l));
  }
} // namespace Breakwater
