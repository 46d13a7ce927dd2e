#pragma once

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace Breakwater
{
  /// Numbers and arrays of them in the bits of this machine, for checkpoints: what is read has the bits that were
  /// written. Reading throws InputError where the stream ends too soon.
  template <class T>
  void write_binary(std::ostream &stream, const T &value)
  {
    static_assert(std::is_trivially_copyable<T>::value, "write the members one by one");
    stream.write(reinterpret_cast<const char *>(&value), sizeof(T));
  }

  template <class T>
  void write_binary(std::ostream &stream, const std::vector<T> &values)
  {
    static_assert(std::is_trivially_copyable<T>::value, "write the elements one by one");
    write_binary(stream, static_cast<std::uint64_t>(values.size()));
    stream.write(reinterpret_cast<const char *>(values.data()),
                 static_cast<std::streamsize>(sizeof(T) * values.size()));
  }

  inline void write_binary(std::ostream &stream, const std::string &text)
  {
    write_binary(stream, std::vector<char>(text.begin(), text.end()));
  }

  inline void check_binary(const std::istream &stream)
  {
    if (!stream)
      throw InputError("the checkpoint ends too soon: it was not written to its end, or by another version");
  }

  template <class T>
  void read_binary(std::istream &stream, T &value)
  {
    static_assert(std::is_trivially_copyable<T>::value, "read the members one by one");
    stream.read(reinterpret_cast<char *>(&value), sizeof(T));
    check_binary(stream);
  }

  template <class T>
  void read_binary(std::istream &stream, std::vector<T> &values)
  {
    static_assert(std::is_trivially_copyable<T>::value, "read the elements one by one");
    std::uint64_t size = 0;
    read_binary(stream, size);
    values.clear();
    // In pieces: a wrong size must not ask for more memory than the stream can fill.
    constexpr std::uint64_t piece = 1 << 20;
    for (std::uint64_t n_read = 0; n_read < size;)
      {
        const std::uint64_t n = std::min(piece, size - n_read);
        values.resize(n_read + n);
        stream.read(reinterpret_cast<char *>(values.data() + n_read), static_cast<std::streamsize>(sizeof(T) * n));
        check_binary(stream);
        n_read += n;
      }
  }

  inline void read_binary(std::istream &stream, std::string &text)
  {
    std::vector<char> letters;
    read_binary(stream, letters);
    text.assign(letters.begin(), letters.end());
  }
} // namespace Breakwater
