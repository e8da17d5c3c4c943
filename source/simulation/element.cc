#include <talus/core/eigen.h>
#include <talus/core/libraries.h>
#include <talus/core/registry.h>
#include <talus/postprocess/files.h>
#include <talus/simulation/element.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  Element::Target::Target() : ParameterAcceptor("/Output")
  {
    add_parameter("Directory", path, "Directory into which the table is written.");
    add_parameter("Overwrite", overwrite, "Replace the files of an old run in that directory.");
    add_parameter("Statistics interval", interval, "Steps between two rows of element.csv [1].", prm,
                  Patterns::Integer(1));
  }

  void Element::Target::parse_parameters(ParameterHandler &)
  {
    while (path.size() > 1 && path.back() == '/')
      path.pop_back();
  }

  Element::Element(Parameters &parameters) : ParameterAcceptor("/Element"), parameters(parameters)
  {
    const std::string section = get_section_name();
    declare_libraries();
    const auto names = parameters.names("/Materials", "Names of the materials; each has a subsection of its name.");
    if (names.empty())
      throw EntryError("/Materials", "Names", "give at least one material.");
    std::string selection;
    for (const auto &name : names)
      selection += (selection.empty() ? "" : "|") + name;
    material_name = parameters.choose_from(section, "Material", names.front(), selection, "Name of the material.");
    for (const auto &name : names)
    {
      auto one = parameters.make<Material>("/Materials/" + name, "Type", "linear elastic", "Constitutive law.");
      if (name == material_name)
        material = std::move(one);
      else
        others.push_back(std::move(one));
    }
    material_type = parameters.value("/Materials/" + material_name, "Type", "linear elastic");
    add_parameter("Initial stress", initial_stress,
                  "Stress xx, yy, zz, xy, xz, yz before the first step, tension positive [stress].", prm,
                  Patterns::List(Patterns::Double(), 6, 6));
    add_parameter("Confining pressure", pressure,
                  "The same as an 'Initial stress' of -p, -p, -p, 0, 0, 0; compression positive [stress].", prm,
                  Patterns::Double());
    add_parameter("Spacing", spacing,
                  "Of the grid in which the law shall believe where it softens over a slip [length].", prm,
                  Patterns::Double());
    build_stages(parameters);
  }

  void Element::build_stages(Parameters &parameters)
  {
    const std::string section = get_section_name();
    const std::string help = "Names of the stages of the path, one after the other; each has a subsection of its name. "
                             "Without any, the entries of the only stage stand here.";
    const auto        names = parameters.names(section, help);
    for (const auto &name : names)
      stages.push_back(std::make_unique<ElementStage>(parameters, section + "/" + name, name));
    if (names.empty())
      stages.push_back(std::make_unique<ElementStage>(parameters, section, ""));
  }

  void Element::parse_parameters(ParameterHandler &)
  {
    if (!(spacing > 0))
      throw EntryError(get_section_name(), "Spacing", "it must be positive.");
    const bool has_stress = std::any_of(initial_stress.begin(), initial_stress.end(), [](double s) { return s != 0; });
    if (pressure != 0 && has_stress)
      throw EntryError(get_section_name(), "Confining pressure", "'Initial stress' says it too. Give one of them.");
    if (pressure != 0)
      initial_stress = {-pressure, -pressure, -pressure, 0, 0, 0};
    for (const double component : initial_stress)
      if (!std::isfinite(component))
        throw EntryError(get_section_name(), pressure != 0 ? "Confining pressure" : "Initial stress",
                         "give finite numbers.");
  }

  ElementPoint Element::start() const
  {
    material->set_spacing(spacing);
    std::array<double, 6> stress;
    std::copy(initial_stress.begin(), initial_stress.end(), stress.begin());
    const std::string entry = pressure != 0 ? "Confining pressure" : "Initial stress";
    // The remedies that follow the reason are those of bodies.
    const std::string refusal = material->refusal(stress), reason = refusal.substr(0, refusal.find(". "));
    if (!refusal.empty())
      throw EntryError(get_section_name(), entry,
                       reason + ". Leave it out, or give one that '" + material_type + "' can start with.");
    const ElementPoint point(*material, stress);
    ElementPoint       rested = point;
    rested.advance(Tensor<2, 3>(), 1.);
    double change = 0, size = 0;
    for (unsigned int c = 0; c < 6; ++c)
    {
      change = std::max(change, std::abs(rested.stress[c] - stress[c]));
      size   = std::max(size, std::abs(stress[c]));
    }
    if (!(change <= 1e-9 * size))
    {
      std::ostringstream text;
      text << "the material bears less than this stress: a step without strain changes it by " << change
           << ". Give one on its yield surface or within.";
      throw EntryError(get_section_name(), entry, text.str());
    }
    return point;
  }

  void Element::derive()
  {
    const SymmetricTensor<2, 3> sigma = tensor_of(point->stress);
    const EigenSystem<double>   stress(sigma), b(symmetrize(point->F * transpose(point->F)));
    double                      strain[3];
    for (unsigned int a = 0; a < 3; ++a)
    {
      AssertThrow(b.value[a] > 0 && std::isfinite(b.value[a]),
                  RunError("After step " + std::to_string(n_steps) +
                           " the point is stretched by more than numbers can tell, beyond 1e8 to 1. Lower 'Strain'."));
      strain[a]            = 0.5 * std::log(b.value[a]);
      derived.principal[a] = stress.value[a];
    }
    derived.strain = b.assemble(strain);
    std::sort(derived.principal.begin(), derived.principal.end(), std::greater<double>());
    derived.p            = 0. - trace(sigma) / 3; // never -0
    derived.q            = std::sqrt(1.5) * deviator(sigma).norm();
    derived.energy       = point->strain_energy_density();
    derived.plastic_work = point->plastic_work_density();
  }

  void Element::fill_table(Table &table) const
  {
    table.add("time", "time", time);
    table.add("step", "1", [this] { return n_steps; });
    table.add("stage", "1", [this] { return stage_number; });
    table.add("amount", "1", amount);
    const auto &names = component_names_of_stress;
    for (unsigned int c = 0; c < 6; ++c)
      table.add(std::string("strain ") + names[c], "1", [this, c] { return derived.strain.access_raw_entry(c); });
    table.add("gamma xy", "1", [this] { return point->F[0][1] + point->F[1][0]; });
    table.add("volume ratio", "1", [this] { return point->volume_ratio(); });
    for (unsigned int c = 0; c < 6; ++c)
      table.add(std::string("stress ") + names[c], "stress", [this, c] { return point->stress[c]; });
    table.add("p", "stress", derived.p);
    table.add("q", "stress", derived.q);
    for (unsigned int a = 0; a < 3; ++a)
      table.add("principal stress " + std::to_string(a + 1), "stress", derived.principal[a]);
    table.add("strain energy density", "energy/volume", derived.energy);
    table.add("plastic work density", "energy/volume", derived.plastic_work);
    const auto states = material->state_names();
    for (unsigned int s = 0; s < states.size(); ++s)
      table.add(states[s], "1", [this, s] { return point->state[s]; });
  }

  void Element::take(const ElementStage &stage, const unsigned int k, const std::array<double, 6> &stress_at_start)
  {
    if (stage.turns_at(k))
      control.restart();
    const ElementStep step    = stage.step(k, stress_at_start);
    const std::string problem = control.advance(*point, step);
    if (!problem.empty())
    {
      std::ostringstream text;
      text << "Step " << k << (stage.name.empty() ? "" : " of stage '" + stage.name + "'") << ", from "
           << stage.amount_name() << " = " << amount << " to " << stage.amount(k) << ": " << problem;
      throw RunError(text.str());
    }
    amount = stage.amount(k);
    time += step.dt;
    ++n_steps;
  }

  void Element::open(CsvFile &file, const Table &table)
  {
    prepare_directory(target.path, target.overwrite, target.lock, "/Output", "Directory", MPI_COMM_WORLD);
    run_on_root(
      [&] {
        write_complete_file(target.path + "/parameters.prm",
                            [&](std::ostream &out) { parameters.print(out, /* with_help = */ false); });
      },
      MPI_COMM_WORLD);
    file.open(target.path + "/element.csv", table.columns());
    for (const auto &doubt : material->doubts())
      parameters.warn(doubt);
    for (const auto &warning : parameters.warnings())
      say("warning: " + warning + '\n');
  }

  void Element::run()
  {
    point = std::make_unique<ElementPoint>(start());
    Table   table;
    CsvFile file;
    fill_table(table);
    open(file, table);
    derive();
    file.write_row(table.row());
    say("A point of '" + material_name + "' (" + material_type + ")\n" + state("start"));
    double      largest_q = derived.q;
    std::string there     = state("largest q");
    for (const auto &stage : stages)
    {
      say("  " + (stage->name.empty() ? "path" : stage->name) + ": " + stage->summary() + '\n');
      const auto stress = point->stress;
      amount            = 0;
      ++stage_number;
      for (unsigned int k = 1; k <= stage->n_steps(); ++k)
      {
        take(*stage, k, stress);
        derive();
        if (derived.q > largest_q * (1 + 1e-9)) // a plateau begins where it does
        {
          largest_q = derived.q;
          there     = state("largest q");
        }
        if (k % target.interval == 0 || k == stage->n_steps())
          file.write_row(table.row());
      }
    }
    say(there + state("end") + "  table      " + target.path + "/element.csv\n");
  }

  std::string Element::state(const std::string &name) const
  {
    std::ostringstream text;
    text << std::setprecision(6) << "  " << std::left << std::setw(10) << name << " step " << n_steps << ": q "
         << derived.q << ", p " << derived.p << ", strain zz " << derived.strain[2][2] << ", xy "
         << derived.strain[0][1] << ", volume ratio " << point->volume_ratio() << '\n';
    return text.str();
  }

  void Element::say(const std::string &text) const
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << text << std::flush;
  }
} // namespace Talus
