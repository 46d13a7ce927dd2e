#include "walls.h"

#include <algorithm>

namespace Breakwater
{
  template <int dim>
  void Walls<dim>::declare_parameters(ParameterReader &reader)
  {
    SectionScope scope(reader, "Walls");
    for (const std::string &title : reader.section_titles())
      if (std::none_of(boxes_.begin(), boxes_.end(), [&](const Box &box) {
            return box.name == title;
          }))
        boxes_.push_back({title, "", "free slip"});
    for (Box &box : boxes_)
      {
        SectionScope box_scope(reader, box.name);
        reader.add("Shape", box.shape,
                   "The wall: `box(x, y, z; X, Y, Z)` [m] holds the fluid on all sides, `open box(...)` leaves the "
                   "side of the largest y open. In 2D, two coordinates each.");
        reader.add("Law", box.law, "How the fluid moves along the wall.", {"free slip", "no slip"});
      }
  }


  template <int dim>
  void Walls<dim>::check_parameters(ParameterReader &reader)
  {
    planes_.clear();
    extent_ = {};
    SectionScope scope(reader, "Walls");
    for (const Box &box : boxes_)
      {
        SectionScope        box_scope(reader, box.name);
        const BoxShape<dim> shape = parse_box<dim>(box.shape, reader, "Shape", {"box", "open box"});
        if (extent_.kind.empty())
          extent_ = {"box", shape.lower, shape.upper};
        for (int d = 0; d < dim; ++d)
          {
            extent_.lower[d] = std::min(extent_.lower[d], shape.lower[d]);
            extent_.upper[d] = std::max(extent_.upper[d], shape.upper[d]);
            planes_.push_back({box.name, d, 1., shape.lower[d], box.law == "no slip"});
            if (!(shape.kind == "open box" && d == 1))
              planes_.push_back({box.name, d, -1., shape.upper[d], box.law == "no slip"});
          }
      }
    if (planes_.size() > 8 * sizeof(Contacts))
      throw InputError("The walls of the fluid have " + std::to_string(planes_.size()) + " faces; at most " +
                       std::to_string(8 * sizeof(Contacts)) + " are possible.");
  }


  template <int dim>
  typename Walls<dim>::Contacts Walls<dim>::planes_at(const Vec<dim> &x, const double tolerance) const
  {
    Contacts contacts = 0;
    for (std::size_t w = 0; w < planes_.size(); ++w)
      if (std::abs(x[planes_[w].direction] - planes_[w].place) <= tolerance)
        contacts |= Contacts(1) << w;
    return contacts;
  }


  template <int dim>
  void Walls<dim>::stop(double *x, double *v, Contacts &contacts) const
  {
    for (std::size_t w = 0; w < planes_.size(); ++w)
      {
        const Plane &plane = planes_[w];
        const int    d     = plane.direction;
        if (plane.sign * (x[d] - plane.place) >= 0)
          continue;
        x[d] = plane.place;
        if (plane.no_slip)
          std::fill_n(v, dim, 0.);
        else if (plane.sign * v[d] < 0)
          v[d] = 0;
        contacts |= Contacts(1) << w;
      }
  }


  template <int dim>
  void Walls<dim>::constrain(double *acceleration, double *v, Contacts &contacts) const
  {
    if (contacts == 0)
      return;
    bool sticks = false;
    for (std::size_t w = 0; w < planes_.size(); ++w)
      if (contacts & (Contacts(1) << w))
        {
          const Plane &plane = planes_[w];
          const int    d     = plane.direction;
          if (plane.sign * acceleration[d] > 0)
            {
              contacts &= ~(Contacts(1) << w);
              continue;
            }
          acceleration[d] = 0;
          v[d]            = 0;
          sticks          = sticks || plane.no_slip;
        }
    if (sticks)
      {
        std::fill_n(acceleration, dim, 0.);
        std::fill_n(v, dim, 0.);
      }
  }


  template <int dim>
  void Walls<dim>::mask(double *vector, const Contacts contacts) const
  {
    for (std::size_t w = 0; w < planes_.size(); ++w)
      if (contacts & (Contacts(1) << w))
        {
          vector[planes_[w].direction] = 0;
          if (planes_[w].no_slip)
            std::fill_n(vector, dim, 0.);
        }
  }

  template class Walls<2>;
  template class Walls<3>;
} // namespace Breakwater
