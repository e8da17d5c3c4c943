#pragma once

#include <talus/postprocess/output.h>
#include <talus/postprocess/probes.h>
#include <talus/steppers/model.h>

#include "check.h"

#include <filesystem>
#include <fstream>

namespace Test
{
  using namespace Talus;

  inline bool is_root() { return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0; }

  /** An empty place for files; programs with different numbers of ranks may run at the same time. */
  inline std::string scratch()
  {
    const std::string name =
      "postprocess_scratch_" + std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    if (is_root())
    {
      std::filesystem::remove_all(name);
      std::filesystem::create_directory(name);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    return name;
  }

  /** The lines of a file; all ranks read it. */
  inline std::vector<std::string> lines(const std::string &file_name)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    std::ifstream            file(file_name);
    std::vector<std::string> list;
    for (std::string line; std::getline(file, line);)
      list.push_back(line);
    return list;
  }

  inline std::vector<double> read_numbers(const std::string &row)
  {
    std::vector<double> values;
    for (const auto &text : dealii::Utilities::split_string_list(row, ','))
      values.push_back(std::stod(text));
    return values;
  }

  /** Holds when `action` throws an `Error` whose message contains `text`, on every rank. */
  template <class Error, class Action>
  void check_throws(const std::string &name, const std::string &text, const Action &action)
  {
    bool has_thrown = false;
    try
    {
      action();
    }
    catch (const Error &error)
    {
      has_thrown = error.message.find(text) != std::string::npos;
      if (!has_thrown)
        std::cout << "  message: " << error.message << std::endl;
    }
    check_true(name, has_thrown);
  }

  /**
   * A grid on [0, 8] x [0, 2]^(dim-1) with h = 1/2 and a body on [0, 4] x [0, 1]^(dim-1) with 2^dim
   * particles per cell, which two ranks share, and the objects that write them.
   */
  template <int dim>
  class Fixture
  {
  public:
    explicit Fixture(const std::string &output_entries = "") :
      parameters(Parameters::from_text(text(output_entries))), model(parameters, MPI_COMM_WORLD), grid(model.grid),
      particles(model.particles), probes(parameters)
    {
      parameters.parse();
    }

    void create() { model.create(); }

    static std::string text(const std::string &output_entries)
    {
      std::string number_lists[3];
      for (unsigned int d = 0; d < dim; ++d)
      {
        const std::string comma = d == 0 ? "" : ", ";
        number_lists[0] += comma + "0";
        number_lists[1] += comma + (d == 0 ? "8" : "2");
        number_lists[2] += comma + (d == 0 ? "4" : "1");
      }
      return "subsection Grid\n set Lower corner = " + number_lists[0] + "\n set Upper corner = " + number_lists[1] +
             "\n set Spacing = 0.5\nend\nsubsection Kernel\n set Type = linear\nend\n" +
             "subsection Materials\n set Names = m\nend\nsubsection Bodies\n set Names = b\n subsection b\n  set Lower corner = " +
             number_lists[0] + "\n  set Upper corner = " + number_lists[2] + "\n end\nend\nsubsection Output\n" +
             output_entries + "\nend\n";
    }

    Parameters      parameters;
    Model<dim>      model;
    Grid<dim>      &grid;
    Particles<dim> &particles;
    Output<dim>     output;
    Probes<dim>     probes;
  };
} // namespace Test
