#include "check.h"
#include "reference.h"

using namespace dealii;
using namespace Talus;

namespace
{
  const std::string good = Test::condition("floor", "2", "0; 0");

  /** The action must throw an InputError with `part` in its message, on every rank. */
  void check_message(const std::string &name, const std::string &part, const std::function<void()> &action)
  {
    bool holds = false;
    try
    {
      action();
    }
    catch (const InputError &error)
    {
      holds = error.message.find(part) != std::string::npos;
      if (!holds)
        std::cout << "  message: " << error.message << std::endl;
    }
    Test::check_true(name, holds);
  }

  void check_text(const std::string &name, const std::string &part, const std::string &text)
  {
    check_message(name, part, [&]() { Test::make_reference<2>(text); });
  }

  std::unique_ptr<ElasticReference<2>> solved(const std::string &sections = good)
  {
    auto reference = Test::make_reference<2>(Test::set("Cells", "2, 2") + Test::conditions("floor", sections));
    reference->set_moduli(2., 1.);
    reference->solve(0.);
    return reference;
  }

  void wrong_entries()
  {
    check_text("degree 3", "'Degree' in section 'FEM reference': '3' is not a valid value", Test::set("Degree", "3"));
    check_text("one number for the cells", "'Cells' in section 'FEM reference': '4' is not", Test::set("Cells", "4"));
    check_text("no cells", "'Cells' in section 'FEM reference': '4, 0' is not", Test::set("Cells", "4, 0"));
    check_text("empty box", "Every coordinate of the upper corner must be greater", Test::set("Upper corner", "1, 0"));
    check_text("no boundary", "holds nowhere", Test::conditions("floor", ""));
    check_text("half a box", "give both corners of the box with 2 numbers each",
               Test::conditions("floor", "  subsection floor\n" + Test::set("Lower corner", "0, 0") + "  end\n"));
    check_message("box without a node", "no node of the reference lies in this box", []() {
      solved("  subsection floor\n" + Test::set("Lower corner", ".1, .1") + Test::set("Upper corner", ".2, .2") +
             "  end\n");
    });
    check_text("face 4 in 2D", "'4' is not a valid value",
               Test::conditions("floor", Test::condition("floor", "4", "0; 0")));
    check_text("component z in 2D", "'z' is not a valid value",
               Test::conditions("floor", Test::condition("floor", "2", "0; 0", "z")));
    check_text("one formula", "expected 2 expressions separated by ';', found 1",
               Test::conditions("floor", Test::condition("floor", "2", "0")));
    check_text("formula that cannot be read", "cannot understand '0; 2*w'",
               Test::conditions("floor", Test::condition("floor", "2", "0; 2*w")));
    check_text("condition without a name in the list", "list 'roof' in 'Names'",
               Test::conditions("floor", good + Test::condition("roof", "3", "0; 0")));
  }

  /** Conditions that leave a motion free. */
  void free_motions()
  {
    check_message("no condition", "free to move", []() {
      auto reference = Test::make_reference<2>("");
      reference->set_moduli(2., 1.);
      reference->solve(0.);
    });
    check_message("free to slide", "free to move", []() { solved(Test::condition("floor", "2", "0; 0", "y")); });
    check_message("free to spin in 3D", "free to move", []() {
      auto reference = Test::make_reference<3>(
        Test::set("Cells", "2, 2, 2") + Test::conditions("x, y, z", Test::condition("x", "0", "0; 0; 0", "x") +
                                                                      Test::condition("y", "1", "0; 0; 0", "x") +
                                                                      Test::condition("z", "4", "0; 0; 0", "z")));
      reference->set_moduli(2., 1.);
      reference->solve(0.);
    });
  }

  void wrong_moduli_and_names()
  {
    check_message("nearly incompressible", "Choose a Poisson's ratio of at most 0.49",
                  []() { Test::make_reference<2>("")->set_moduli(60., 1.); });
    check_message("negative modulus", "positive moduli", []() { Test::make_reference<2>("")->set_moduli(-1., 1.); });
    check_message("unknown condition", "has no condition 'flor'. Did you mean 'floor'?",
                  []() { solved()->force("flor"); });
    check_message("unknown condition of the plastic reference", "has no condition 'flor'", []() {
      auto plastic = Test::make<PlasticReference<2>>(Test::set("Cells", "1, 1") + Test::conditions("floor", good));
      plastic->solve(1.);
      plastic->force("flor");
    });
  }

  /** Strains beyond all numbers: no step is short enough. */
  void no_equilibrium()
  {
    bool has_failed = false;
    try
    {
      auto plastic = Test::make<PlasticReference<2>>(
        Test::set("Cells", "1, 1") + Test::conditions("floor, top", good + Test::condition("top", "3", "0; 1e200*t")));
      plastic->solve(1.);
    }
    catch (const RunError &error)
    {
      has_failed = error.message.find("finds no equilibrium after t = 0, not even") != std::string::npos;
    }
    Test::check_true("no equilibrium", has_failed);
  }

  /** A method that does not converge ends after a bounded number of iterations, or halvings, with what it has tried. */
  void bounded_iterations()
  {
    for (const bool counts_halvings : {false, true})
    {
      std::string message;
      try
      {
        auto plastic = Test::make<PlasticReference<2>>(
          Test::set("Cells", "2, 2") + Test::set("Steps", "1") + "  subsection J2\n" + Test::set("Yield stress", "1") +
          "  end\n" + Test::conditions("floor, top", good + Test::condition("top", "3", "0.1*t; -0.2*t")));
        plastic->limits.iterations                                                        = 1;
        (counts_halvings ? plastic->limits.all_halvings : plastic->limits.all_iterations) = 3;
        plastic->solve(1.);
      }
      catch (const RunError &error)
      {
        message = error.message;
      }
      for (const std::string word :
           {"finds no equilibrium after t = 0 for a step of", "of the forces are out of balance after 1 iterations",
            "4 iterations and 4 halvings", "take more 'Steps'"})
        Test::check_true("bounded: " + word, message.find(word) != std::string::npos);
    }
  }

  void points_outside()
  {
    const auto outside = [](const Point<2> &point) {
      // Only one rank asks for it, all must throw.
      const bool is_root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      return is_root ? std::vector<Point<2>>{{.5, .5}, point} : std::vector<Point<2>>{};
    };
    check_message("stress outside", "The point (0.5 1.25) lies outside", [&]() {
      solved()->stress(outside({.5, 1.25}));
    });
    check_message("displacement outside",
                  "(-0.001 0.5) lies outside the box of the elastic reference, from (0 0) to (1 1)", [&]() {
                    solved()->displacement(outside({-.001, .5}));
                  });
    check_message("point that is not a number", "lies outside", [&]() {
      solved()->stress(outside({std::nan(""), .5}));
    });
    // On other ranks than the root the message must stay a whole; an empty list is no error.
    Test::check_true("no points", solved()->stress({}).empty());
  }
} // namespace

void errors()
{
  wrong_entries();
  free_motions();
  wrong_moduli_and_names();
  no_equilibrium();
  bounded_iterations();
  points_outside();
}
