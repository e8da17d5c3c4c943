#include <talus/postprocess/files.h>
#include <talus/postprocess/particle_output.h>
#include <talus/postprocess/vtu.h>

#include "fixture.h"

#include <zlib.h>

using namespace dealii;
using namespace Test;
namespace fs = std::filesystem;

namespace
{
  std::string directory_entry(const std::string &path) { return "set Directory = " + path + "\n"; }

  void touch(const std::string &path)
  {
    if (is_root())
      std::ofstream(path) << "old\n";
    MPI_Barrier(MPI_COMM_WORLD);
  }

  void open(const std::string &entries)
  {
    Fixture<2> run(entries);
    run.output.open(MPI_COMM_WORLD);
  }
} // namespace

void test_directory()
{
  const std::string base = scratch();
  open(directory_entry(base + "/a/b//"));
  check_true("directories are created", fs::is_directory(base + "/a/b"));
  open(directory_entry(base + "/a/b"));
  check_true("an empty directory is taken", true);

  touch(base + "/file");
  check_throws<EntryError>("a directory below a file", "'" + base + "/file' is a file",
                           [&] { open(directory_entry(base + "/file/deeper/output")); });
  check_throws<EntryError>("a file in its place", "'" + base + "/file' is a file",
                           [&] { open(directory_entry(base + "/file")); });
  check_throws<EntryError>("a directory without a name", "no name", [&] { open("set Directory =\n"); });

  for (const char *name :
       {"particles_00000.vtu", "grid_00012.vtu", "particles.pvd", "statistics.csv", "probes.csv", "particles_00003.csv",
        "grid_00013.vtu.tmp", "log.txt", "points.csv", "notes.txt", "parameters.prm", "my_particles_00000.vtu"})
    touch(base + "/a/b/" + name);
  check_throws<EntryError>("an old output", "'" + base + "/a/b' is not empty. Set 'Overwrite' to true",
                           [&] { open(directory_entry(base + "/a/b")); });
  check_true("keeps its files", fs::exists(base + "/a/b/particles_00000.vtu"));
  open(directory_entry(base + "/a/b") + "set Overwrite = true\n");
  MPI_Barrier(MPI_COMM_WORLD);
  const unsigned int n_left = std::distance(fs::directory_iterator(base + "/a/b"), fs::directory_iterator());
  check_true("is cleared of what a run writes, and of nothing else",
             n_left == 4 && fs::exists(base + "/a/b/points.csv") && fs::exists(base + "/a/b/notes.txt") &&
               fs::exists(base + "/a/b/parameters.prm") && fs::exists(base + "/a/b/my_particles_00000.vtu"));
}

namespace
{
  /** The steps in which an output is due; time is 0.1 per step, summed up. */
  std::string due_steps(const std::string &entries)
  {
    const std::string base = scratch();
    Fixture<2>        run(directory_entry(base + "/out") + entries + "set Grid = false\n");
    run.create();
    run.output.open(MPI_COMM_WORLD);
    run.output.check(run.particles);
    std::string steps;
    double      time = 0;
    for (unsigned int step = 0; step <= 12; ++step, time += 0.1)
      if (run.output.is_due(time, step))
      {
        steps += std::to_string(step) + " ";
        run.output.write(time, step, run.particles, run.grid);
        check_true("not due twice", !run.output.is_due(time, step) && run.output.is_written(step));
      }
    return steps;
  }
} // namespace

void test_is_due()
{
  const auto compare = [](const std::string &name, const std::string &entries, const std::string &expected) {
    const std::string steps = due_steps(entries);
    check_true(name + ": " + steps, steps == expected);
  };
  compare("both off", "", "");
  compare("every 5 steps", "set Step interval = 5\n", "0 5 10 ");
  compare("every 0.3", "set Time interval = 0.3\n", "0 3 6 9 12 ");
  compare("every 0.25", "set Time interval = 0.25\n", "0 3 5 8 10 ");
  compare("shorter than a step", "set Time interval = 0.01\n", "0 1 2 3 4 5 6 7 8 9 10 11 12 ");
  compare("both", "set Step interval = 5\nset Time interval = 0.4\n", "0 4 5 8 10 12 ");

  Fixture<2> run("set Time interval = 0.25\nset Statistics interval = 3\n");
  check("the next output is the first", run.output.next_time(), 1e-15);
  const auto rows = [](const Fixture<2> &run) {
    std::string found;
    for (unsigned int n = 0; n <= 12; ++n)
      if (run.output.is_statistics_due(0.1 * n, n > 0 ? 0.1 : 0., n))
        found += std::to_string(n) + ' ';
    return found;
  };
  check_true("statistics every 3 steps", rows(run) == "0 3 6 9 12 ");
  const Fixture<2> by_time("set Statistics interval = 1000\nset Statistics time interval = 0.25\n");
  check_true("statistics every 0.25: " + rows(by_time), rows(by_time) == "0 3 5 8 10 ");
  check_true("steps end where they will", std::isinf(by_time.output.next_stop(0.1)));
  const Fixture<2> exact("set Time interval = 0.4\nset Statistics time interval = 0.25\nset Exact times = true\n");
  std::string      stops;
  for (double t = 0; t < 0.9;)
  {
    t = exact.output.next_stop(t);
    stops += std::to_string(static_cast<int>(std::round(100 * t))) + ' ';
  }
  check_true("steps end at " + stops, stops == "25 40 50 75 80 100 ");
}

