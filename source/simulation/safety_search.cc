#include <talus/simulation/safety_search.h>

#include <talus/core/exceptions.h>
#include <talus/materials/material.h>
#include <talus/postprocess/files.h>
#include <talus/simulation/simulation.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    std::string text_of(const double factor)
    {
      std::ostringstream text;
      text << std::fixed << std::setprecision(4) << factor;
      return text.str();
    }

    /** Whether a law of this type has strengths. */
    bool has_strength(const std::string &type)
    {
      const auto entries = Parameters::declared_by([&] {
        Parameters none = Parameters::from_text("");
        Registry<Material>::get().make(type, none, "/Law");
      });
      return std::find(entries.begin(), entries.end(), "Law/Strength reduction") != entries.end();
    }
  } // namespace

  template <int dim>
  SafetySearch<dim>::SafetySearch(const Stages &stages, const unsigned int stage, const Resume &begin,
                                  const std::string &origin, MPI_Comm communicator) :
    stages(stages),
    stage(stage), begin(begin), origin(origin), communicator(communicator)
  {
  }

  template <int dim>
  Parameters SafetySearch<dim>::parameters(const double factor) const
  {
    const std::string section = "/Stages/" + stages.name(stage);
    Parameters        result  = stages.parameters(stage);
    bool              is_any  = false;
    for (const auto &name : Utilities::split_string_list(result.value("/Materials", "Names", "")))
      if (const std::string material = "/Materials/" + name;
          has_strength(result.value(material, "Type", "linear elastic")))
      {
        is_any                    = true;
        const double       before = std::stod(result.value(material, "Strength reduction", "1"));
        std::ostringstream value;
        value << std::setprecision(17) << before * factor;
        result.set(material, "Strength reduction", value.str(), "stage '" + stages.name(stage) + "'");
      }
    if (!is_any)
      throw InputError(
        result.locate(EntryError(section, "Strength reduction",
                                 "no material of the run has a strength. Take a plastic one, or remove the stage.")));
    result.set("/Output", "Directory", begin.directory + "/" + stages.name(stage) + "_" + text_of(factor), "");
    result.set("/Output", "Overwrite", "true", "");
    return result;
  }

  template <int dim>
  bool SafetySearch<dim>::stands_with(const double factor)
  {
    say("\nStage '" + stages.name(stage) + "': strengths over " + text_of(factor) + ".\n");
    Parameters trial  = parameters(factor);
    double     moved  = std::numeric_limits<double>::infinity();
    bool       stands = false;
    try
    {
      const auto simulation = Simulation<dim>::make(trial, communicator, stage);
      try
      {
        const auto end = simulation->try_out(begin, origin);
        is_stopped     = end == Simulation<dim>::Trial::stopped;
        stands         = end == Simulation<dim>::Trial::stands;
        moved          = simulation->moved();
      }
      catch (const RunError &)
      {
        // What is torn apart has failed.
        if (simulation->is_lone_failure())
          throw;
      }
    }
    catch (const EntryError &error)
    {
      throw InputError(trial.locate(error));
    }
    if (is_stopped)
      return false;
    rows.push_back({factor, moved, stands});
    std::ostringstream text;
    text << "Strengths over " << text_of(factor) << ": it " << (stands ? "stands" : "fails") << ", moved by " << moved
         << ".\n";
    say(text.str());
    write_table();
    return stands;
  }

  template <int dim>
  bool SafetySearch<dim>::run()
  {
    double low, high, tolerance;
    {
      // Also looks at the entries, which may have been set for a run that goes on.
      Parameters of_stage = stages.parameters(stage);
      try
      {
        const auto simulation = Simulation<dim>::make(of_stage, communicator, stage);
        low                   = simulation->stage().factors[0];
        high                  = simulation->stage().factors[1];
        tolerance             = simulation->stage().tolerance;
      }
      catch (const EntryError &error)
      {
        throw InputError(of_stage.locate(error));
      }
    }
    const bool stands = stands_with(low);
    AssertThrow(
      stands || is_stopped,
      RunError("Stage '" + stages.name(stage) + "' fails with strengths over " + text_of(low) +
               ", the least factor of 'Strength reduction'. Lower it, or let the stage before come to rest."));
    const bool stands_with_all = !is_stopped && stands_with(high);
    AssertThrow(!stands_with_all, RunError("Stage '" + stages.name(stage) + "' stands with strengths over " +
                                           text_of(high) + ", the greatest factor of 'Strength reduction'. Raise it."));
    while (!is_stopped && high - low > tolerance * low)
    {
      const double middle                = 0.5 * (low + high);
      (stands_with(middle) ? low : high) = middle;
    }
    if (is_stopped)
      return false;
    say("\nFactor of safety of stage '" + stages.name(stage) + "': " + text_of(low) +
        ". It stands with that and fails with " + text_of(high) + ".\n");
    if (stage + 1 == stages.size())
      note(date() + " ended: done\n");
    return true;
  }

  template <int dim>
  void SafetySearch<dim>::write_table() const
  {
    auto sorted = rows;
    std::sort(sorted.begin(), sorted.end(), [](const Row &a, const Row &b) { return a.factor < b.factor; });
    run_on_root(
      [&] {
        write_complete_file(begin.directory + "/safety_" + stages.name(stage) + ".csv", [&](std::ostream &out) {
          out << "factor [1],moved [length],stands [1]\n" << std::setprecision(17);
          for (const Row &row : sorted)
            out << row.factor << ',' << row.moved << ',' << row.stands << '\n';
        });
      },
      communicator);
  }

  template <int dim>
  void SafetySearch<dim>::say(const std::string &text) const
  {
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    std::cout << text << std::flush;
    note(text);
  }

  template <int dim>
  void SafetySearch<dim>::note(const std::string &text) const
  {
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      std::ofstream(begin.directory + "/log.txt", std::ios::app) << text;
  }

  template class SafetySearch<2>;
  template class SafetySearch<3>;
} // namespace Talus
