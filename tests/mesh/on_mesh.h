#pragma once

#include "meshes.h"

#include <talus/grid/simplex_grid.h>

using namespace Talus;

namespace Test
{
  /** A run on a mesh before its first step. */
  template <int dim>
  struct OnMesh : Text, Model<dim>
  {
    explicit OnMesh(const std::string &text) : Text(text), Model<dim>(this->parameters, MPI_COMM_WORLD)
    {
      this->parameters.parse();
      this->create();
    }

    const SimplexGrid<dim> &simplices() const { return simplex_grid(this->grid, "/Grid", "Type"); }

    dealii::Point<dim> position(const unsigned int p) const
    {
      return dealii::Point<dim>(this->particles.vector(this->particles.position, p));
    }

    /** Whether every particle lies in the cell that is its place. */
    bool places_hold() const
    {
      bool        holds = true;
      const auto &mesh  = simplices().mesh();
      for (unsigned int p = 0; p < this->particles.size(); ++p)
      {
        const auto B = mesh.barycentric(this->particles.place[p], position(p).begin_raw());
        holds        = holds && *std::min_element(B.begin(), B.end()) >= -1e-9;
      }
      return holds;
    }
  };

  template <int dim>
  inline std::string box_of_simplices()
  {
    return section("Grid", set("Type", "mesh") + set("Cells", coordinates<dim>({{4, 3, 2}})) +
                             set("Upper corner", coordinates<dim>({{2, 1.5, 1}})));
  }

  template <int dim>
  inline std::string gmsh_grid()
  {
    return section("Grid", set("Type", "mesh") + set("File", data(dim == 2 ? "plate.msh" : "block.msh")) +
                             set("Spacing", "0.1"));
  }

  template <int dim>
  inline std::string box_body(const double from, const double to, const std::string &more = "")
  {
    return body_text(set("Lower corner", coordinates<dim>({{from, from, from}})) +
                     set("Upper corner", coordinates<dim>({{to, to, to}})) + more);
  }
} // namespace Test