namespace
{
  template <int dim>
  std::vector<double> state(const Talus::Particles<dim> &particles)
  {
    std::vector<double> all(particles.id.begin(), particles.id.end());
    for (unsigned int c = 0; c < particles.n_columns(); ++c)
      all.insert(all.end(), particles.column(c), particles.column(c) + particles.size());
    return all;
  }

  unsigned int count_points(const std::string &file_name)
  {
    const std::string key = "NumberOfPoints=\"";
    unsigned int      n   = 0;
    for (const auto &line : lines(file_name))
      if (const auto position = line.find(key); position != std::string::npos)
        n += std::stoi(line.substr(position + key.size()));
    return n;
  }

  bool contains(const std::string &file_name, const std::string &text)
  {
    for (const auto &line : lines(file_name))
      if (line.find(text) != std::string::npos)
        return true;
    return false;
  }

  template <int dim>
  void check_files()
  {
    const std::string d    = " in " + std::to_string(dim) + "D";
    const std::string base = scratch();
    Fixture<dim>      run(directory_entry(base + "/out") + "set CSV = true\nset Step interval = 1\n"
                                                                "set Particle fields = velocity, stress, pressure\n");
    run.create();
    run.output.open(MPI_COMM_WORLD);
    run.output.check(run.particles);
    const auto before = state(run.particles);
    run.output.write(0., 0, run.particles, run.grid);
    run.output.write(0.125, 7, run.particles, run.grid);
    check_true("the particles are untouched" + d, before == state(run.particles));

    const std::string file = run.output.directory() + "/particles_00001.vtu";
    check_true("a point for each particle" + d, count_points(file) == run.particles.n_global);
    const unsigned int n_cells = 16 * Utilities::fixed_power<dim - 1>(4);
    check_true("grid cells with their corners" + d,
               count_points(run.output.directory() + "/grid_00001.vtu") == n_cells * (1 << dim));
    for (const char *name : {"\"id\"", "\"body\"", "\"material\"", "\"velocity\" NumberOfComponents=\"3\"",
                             "\"stress\" NumberOfComponents=\"6\"", "\"pressure\""})
      check_true(std::string("particles have ") + name + d, contains(file, std::string("Name=") + name));
    check_true("and nothing else" + d, !contains(file, "displacement"));
    for (const char *name : {"\"mass\"", "\"velocity\" NumberOfComponents=\"3\""})
      check_true(std::string("nodes have ") + name + d,
                 contains(run.output.directory() + "/grid_00000.vtu", std::string("Name=") + name));
    for (const std::string name : {"particles", "grid"})
      check_true(name + ".pvd lists both" + d,
                 contains(base + "/out/" + name + ".pvd", "timestep=\"0\"") &&
                   contains(base + "/out/" + name + ".pvd", "timestep=\"0.125\"") &&
                   contains(base + "/out/" + name + ".pvd", "file=\"" + name + "_00001.vtu\""));
    check_true("a table for each" + d, lines(base + "/out/particles_00001.csv").size() == run.particles.n_global + 2);
    const unsigned int n_files = std::distance(fs::directory_iterator(base + "/out"), fs::directory_iterator());
    check_true("and no other file but the lock" + d, n_files == 8 + 1 && fs::exists(base + "/out/talus.lock"));
    MPI_Barrier(MPI_COMM_WORLD);

    if (is_root())
      fs::remove_all(base + "/out");
    MPI_Barrier(MPI_COMM_WORLD);
    check_throws<RunError>("a directory that has gone" + d, "Cannot write",
                           [&] { run.output.write(0.25, 14, run.particles, run.grid); });
  }

