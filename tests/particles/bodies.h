#pragma once

#include "../setup.h"

#include <set>

namespace Test
{
  using namespace dealii;

  /** A unit box of 8 cells per direction. */
  inline const std::string grid_entries = set("Spacing", "0.125");

  inline std::string on_grid(const std::string &body) { return section("Grid", grid_entries) + body_text(body); }

  template <int dim>
  std::string box(const double lower, const double upper)
  {
    return set("Lower corner", coordinates<dim>({{lower, lower, lower}})) +
           set("Upper corner", coordinates<dim>({{upper, upper, upper}}));
  }

  template <int dim>
  double total(const Setup<dim> &setup, const unsigned int field)
  {
    double result = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      result += setup.particles.component(field, 0)[p];
    return sum(result);
  }

  /** Every id in [0, n) once over all ranks. */
  template <int dim>
  bool has_ids(const Setup<dim> &setup, const unsigned int n)
  {
    const auto                      all = Utilities::MPI::gather(MPI_COMM_WORLD, setup.particles.id, 0);
    std::set<types::particle_index> ids;
    unsigned int                    n_ids = 0;
    for (const auto &of_rank : all)
    {
      ids.insert(of_rank.begin(), of_rank.end());
      n_ids += of_rank.size();
    }
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0 ||
           (n_ids == n && ids.size() == n && *ids.begin() == 0 && *ids.rbegin() == n - 1);
  }
} // namespace Test
