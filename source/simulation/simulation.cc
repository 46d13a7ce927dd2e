#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/simulation/simulation.h>
#include <breakwater/structure/structure.h>

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace Breakwater
{
  volatile std::sig_atomic_t stop_is_requested = 0;

  void SceneHeader::declare_parameters(ParameterReader &reader)
  {
    reader.add("Title", title, "One line about the scene, for the report.");
    reader.add("Dimension", dimension, "Space dimensions: 2 (plane flow, plane strain) or 3.", 2, 3);
    reader.add("End time", end_time, "Simulated time at which the run ends [s].", Range::positive());
    reader.add("Plugin libraries", plugin_libraries,
               "Libraries whose plugins this scene chooses, by bare name. Nothing else is loaded.");
  }

  template <int dim>
  Simulation<dim>::Simulation()
    : body_forces_("Models", "", "Accelerations that act on all masses: fluid and structures.")
    , fluid_("Model", "", "The fluid's solver; empty: no fluid.", 1)
    , coupler_("Model", "", "How bodies are tied; empty: none are.", 1)
    , postprocessors_("Models", "", "What adds columns to history.csv.")
    , start_(std::chrono::steady_clock::now())
  {
  }

  template <int dim>
  Simulation<dim>::~Simulation() = default;

  template <int dim>
  void Simulation<dim>::declare_parameters(ParameterReader &reader)
  {
    header_.declare_parameters(reader);
    const auto declare = [&reader](const std::string &section, auto &plugins) {
      SectionScope scope(reader, section);
      plugins.declare_parameters(reader);
    };
    declare("Body forces", body_forces_);
    declare("Fluid", fluid_);
    declare_structures(reader);
    {
      SectionScope scope(reader, "Coupling");
      coupler_.declare_parameters(reader);
      reader.add(
        "Ties", tie_texts_,
        "Which bodies are tied to each other at their wet boundaries: NAME and NAME, several of them separated "
        "by commas, e.g. Fluid and Gate, Gate and Frame. Empty: the fluid to every structure; without a fluid, "
        "two structures to each other. Structures that are tied must have nodes in common.");
    }
    declare("Postprocessors", postprocessors_);
    declare_output(reader);
  }

  template <int dim>
  void Simulation<dim>::declare_structures(ParameterReader &reader)
  {
    SectionScope             scope(reader, "Structures");
    std::vector<std::string> titles = reader.section_titles();
    if (reader.is_reference())
      titles = {"A name of your choice"};
    for (const std::string &title : titles)
      {
        const auto known = [&title](const Structure &structure) {
          return structure.name == title;
        };
        if (std::none_of(structures_.begin(), structures_.end(), known))
          {
            structures_.push_back({title, make_structure<dim>()});
            reader.note_new_plugin();
          }
      }
    for (const Structure &structure : structures_)
      {
        SectionScope inner_scope(reader, structure.name);
        structure.domain->declare_parameters(reader);
      }
  }

  template <int dim>
  void Simulation<dim>::declare_output(ParameterReader &reader)
  {
    SectionScope scope(reader, "Output");
    reader.add("Directory", directory_,
               "Where results go; empty: \"output-\" and the parameter file's name, in the current folder.");
    reader.add("Fields every", fields_every_,
               "Simulated time between two outputs of meshes and fields (solution.pvd) [s]; 0: at start and end only.",
               Range::not_negative());
    reader.add("History every", history_every_,
               "Simulated time between two rows of history.csv [s]; 0: a row at every step.", Range::not_negative());
    reader.add("Digits", n_digits_, "Significant digits in history.csv, remeshing.csv and other tables.", 4, 17);
    reader.add("Probes", probes_text_,
               "Points of a structure whose displacements go to history.csv: NAME: STRUCTURE(x, y, z), several of "
               "them separated by semicolons. The point [m] must lie at a node of the undeformed structure, within "
               "a tenth of the mesh size.");
    reader.add("Checkpoints every", checkpoints_every_,
               "Simulated time between two checkpoints [s]; 0: none by simulated time.", Range::not_negative());
    reader.add("Checkpoints every wall time", checkpoints_every_wall_,
               "Wall time between two checkpoints [s]; 0: none by wall time.", Range::not_negative());
  }

  template <int dim>
  void Simulation<dim>::check_parameters(ParameterReader &reader)
  {
    check_bodies(reader);
    const auto check = [&reader](const std::string &section, auto &plugins) {
      SectionScope scope(reader, section);
      plugins.check_parameters(reader);
    };
    check("Body forces", body_forces_);
    check("Fluid", fluid_);
    {
      SectionScope scope(reader, "Structures");
      for (const Structure &structure : structures_)
        {
          SectionScope inner_scope(reader, structure.name);
          structure.domain->check_parameters(reader);
        }
    }
    check("Coupling", coupler_);
    check("Postprocessors", postprocessors_);
    check_probes(reader);
  }

  template <int dim>
  std::vector<std::string> Simulation<dim>::structure_names() const
  {
    std::vector<std::string> names;
    for (const Structure &structure : structures_)
      names.push_back(structure.name);
    return names;
  }

  template <int dim>
  void Simulation<dim>::check_probes(ParameterReader &reader) const
  {
    SectionScope                   scope(reader, "Output");
    const std::vector<std::string> names = structure_names();
    try
      {
        for (const ProbePlace &place : parse_probes(probes_text_))
          if (std::find(names.begin(), names.end(), place.domain) == names.end())
            throw InputError("no structure is called \"" + place.domain + "\"" + suggestion(place.domain, names));
      }
    catch (const InputError &error)
      {
        reader.fail("Probes", error.what());
      }
  }

  template <int dim>
  void Simulation<dim>::check_bodies(ParameterReader &reader)
  {
    if (fluid_.empty() && structures_.empty())
      reader.fail("", "there is nothing to simulate; name a fluid (Fluid/Model) or a structure (Structures)");
    if (!fluid_.empty())
      for (const Structure &structure : structures_)
        if (structure.name == fluid_name)
          {
            SectionScope scope(reader, "Structures");
            reader.fail("", "a structure can't have the fluid's name");
          }
    check_coupling(reader);
  }

  template <int dim>
  void Simulation<dim>::check_coupling(ParameterReader &reader)
  {
    const bool   has_both = !fluid_.empty() && !structures_.empty();
    SectionScope scope(reader, "Coupling");
    if (coupler_.empty())
      {
        if (has_both)
          reader.fail("Model", "a fluid and a structure need a coupler" +
                                 suggestion("", reader.registry().names(Coupler<dim>::interface_name, dim)));
        if (!tie_texts_.empty())
          reader.fail("Ties", "bodies can't be tied without a coupler; name one in \"Model\"");
        return;
      }
    if (fluid_.size() + structures_.size() < 2)
      reader.fail("Model", std::string("there is no ") + (fluid_.empty() ? "second body" : "structure") +
                             " to couple; leave this entry out");
    ties_place_ = reader.where("Ties");
    try
      {
        ties();
      }
    catch (const InputError &error)
      {
        reader.fail("Ties", error.what());
      }
  }

  template <int dim>
  std::vector<TiedNames> Simulation<dim>::ties() const
  {
    return find_ties(tie_texts_, !fluid_.empty(), structure_names());
  }

  template <int dim>
  void Simulation<dim>::set_up()
  {
    set_up_bodies();
    std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> seen;
    for (const NamedDomain &domain : domains_)
      seen.emplace_back(domain.name, domain.domain);
    for (const auto &postprocessor : postprocessors_.plugins())
      postprocessor->setup(seen);
    for (const ProbePlace &place : parse_probes(probes_text_))
      probes_.emplace_back(place, structure(place.domain));
    note_effects();
  }

  template <int dim>
  void Simulation<dim>::set_up_bodies()
  {
    if (!fluid_.empty())
      domains_.push_back({fluid_name, &fluid_.front()});
    for (const Structure &structure : structures_)
      domains_.push_back({structure.name, structure.domain.get()});

    const BodyForces<dim> &body_forces = body_forces_.plugins();
    if (!fluid_.empty() && !structures_.empty())
      set_up_fluid_and_structures();
    else if (!coupler_.empty())
      set_up_tied_structures();
    else if (domains_.size() == 1)
      {
        sides_ = {domains_.front().domain};
        sides_.front()->setup(domains_.front().name, body_forces, *context_);
      }
    else
      sides_ = {&make_group(structure_names(), "")};
  }

  // All structures together are one side, the fluid is the other.
  template <int dim>
  void Simulation<dim>::set_up_fluid_and_structures()
  {
    const BodyForces<dim> &body_forces = body_forces_.plugins();
    ExplicitDomain<dim>   &fluid       = fluid_.front();
    ExplicitDomain<dim>   *second      = structures_.front().domain.get();
    if (structures_.size() == 1)
      second->setup(structures_.front().name, body_forces, *context_);
    else
      second = &make_group(structure_names(), fluid_name);
    sides_ = {&fluid, second};
    coupler_.front().adopt_surfaces(sides_,
                                    {{structures_.size() == 1 ? structures_.front().name : "Structures", 0, 1}});
    fluid.setup(fluid_name, body_forces, *context_);
    coupler_.front().setup(*context_);
  }

  // The structure that is named first in the first tie is one side, all others together are the other.
  template <int dim>
  void Simulation<dim>::set_up_tied_structures()
  {
    const std::string        first_name = ties().front().first, second_name = ties().front().second;
    std::vector<std::string> others = structure_names();
    others.erase(std::find(others.begin(), others.end(), first_name));
    DomainGroup<dim> &first = make_group({first_name}, second_name), &second = make_group(others, first_name);

    for (const TiedNames &tie : ties())
      if ((tie.first == first_name || tie.second == first_name) &&
          joint_nodes(structure(tie.first).wet_surface().position, structure(tie.second).wet_surface().position)
            .empty())
        fail_without_common_node(ties_place_, tie.first, tie.second);
    std::vector<unsigned int> of_first, of_second;
    for (const auto &[i, j] : joint_nodes(first.wet_surface().position, second.wet_surface().position))
      {
        of_first.push_back(i);
        of_second.push_back(j);
        share_stops<dim>({{&first, i}, {&second, j}});
      }
    first.keep_surface_nodes(of_first);
    second.keep_surface_nodes(of_second);
    sides_ = {&first, &second};
    coupler_.front().adopt_surfaces(sides_, {{first_name, 0, 1}});
    coupler_.front().setup(*context_);
  }

  /// Sets up these structures as a group whose surface is that of the members tied to `partner`, if that is one.
  template <int dim>
  DomainGroup<dim> &Simulation<dim>::make_group(const std::vector<std::string> &names, const std::string &partner)
  {
    const std::vector<TiedNames> all_ties = coupler_.empty() ? std::vector<TiedNames>() : ties();
    const auto                   are_tied = [&all_ties](const std::string &a, const std::string &b) {
      return std::any_of(all_ties.begin(), all_ties.end(), [&](const TiedNames &tie) {
        return tie == TiedNames(a, b) || tie == TiedNames(b, a);
      });
    };
    std::vector<typename DomainGroup<dim>::Member> members;
    std::vector<typename DomainGroup<dim>::Joint>  joints;
    for (unsigned int m = 0; m < names.size(); ++m)
      {
        members.push_back({names[m], &structure(names[m]), are_tied(names[m], partner)});
        for (unsigned int k = 0; k < m; ++k)
          if (are_tied(names[k], names[m]))
            joints.emplace_back(k, m);
      }
    groups_.push_back(std::make_unique<DomainGroup<dim>>(members, joints, ties_place_));
    groups_.back()->setup("", body_forces_.plugins(), *context_);
    return *groups_.back();
  }

  template <int dim>
  ExplicitDomain<dim> &Simulation<dim>::structure(const std::string &name) const
  {
    const auto is_it = [&name](const Structure &structure) {
      return structure.name == name;
    };
    return *std::find_if(structures_.begin(), structures_.end(), is_it)->domain;
  }

  template <int dim>
  void Simulation<dim>::note_effects()
  {
    const auto note = [this](const std::string &effect, const bool active) {
      context_->note_effect(effect, active, active ? "" : "the scene names none");
    };
    note("body forces", !body_forces_.empty());
    note("fluid", !fluid_.empty());
    note("structure", !structures_.empty());
    if (coupler_.empty()) // a coupler notes itself, with its kind
      note("coupling", false);
    note("postprocessors", !postprocessors_.empty());
  }

  template <int dim>
  void Simulation<dim>::validate()
  {
    namespace fs             = std::filesystem;
    const fs::path directory = fs::temp_directory_path() / ("breakwater-validate-" + std::to_string(getpid()));
    fs::create_directories(directory);
    struct Remover
    {
      const fs::path &directory;
      ~Remover() { fs::remove_all(directory); }
    } remover{directory};
    context_ = std::make_unique<RunContext>(directory);
    set_up();
    context_.reset();
  }

  template <int dim>
  bool Simulation<dim>::run(const Options &options, const std::string &parameters)
  {
    start_output(options, parameters);
    try
      {
        set_up_or_resume(options);
        advance_to_end();
      }
    catch (const BreakdownError &error)
      {
        progress_.reset();
        write_fields_at_breakdown();
        write_summary(options, "breakdown", error.what());
        throw;
      }
    const bool is_finished = time_ >= header_.end_time;
    write_summary(options, is_finished ? "finished" : "interrupted", "");
    return is_finished;
  }

  template <int dim>
  void Simulation<dim>::advance_to_end()
  {
    progress_ = std::make_unique<Progress>(time_, header_.end_time, context_->cell_steps);
    while (time_ < header_.end_time && !stop_is_requested)
      {
        advance();
        write_due_output(false);
        write_due_checkpoint();
        progress_->update(time_, time_step_, *context_);
      }
    // An interrupted run keeps to the output times: resumed, it must write what it would have written.
    const bool is_finished = time_ >= header_.end_time;
    if (is_finished)
      write_due_output(true);
    else
      write_checkpoint();
    progress_.reset();
  }

  template <int dim>
  void Simulation<dim>::advance()
  {
    // The time to the next output is split evenly: no tiny step is left over.
    const double        event   = next_event();
    const double        rest    = event - time_;
    const double        n_steps = std::max(1., std::ceil(rest / wanted_step() * (1 - 1e-9)));
    const double        longest = rest / n_steps;
    const unsigned long steps   = context_->steps;
    if (coupler_.empty())
      {
        ExplicitDomain<dim> &domain = *sides_.front();
        domain.advance_free(longest);
        domain.end_step();
        time_step_ = longest;
        if (context_->steps == steps)
          ++context_->steps;
      }
    else
      {
        time_step_ = coupler_.front().advance(longest);
        if (context_->steps == steps)
          context_->steps += coupler_.front().balance(0).n_substeps;
      }
    const double new_time = time_ + time_step_;
    time_                 = event - new_time <= 1e-9 * time_step_ ? event : new_time;
  }

  // A step that varies pumps energy into oscillations near the bound, like a child on a swing: steps of 0.9 of the bound
  // that vary by 2 % from one to the next make a structure's fastest oscillation grow by 0.1 % a step. So the step stays
  // as it is while the bound changes little.
  template <int dim>
  double Simulation<dim>::wanted_step()
  {
    const double bound = coupler_.empty() ? sides_.front()->stable_time_step() : coupler_.front().stable_time_step();
    if (!(bound > 0))
      throw BreakdownError("no time step is stable at t = " + std::to_string(time_) + " s: the bound is " +
                           std::to_string(bound) + " s");
    if (coupler_.empty())
      return bound;
    if (!(kept_step_ <= bound) || kept_step_ < 0.95 * bound)
      kept_step_ = 0.98 * bound;
    return kept_step_;
  }

  template <int dim>
  double Simulation<dim>::next_event() const
  {
    double event = header_.end_time;
    if (fields_every_ > 0)
      event = std::min(event, static_cast<double>(n_fields_) * fields_every_);
    if (history_every_ > 0)
      event = std::min(event, static_cast<double>(n_histories_) * history_every_);
    return event;
  }

  template <int dim>
  double Simulation<dim>::wall_seconds() const
  {
    return earlier_wall_seconds_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Breakwater