  /** The numbers of an array's text: a head with the sizes of the blocks, then the blocks, both in base64. */
  template <class Number>
  std::vector<Number> decoded(const std::string &text)
  {
    const auto word = [](const std::vector<unsigned char> &bytes, const unsigned int i) {
      std::uint32_t number;
      std::copy_n(&bytes.at(4 * i), 4, reinterpret_cast<unsigned char *>(&number));
      return number;
    };
    const unsigned int n_blocks = word(Utilities::decode_base64(text.substr(0, 16)), 0);
    const std::size_t  length   = (4 * (3 + n_blocks) + 2) / 3 * 4; // of the head
    const auto         head     = Utilities::decode_base64(text.substr(0, length)),
               bytes            = Utilities::decode_base64(text.substr(length));
    std::vector<Number> numbers(((n_blocks - 1) * std::size_t{word(head, 1)} + word(head, 2)) / sizeof(Number));
    bool                is_good = true;
    std::size_t         from = 0, to = 0;
    for (unsigned int b = 0; b < n_blocks; ++b)
    {
      const uLong size = word(head, b + 1 < n_blocks ? 1 : 2), n_compressed = word(head, 3 + b);
      uLongf      n = size;
      is_good       = is_good && from + n_compressed <= bytes.size() && to + size <= numbers.size() * sizeof(Number) &&
                uncompress(reinterpret_cast<Bytef *>(numbers.data()) + to, &n, &bytes[from], n_compressed) == Z_OK &&
                n == size;
      from += n_compressed;
      to += size;
    }
    check_true("compressed as it says", is_good && to == numbers.size() * sizeof(Number));
    return numbers;
  }

  /** The numbers of the array of a piece that `mark` stands in or before. */
  template <class Number>
  std::vector<Number> numbers_of(const std::string &piece, const std::string &mark)
  {
    const auto        begin = piece.find(">\n", piece.find("<DataArray", piece.rfind('<', piece.find(mark)))) + 2;
    const std::string text  = piece.substr(begin, piece.find('\n', begin) - begin);
    return decoded<Number>(text);
  }
} // namespace

/** Arrays of less than a block, of whole blocks (32768 numbers each), and of blocks and a rest. */
void test_vtu_arrays()
{
  for (const std::size_t n : {0u, 1u, 32768u, 98304u, 100001u})
  {
    VtuArray array;
    for (std::size_t i = 0; i < n; ++i)
      array.add(std::sin(1. * i));
    VtuText file;
    file.add(std::move(array));
    const std::string text = file.text(), name = std::to_string(n) + " numbers";
    check_true(name + ": length", text.size() == file.length());
    if (n == 0)
    {
      check_true(name, text.empty());
      continue;
    }
    const auto numbers = decoded<double>(text.substr(0, text.size() - 1));
    bool       is_same = numbers.size() == n && text.back() == '\n';
    for (std::size_t i = 0; i < n; ++i)
      is_same = is_same && numbers[i] == std::sin(1. * i);
    check_true(name, is_same);
  }
}

void test_vtu()
{
  check_files<2>();
  check_files<3>();

  Fixture<2> run;
  run.create();
  auto &particles = run.particles;
  for (unsigned int p = 0; p < particles.size(); ++p)
    particles.component(particles.velocity, 1)[p] = 2. + particles.id[p];
  VtuText text;
  add_piece(particles, select_particle_fields(particles, {"velocity", "deformation gradient"}, "", ""), text);
  const std::string piece  = text.text();
  const auto        places = numbers_of<double>(piece, "<Points>"), ids = numbers_of<double>(piece, "Name=\"id\"");
  const auto        velocities = numbers_of<float>(piece, "Name=\"velocity\""),
             F                 = numbers_of<float>(piece, "Name=\"deformation_gradient\"");
  double error                 = 0;
  for (unsigned int p = 0; p < particles.size(); ++p)
  {
    error += std::abs(places.at(3 * p) - particles.component(particles.position, 0)[p]) +
             std::abs(places.at(3 * p + 1) - particles.component(particles.position, 1)[p]) +
             std::abs(places.at(3 * p + 2)) + std::abs(ids.at(p) - particles.id[p]) +
             std::abs(velocities.at(3 * p + 1) - (2. + particles.id[p]));
    for (unsigned int c = 0; c < 9; ++c)
      error += std::abs(F.at(9 * p + c) - (c % 4 == 0 ? 1. : 0.));
  }
  check_true("each point has its particle's values", ids.size() == particles.size() && error == 0);
  check_throws<EntryError>("an unknown field", "Choices: position, velocity", [] {
    Fixture<2> run("set Particle fields = colour\n");
    run.output.check(run.particles);
  });
}
