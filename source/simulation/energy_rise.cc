#include <breakwater/base/binary_stream.h>
#include <breakwater/simulation/energy_rise.h>

namespace Breakwater
{
  void EnergyRise::add(const double time, const double energy)
  {
    // A tolerance of round-off: samples at exactly the window's length apart belong together.
    while (!lows_.empty() && lows_.front().first < time - window_ * (1 + 1e-9))
      lows_.pop_front();
    while (!lows_.empty() && lows_.back().second >= energy)
      lows_.pop_back();
    lows_.emplace_back(time, energy);
    largest_ = std::max(largest_, energy - lows_.front().second);
  }

  void EnergyRise::save(std::ostream &stream) const
  {
    std::vector<double> numbers = {largest_};
    for (const auto &[time, energy] : lows_)
      numbers.insert(numbers.end(), {time, energy});
    write_binary(stream, numbers);
  }

  void EnergyRise::load(std::istream &stream)
  {
    std::vector<double> numbers;
    read_binary(stream, numbers);
    largest_ = numbers.at(0);
    lows_.clear();
    for (std::size_t i = 1; i + 1 < numbers.size(); i += 2)
      lows_.emplace_back(numbers[i], numbers[i + 1]);
  }
} // namespace Breakwater
