#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>
#include <talus/core/parameters.h>
#include <talus/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <sstream>

/**
 * Runs a parameter file and writes the numbers it asks for in its comments to the file `output`, which deal.II's test
 * macro compares with NAME.output. A line
 *
 *     # prints statistics NAME / SCALE          the column's last value
 *     # prints mean|rms|largest COLUMN / SCALE  of the particles at the end
 *
 * prints a number over its scale. numdiff sees what differs by 1e-6: a scale that does not make it of order one is an
 * error.
 */
namespace
{
  using namespace Talus;

  /** The columns of a table by name, without units. */
  std::map<std::string, std::vector<double>> read_table(const std::string &path)
  {
    std::ifstream                              in(path);
    std::string                                line, cell;
    std::vector<std::string>                   names;
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(in, line))
    {
      if (line[0] == '#')
        continue;
      std::istringstream cells(line);
      const bool         is_header = names.empty();
      for (unsigned int c = 0; std::getline(cells, cell, ','); ++c)
        if (is_header)
          names.push_back(cell.substr(0, cell.find(" [")));
        else
          columns[names.at(c)].push_back(std::stod(cell));
    }
    return columns;
  }

  double reduce(const std::string &how, const std::vector<double> &values)
  {
    if (how == "statistics")
      return values.back();
    double sum = 0, squares = 0, largest = 0;
    for (const double value : values)
    {
      sum += value;
      squares += value * value;
      largest = std::max(largest, std::abs(value));
    }
    return how == "mean" ? sum / values.size() : how == "rms" ? std::sqrt(squares / values.size()) : largest;
  }

  void print_digits(const std::string &prm, const std::string &directory, std::ostream &out)
  {
    const auto  statistics = read_table(directory + "/statistics.csv");
    std::string last;
    for (const auto &entry : std::filesystem::directory_iterator(directory))
      if (entry.path().filename().string().rfind("particles_", 0) == 0 && entry.path().extension() == ".csv")
        last = std::max(last, entry.path().string());
    const auto particles = read_table(last);

    const std::regex request("# prints (statistics|mean|rms|largest) (.+) / (\\S+)");
    std::ifstream    in(prm);
    out.precision(12);
    for (std::string line; std::getline(in, line);)
    {
      std::smatch match;
      if (line.rfind("# prints", 0) != 0)
        continue;
      AssertThrow(std::regex_match(line, match, request), InputError("Cannot understand '" + line + "'."));
      const auto &table  = match[1] == "statistics" ? statistics : particles;
      const auto  column = table.find(match[2]);
      AssertThrow(column != table.end(), InputError("There is no column '" + match[2].str() + "'."));
      const double value = reduce(match[1], column->second) / std::stod(match[3]);
      AssertThrow(std::abs(value) > 0.05 && std::abs(value) < 100,
                  InputError(line + " is " + std::to_string(value) + ": choose a scale that makes it of order one."));
      out << match[1] << ' ' << match[2] << " / " << match[3] << " = " << value << '\n';
    }
  }

  template <int dim>
  void run(Parameters &parameters)
  {
    Simulation<dim> simulation(parameters, MPI_COMM_WORLD);
    parameters.parse();
    simulation.run();
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return exit_status([&]() {
    const CommandLine command_line(argc, argv);
    const std::string directory = "files";
    Parameters        parameters(command_line.file_name,
                                 {"Output/Directory = " + directory, "Output/Overwrite = true", "Output/CSV = true"});
    if (parameters.choose_from("", "Dimension", "2", "2|3", "") == "2")
      run<2>(parameters);
    else
      run<3>(parameters);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::ofstream out("output");
      print_digits(command_line.file_name, directory, out);
    }
  });
}
