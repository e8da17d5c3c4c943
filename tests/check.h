#pragma once

#include <deal.II/base/mpi.h>

#include <functional>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

/**
 * The harness of the unit tests. A program is a list of named cases; a case
 * calls check() with an error and its bound. Printed is error over bound, which
 * must be at most 1. The exit status is the number of failed checks, at most 1.
 */
namespace Test
{
  inline int n_passed = 0;
  inline int n_failed = 0;

  /** Holds when |error| <= bound on every rank; NaN fails. */
  inline void check(const std::string &name, const double error, const double bound)
  {
    const bool   holds    = std::abs(error) <= bound;
    const bool   is_good  = dealii::Utilities::MPI::min(holds ? 1 : 0, MPI_COMM_WORLD) == 1;
    const double over     = std::abs(error) / bound;
    const double greatest = dealii::Utilities::MPI::max(over, MPI_COMM_WORLD);
    ++(is_good ? n_passed : n_failed);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << (is_good ? "  pass " : "  FAIL ") << name << ": error / bound = " << std::setprecision(3)
                << (holds ? greatest : over) << " (bound " << bound << ")" << std::endl;
  }

  inline void check_true(const std::string &name, const bool holds) { check(name, holds ? 0. : 2., 1.); }

  /** Holds when `value` lies in [low, high]. */
  inline void check_range(const std::string &name, const double value, const double low, const double high)
  {
    check(name + " = " + std::to_string(value), value - (low + high) / 2, (high - low) / 2);
  }

  using Case = std::pair<std::string, std::function<void()>>;

  /** Runs all cases, or those whose name contains the first argument. Cases "long ..." run only when it begins so. */
  inline int run(int argc, char **argv, const std::vector<Case> &cases)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    const bool                               is_root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    try
    {
      const std::string word    = argc < 2 ? "" : argv[1];
      const auto        is_long = [](const std::string &name) { return name.rfind("long", 0) == 0; };
      for (const auto &test : cases)
        if (test.first.find(word) != std::string::npos && (is_long(word) || !is_long(test.first)))
        {
          if (is_root)
            std::cout << test.first << std::endl;
          test.second();
        }
    }
    catch (const std::exception &error)
    {
      std::cout << "  FAIL exception: " << error.what() << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
    if (is_root)
      std::cout << n_passed << " passed, " << n_failed << " failed" << std::endl;
    return n_failed == 0 ? 0 : 1;
  }
} // namespace Test
