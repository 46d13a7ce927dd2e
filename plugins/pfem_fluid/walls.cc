#include "walls.h"

#include "wall_shapes.h"

#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Parameters, motion, and what the walls tell of themselves; what they do to nodes and cells:
// wall_contact.cc, wall_cells.cc.

namespace Breakwater
{
  template <int dim>
  void Walls<dim>::declare_parameters(ParameterReader &reader)
  {
    SectionScope scope(reader, "Walls");
    for (const std::string &title : reader.section_titles())
      if (std::none_of(walls_.begin(), walls_.end(), [&](const Wall &wall) {
            return wall.name == title;
          }))
        {
          walls_.emplace_back();
          walls_.back().name = title;
        }
    for (Wall &wall : walls_)
      {
        SectionScope wall_scope(reader, wall.name);
        reader.add("Shape", wall.shape, wall_shape_documentation<dim>());
        reader.add("Fluid side", wall.side,
                   "Where the fluid may be: inside of a closed shape, outside of it, or on both sides of a thin wall.",
                   {"inside", "outside", "both"});
        reader.add(
          "Law", wall.law_text,
          "How the fluid moves along the wall. Navier slip: the traction along it is viscosity over slip length "
          "times the velocity along it.",
          {"free slip", "no slip", "navier slip"});
        reader.add("Slip length", wall.slip_length, "Length b of Navier slip [m].", Range::not_negative());
        reader.add("Reference point", wall.reference_point,
                   "Point that the wall's moments in history.csv refer to [m].");
        wall.motion.declare_parameters(reader);
      }
  }


  template <int dim>
  void Walls<dim>::check_parameters(ParameterReader &reader)
  {
    extent_ = {};
    faces_.clear();
    surfaces_.clear();
    SectionScope                scope(reader, "Walls");
    std::vector<Face>           planes;
    std::vector<WallShape<dim>> shapes;
    for (unsigned int w = 0; w < walls_.size(); ++w)
      {
        Wall        &wall = walls_[w];
        SectionScope wall_scope(reader, wall.name);
        wall.motion.check_parameters(reader);
        wall.is_moving = !wall.motion.is_static();
        wall.law       = wall.law_text == "no slip"     ? Law::no_slip :
                         wall.law_text == "navier slip" ? Law::navier_slip :
                                                          Law::free_slip;
        if ((wall.law == Law::navier_slip) != (wall.slip_length > 0))
          reader.fail("Slip length", wall.law == Law::navier_slip ? "Navier slip needs a length > 0" :
                                                                    "only a wall with Law = navier slip has one");
        wall.state     = State();
        wall.state.now = wall.state.before = wall.state.after = wall.state.at_remesh = wall.motion.pose(0.);
        const FluidSide side = wall.side == "both"    ? FluidSide::both :
                               wall.side == "outside" ? FluidSide::outside :
                                                        FluidSide::inside;
        shapes.push_back(parse_wall_shape<dim>(wall.shape, side, reader));
        for (const Vec<dim> &x : shapes.back().corners)
          {
            if (extent_.kind.empty())
              extent_ = {"box", x, x};
            for (int d = 0; d < dim; ++d)
              {
                extent_.lower[d] = std::min(extent_.lower[d], x[d]);
                extent_.upper[d] = std::max(extent_.upper[d], x[d]);
              }
          }
        for (const auto &plane : shapes.back().planes)
          planes.push_back({w, -1, 0, -1, 0., 0., plane.place, plane.normal});
        if (!shapes.back().pieces.empty())
          try
            {
              surfaces_.push_back({w, 0, WallSurface<dim>(shapes.back().pieces, side)});
            }
          catch (const InputError &error)
            {
              reader.fail("Shape", error.what());
            }
      }
    number_faces(planes);
  }


  template <int dim>
  void Walls<dim>::number_faces(const std::vector<Face> &planes)
  {
    const auto direction_of = [&](const Face &face) {
      for (int d = 0; d < dim; ++d)
        if (std::abs(face.normal[d]) == 1 && !walls_[face.wall].is_moving)
          return d;
      return -1;
    };
    for (const bool along_axes : {true, false})
      {
        for (Face face : planes)
          if ((direction_of(face) >= 0) == along_axes)
            {
              face.direction = direction_of(face);
              if (along_axes)
                {
                  face.sign  = face.normal[face.direction];
                  face.place = face.point[face.direction];
                }
              faces_.push_back(face);
            }
        (along_axes ? n_aligned_ : n_planes_) = faces_.size();
      }
    for (unsigned int s = 0; s < surfaces_.size(); ++s)
      {
        surfaces_[s].first_face = faces_.size();
        for (unsigned int patch = 0; patch < surfaces_[s].shape.n_patches(); ++patch)
          faces_.push_back({surfaces_[s].wall, static_cast<int>(s), patch, -1, 0., 0., {}, {}});
      }
    if (faces_.size() > Contacts::n_faces)
      throw InputError("The walls of the fluid have " + std::to_string(faces_.size()) +
                       " faces (planes, and parts of surfaces between sharp edges); at most " +
                       std::to_string(Contacts::n_faces) + " are possible.");
    find_room();
  }


