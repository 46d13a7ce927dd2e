#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace Breakwater
{
  /// A few faces of walls, those that hold a node or that it lies on: at most four, in increasing order.
  class Contacts
  {
  public:
    using Face                    = std::uint16_t;
    static constexpr Face n_faces = 0xffff; ///< faces are numbered below this

    bool empty() const { return faces_.front() == n_faces; }
    bool has(const Face face) const { return std::find(faces_.begin(), faces_.end(), face) != faces_.end(); }

    /// True if all faces are below `end`.
    bool are_below(const Face end) const
    {
      return std::all_of(faces_.begin(), faces_.end(), [end](const Face face) {
        return face < end || face == n_faces;
      });
    }

    /// A fifth face is left out: more than dim meet at a place only where walls coincide.
    void add(const Face face)
    {
      if (has(face) || faces_.back() != n_faces)
        return;
      faces_.back() = face;
      std::sort(faces_.begin(), faces_.end());
    }

    void remove(const Face face)
    {
      std::replace(faces_.begin(), faces_.end(), face, n_faces);
      std::sort(faces_.begin(), faces_.end());
    }

    const Face *begin() const { return faces_.data(); }
    const Face *end() const { return std::find(faces_.data(), faces_.data() + faces_.size(), n_faces); }

    /// The faces that both have.
    friend Contacts common(const Contacts &a, const Contacts &b)
    {
      Contacts result;
      if (!b.empty())
        for (const Face face : a)
          if (b.has(face))
            result.add(face);
      return result;
    }

    friend bool operator==(const Contacts &a, const Contacts &b) { return a.faces_ == b.faces_; }
    friend bool operator!=(const Contacts &a, const Contacts &b) { return !(a == b); }

  private:
    std::array<Face, 4> faces_ = {n_faces, n_faces, n_faces, n_faces};
  };
} // namespace Breakwater
