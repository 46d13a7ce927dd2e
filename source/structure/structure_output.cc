#include "explicit_structure.h"

#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>

// What a structure tells of itself: balances, history, fields and checkpoints.

namespace Breakwater
{
  template <int dim>
  DomainBalance<dim> ExplicitStructure<dim>::balance() const
  {
    DomainBalance<dim> balance;
    for (std::size_t i = 0; i < mass_.size(); ++i)
      {
        balance.mass += mass_[i];
        balance.momentum += mass_[i] * velocity_[i];
        balance.kinetic_energy += 0.5 * mass_[i] * dot(velocity_[i], velocity_[i]);
        if (body_forces_act_)
          for (const auto &body_force : *body_forces_)
            balance.potential_energy += mass_[i] * body_force->potential(position_[i]);
      }
    balance.strain_energy = kernel_->strain_energy(displacement_);
    return balance;
  }


  template <int dim>
  void ExplicitStructure<dim>::add_history(Row &row)
  {
    const DomainBalance<dim> now = balance();
    row.emplace_back(name_ + " kinetic energy [J]", now.kinetic_energy);
    row.emplace_back(name_ + " potential energy [J]", now.potential_energy);
    row.emplace_back(name_ + " strain energy [J]", now.strain_energy);
    for (int d = 0; d < dim; ++d)
      row.emplace_back(name_ + " momentum " + "xyz"[d] + " [kg m/s]", now.momentum[d]);
    // Means since the last row, exact to round-off.
    const double factor = time_ > time_of_last_row_ ? 1 / (time_ - time_of_last_row_) : 0.;
    for (int d = 0; d < dim; ++d)
      row.emplace_back("force on " + name_ + " " + "xyz"[d] + " [N]", factor * load_.impulse[d]);
    for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
      row.emplace_back("moment on " + name_ + " " + "xyz"[d] + " [N m]", factor * load_.moment[d]);
    load_             = {};
    time_of_last_row_ = time_;
    row.emplace_back(name_ + " stable step [s]", stable_time_step());
  }


  /// Cells of degree 2 are split into 2^dim linear ones.
  template <int dim>
  OutputMesh<dim> ExplicitStructure<dim>::output_mesh() const
  {
    OutputMesh<dim> output;
    output.position          = position_;
    output.vertices_per_cell = 1u << dim;
    const unsigned int n     = degree_ + 1;
    for (unsigned int cell = 0; cell < mesh_.n_cells(); ++cell)
      for (unsigned int k = 0; k < (dim == 3 ? degree_ : 1); ++k)
        for (unsigned int j = 0; j < degree_; ++j)
          for (unsigned int i = 0; i < degree_; ++i)
            for (unsigned int vertex = 0; vertex < output.vertices_per_cell; ++vertex)
              {
                const unsigned int x = i + vertex % 2, y = j + vertex / 2 % 2, z = k + vertex / 4;
                output.cells.push_back(mesh_.cell_nodes[cell * mesh_.nodes_per_cell() + x + n * (y + n * z)]);
              }

    const auto flat = [](const std::vector<Vec<dim>> &vectors) {
      std::vector<double> values;
      values.reserve(vectors.size() * dim);
      for (const Vec<dim> &vector : vectors)
        values.insert(values.end(), vector.c, vector.c + dim);
      return values;
    };
    output.fields.push_back({"displacement", dim, flat(displacement_)});
    output.fields.push_back({"velocity", dim, flat(velocity_)});
    output.fields.push_back(
      {dim == 3 ? "von Mises stress" : "von Mises stress in the plane", 1, kernel_->von_mises_stress(displacement_)});
    return output;
  }


  template <int dim>
  template <class Structure, class Visitor>
  void ExplicitStructure<dim>::visit_state(Structure &structure, const Visitor &visit)
  {
    visit(structure.time_);
    visit(structure.largest_frequency_);
    visit(structure.smallest_volume_ratio_);
    visit(structure.displacement_);
    visit(structure.velocity_);
    visit(structure.acceleration_);
    visit(structure.link_force_);
    visit(structure.load_);
    visit(structure.time_of_last_row_);
    visit(structure.eigenvalues_.eigenvalue);
    visit(structure.eigenvalues_.direction);
    visit(structure.eigenvalues_.metric);
  }


  template <int dim>
  void ExplicitStructure<dim>::save(std::ostream &stream) const
  {
    visit_state(*this, [&stream](const auto &value) {
      write_binary(stream, value);
    });
  }


  template <int dim>
  void ExplicitStructure<dim>::load(std::istream &stream)
  {
    const std::size_t n_nodes = displacement_.size(), n_directions = eigenvalues_.direction.size();
    visit_state(*this, [&stream](auto &value) {
      read_binary(stream, value);
    });
    if (displacement_.size() != n_nodes || velocity_.size() != n_nodes || acceleration_.size() != n_nodes ||
        eigenvalues_.direction.size() != n_directions || link_force_.size() != wet_nodes_.size())
      throw InputError(name_ + ": the checkpoint holds another mesh: was the scene's mesh or its wet boundaries "
                               "changed since it was written?");
    for (std::size_t i = 0; i < position_.size(); ++i)
      position_[i] = mesh_.nodes[i] + displacement_[i];
    time_step_ = 0;
    update_wet_surface();
  }

  template class ExplicitStructure<2>;
  template class ExplicitStructure<3>;
} // namespace Breakwater