  template <int dim>
  void Walls<dim>::find_room()
  {
    const double infinity = std::numeric_limits<double>::infinity();
    const bool   are_all  = n_aligned_ == faces_.size();
    for (int d = 0; d < dim; ++d)
      {
        lower_plane_[d] = are_all ? -infinity : infinity;
        upper_plane_[d] = -lower_plane_[d];
      }
    for (unsigned int f = 0; f < n_aligned_; ++f)
      {
        const Face &face = faces_[f];
        if (face.sign > 0)
          lower_plane_[face.direction] = std::max(lower_plane_[face.direction], face.place);
        else
          upper_plane_[face.direction] = std::min(upper_plane_[face.direction], face.place);
      }
  }


  template <int dim>
  bool Walls<dim>::any_moves() const
  {
    return std::any_of(walls_.begin(), walls_.end(), [](const Wall &wall) {
      return wall.is_moving;
    });
  }


  template <int dim>
  bool Walls<dim>::any_has_navier_slip() const
  {
    return std::any_of(walls_.begin(), walls_.end(), [](const Wall &wall) {
      return wall.law == Law::navier_slip;
    });
  }


  template <int dim>
  void Walls<dim>::move(const double time, const double step)
  {
    step_    = step;
    in_step_ = true;
    for (Wall &wall : walls_)
      if (wall.is_moving)
        {
          wall.state.before = wall.state.now;
          wall.state.now    = wall.motion.pose(time);
          wall.state.after  = wall.motion.pose(time + step);
        }
  }


  template <int dim>
  bool Walls<dim>::has_travelled(const double distance) const
  {
    for (const Surface &surface : surfaces_)
      if (walls_[surface.wall].is_moving)
        {
          const State &state = walls_[surface.wall].state;
          for (const Vec<dim> &x : surface.shape.bounding_box())
            if (norm(state.now.to_world(x) - state.at_remesh.to_world(x)) > distance)
              return true;
        }
    return false;
  }


  template <int dim>
  void Walls<dim>::note_remesh()
  {
    for (Wall &wall : walls_)
      wall.state.at_remesh = wall.state.now;
  }


  template <int dim>
  void Walls<dim>::Load::add(const Load &other, const double factor)
  {
    force += factor * other.force;
    moment += factor * other.moment;
    power += factor * other.power;
  }


  template <int dim>
  void Walls<dim>::begin_forces()
  {
    for (Wall &wall : walls_)
      wall.state.load = Load();
  }


  template <int dim>
  void Walls<dim>::act(const double duration)
  {
    for (Wall &wall : walls_)
      wall.state.total.add(wall.state.load, duration);
  }


  template <int dim>
  double Walls<dim>::work() const
  {
    double sum = 0;
    for (const Wall &wall : walls_)
      sum += wall.state.total.power;
    return sum;
  }


  template <int dim>
  void Walls<dim>::add_history(const double time, Row &row)
  {
    for (Wall &wall : walls_)
      {
        Load mean = wall.state.load;
        if (time > time_of_last_row_)
          {
            mean = Load();
            mean.add(wall.state.total, 1 / (time - time_of_last_row_));
            mean.add(wall.state.total_at_row, -1 / (time - time_of_last_row_));
          }
        wall.state.total_at_row = wall.state.total;
        for (int d = 0; d < dim; ++d)
          row.emplace_back("force on " + wall.name + " " + "xyz"[d] + " [N]", mean.force[d]);
        for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
          row.emplace_back("moment on " + wall.name + " " + "xyz"[d] + " [N m]", mean.moment[d]);
      }
    if (any_moves())
      row.emplace_back("work of walls [J]", work());
    time_of_last_row_ = time;
  }


  template <int dim>
  void Walls<dim>::save(std::ostream &stream) const
  {
    for (const Wall &wall : walls_)
      write_binary(stream, wall.state);
    write_binary(stream, step_);
    write_binary(stream, in_step_);
    write_binary(stream, time_of_last_row_);
  }


  template <int dim>
  void Walls<dim>::load(std::istream &stream)
  {
    for (Wall &wall : walls_)
      read_binary(stream, wall.state);
    read_binary(stream, step_);
    read_binary(stream, in_step_);
    read_binary(stream, time_of_last_row_);
  }

  template class Walls<2>;
  template class Walls<3>;
} // namespace Breakwater
