#pragma once

#include <talus/particles/lattice_shape.h>
#include <talus/steppers/model.h>

#include "check.h"

#include <sstream>

/** What a step needs, built from the text of a parameter file; for the tests of several layers. */
namespace Test
{
  using namespace Talus;

  /** The first `dim` of the numbers as a list in a parameter file. */
  template <int dim>
  std::string coordinates(const std::array<double, 3> &numbers, const std::string &separator = ", ")
  {
    std::ostringstream text;
    text << std::setprecision(17);
    for (unsigned int d = 0; d < dim; ++d)
      text << (d > 0 ? separator : "") << numbers[d];
    return text.str();
  }

  inline std::string section(const std::string &name, const std::string &content)
  {
    return "subsection " + name + "\n" + content + "\nend\n";
  }

  inline std::string set(const std::string &entry, const std::string &value)
  {
    return "set " + entry + " = " + value + "\n";
  }

  /** A box of `cells` cells with its lower corner off the origin and a spacing of its own in each direction. */
  template <int dim>
  std::string skewed_grid(const std::array<int, 3> &cells)
  {
    const std::array<double, 3> lower = {{-0.3, 0.7, 0.2}}, h = {{0.1, 0.08, 0.125}};
    std::array<double, 3>       upper;
    for (unsigned int d = 0; d < 3; ++d)
      upper[d] = lower[d] + cells[d] * h[d];
    return section("Grid", set("Lower corner", coordinates<dim>(lower)) + set("Upper corner", coordinates<dim>(upper)) +
                             set("Cells", coordinates<dim>({{1. * cells[0], 1. * cells[1], 1. * cells[2]}})));
  }

  inline std::string kernel_text(const std::string &kernel, const std::string &treatment)
  {
    return section("Kernel", set("Type", kernel) + set("Boundary treatment", treatment));
  }

  inline std::string transfer_text(const std::string &transfer, const std::string &more = "")
  {
    return section("Transfer", set("Type", transfer) + more);
  }

  /** One body "body" of one material "rubber". */
  inline std::string body_text(const std::string &content)
  {
    const std::string material = set("Density", "3") + set("Young's modulus", "7") + set("Poisson's ratio", "0.2");
    return section("Materials", set("Names", "rubber") + section("rubber", material)) +
           section("Bodies", set("Names", "body") + section("body", content));
  }

  /** A condition "walls" on all faces. */
  template <int dim>
  std::string walls_text(const std::string &type)
  {
    if (type == "free")
      return "";
    return section(
      "Conditions",
      set("Names", "walls") +
        section("walls", set("Type", type) + set("Boundary ids", dim == 2 ? "0, 1, 2, 3" : "0, 1, 2, 3, 4, 5")));
  }

  /** The text of a parameter file; a base class, so that it is read before a model asks for it. */
  class Text
  {
  public:
    explicit Text(const std::string &text) : parameters(Parameters::from_text(text)) {}

    Parameters parameters;
  };

  /** The model of a run before its first step, and single passes of a step. */
  template <int dim>
  class Setup : public Text, public Model<dim>
  {
  public:
    explicit Setup(const std::string &text, const bool half_edges = false) :
      Text(text), Model<dim>(parameters, MPI_COMM_WORLD), grid(box_grid(Model<dim>::grid, "/Grid", "Type"))
    {
      if (half_edges)
        particles.add_half_edges();
      parameters.parse();
      this->create();
    }

    using Model<dim>::kernel;
    using Model<dim>::transfer;
    using Model<dim>::particles;
    using Model<dim>::boundary;
    using Model<dim>::acceleration;

    BoxGrid<dim> &grid;

    void accelerate(const std::string &text) { acceleration.initialize(text, "/", "Body force"); }

    /** The first half of a step: fields of the nodes before their velocity is known. */
    void scatter(const double time = 0)
    {
      grid.clear();
      this->walls.clear();
      transfer->particle_to_grid(particles, *kernel, acceleration, time, grid);
    }

    /** Transfers both ways; with dt = 0 particles stay where they are and forces do nothing. */
    void step(const double dt, const double time = 0)
    {
      boundary.mark_slip_walls(time + dt, particles.n_stencil_nodes, grid);
      scatter(time);
      this->move_nodes(time, dt);
      transfer->grid_to_particle(grid, *kernel, dt, particles);
    }

    /** Sets a field of all particles by function(p, component). */
    template <class Function>
    void fill(const unsigned int field, const Function &function)
    {
      for (unsigned int c = 0; c < particles.fields[field].n_components; ++c)
        for (unsigned int p = 0; p < particles.size(); ++p)
          particles.component(field, c)[p] = function(p, c);
    }

    /** Sets a field to numbers in [-1, 1) that depend on the particle's id alone. */
    void randomize(const unsigned int field, const unsigned int seed)
    {
      fill(field, [&](const unsigned int p, const unsigned int c) { return hashed_jitter(seed, particles.id[p], c); });
    }

    dealii::Point<dim> position(const unsigned int p) const
    {
      dealii::Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = particles.component(particles.position, d)[p];
      return x;
    }

    /** The node of an entry of a stencil. */
    unsigned int node(const Stencil<dim> &stencil, const unsigned int k) const
    {
      return grid.lattice.node[stencil.place[k]];
    }

    /** The stencil of one particle. */
    Stencil<dim> stencil(const unsigned int p) const
    {
      Stencil<dim> result;
      kernel->evaluate(particles, p, p + 1, &result);
      return result;
    }
  };

  inline double sum(const double value) { return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD); }
  inline double max(const double value) { return dealii::Utilities::MPI::max(value, MPI_COMM_WORLD); }

  /** Keeps the greatest magnitude; NaN stays. */
  inline void raise(double &greatest, const double value)
  {
    if (!(std::abs(value) <= greatest) && !std::isnan(greatest))
      greatest = std::abs(value);
  }

  /** Holds when `action` throws an Error (InputError, EntryError, RunError) whose message holds all `parts`. */
  template <class Error, class Action>
  void check_error(const std::string &name, const std::vector<std::string> &parts, const Action &action)
  {
    std::string message = "no error was thrown";
    bool        holds   = false;
    try
    {
      action();
    }
    catch (const Error &error)
    {
      message = error.message;
      if constexpr (std::is_same<Error, EntryError>::value)
        message = error.section + ": " + error.entry + ": " + message;
      holds = true;
      for (const auto &part : parts)
        holds = holds && message.find(part) != std::string::npos;
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    if (!holds)
      std::cout << "    got: " << message << std::endl;
    check_true(name, holds);
  }
} // namespace Test
