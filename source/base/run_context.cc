#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/base/run_context.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace Breakwater
{
  const char *phase_name(const Phase phase)
  {
    constexpr const char *names[n_phases] = {"solver", "remeshing", "smoothing", "coupling", "structure", "output"};
    return names[static_cast<unsigned int>(phase)];
  }

  CsvTable::CsvTable(const std::filesystem::path &file, const bool append, const unsigned int n_digits)
    : append_(append && std::filesystem::exists(file))
    , n_digits_(n_digits)
  {
    if (append_)
      {
        std::ifstream old(file);
        std::string   header;
        append_ = static_cast<bool>(std::getline(old, header));
        for (std::size_t begin = 0; append_ && begin <= header.size();)
          {
            const std::size_t end = std::min(header.find(',', begin), header.size());
            columns_.push_back(header.substr(begin, end - begin));
            begin = end + 1;
          }
      }
    stream_.open(file, append_ ? std::ios::app : std::ios::trunc);
    if (!stream_)
      throw InputError("can't write " + file.string());
  }

  void CsvTable::add_row(const Row &row)
  {
    std::string line;
    if (columns_.empty())
      {
        for (const auto &[name, value] : row)
          {
            columns_.push_back(name);
            line += (line.empty() ? "" : ",") + name;
          }
        line += '\n';
      }
    const auto same = [](const std::pair<std::string, double> &number, const std::string &column) {
      return number.first == column;
    };
    if (row.size() != columns_.size() || !std::equal(row.begin(), row.end(), columns_.begin(), same))
      throw InputError("the columns of a table changed during the run, or are not those of the run that is resumed");

    for (std::size_t i = 0; i < row.size(); ++i)
      {
        char number[32];
        std::snprintf(number, sizeof(number), "%.*g", static_cast<int>(n_digits_), row[i].second);
        line += (i == 0 ? "" : ",") + std::string(number);
      }
    stream_ << line << '\n' << std::flush;
  }

  RunContext::RunContext(std::filesystem::path output_directory, const bool resumed)
    : output_directory_(std::move(output_directory))
    , resumed_(resumed)
  {
  }

  RunContext::~RunContext() = default;

  CsvTable &RunContext::table(const std::string &name)
  {
    std::unique_ptr<CsvTable> &table = tables_[name];
    if (table == nullptr)
      table = std::make_unique<CsvTable>(output_directory_ / (name + ".csv"), resumed_, n_digits);
    return *table;
  }

  void RunContext::note_effect(const std::string &effect, const bool active, const std::string &reason)
  {
    const std::string         text = active || reason.empty() ? effect : effect + " (" + reason + ")";
    std::vector<std::string> &list = active ? effects_active_ : effects_skipped_;
    if (std::find(list.begin(), list.end(), text) == list.end())
      list.push_back(text);
  }

  void RunContext::set_summary_max(const std::string &name, const double value)
  {
    const auto inserted = summary_.emplace(name, value);
    if (!inserted.second)
      inserted.first->second = std::max(inserted.first->second, value);
  }

  void RunContext::save(std::ostream &stream) const
  {
    write_binary(stream, cell_steps);
    write_binary(stream, steps);
    write_binary(stream, n_remeshes);
    write_binary(stream, cpu_seconds_);
    write_binary(stream, static_cast<std::uint64_t>(summary_.size()));
    for (const auto &[name, value] : summary_)
      {
        write_binary(stream, name);
        write_binary(stream, value);
      }
  }

  void RunContext::load(std::istream &stream)
  {
    read_binary(stream, cell_steps);
    read_binary(stream, steps);
    read_binary(stream, n_remeshes);
    read_binary(stream, cpu_seconds_);
    std::uint64_t n_numbers = 0;
    read_binary(stream, n_numbers);
    for (std::uint64_t i = 0; i < n_numbers; ++i)
      {
        std::string name;
        read_binary(stream, name);
        read_binary(stream, summary_[name]);
      }
  }

  double cpu_time()
  {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  PhaseTimer::PhaseTimer(RunContext &context, const Phase phase)
    : context_(context)
    , phase_(phase)
    , outer_(context.running_)
    , start_(cpu_time())
  {
    context_.running_ = this;
  }

  PhaseTimer::~PhaseTimer()
  {
    const double total = cpu_time() - start_;
    context_.cpu_seconds_[static_cast<unsigned int>(phase_)] += total - inner_seconds_;
    if (outer_ != nullptr)
      outer_->inner_seconds_ += total;
    context_.running_ = outer_;
  }

  double PhaseTimer::seconds() const
  {
    return cpu_time() - start_ - inner_seconds_;
  }
} // namespace Breakwater
