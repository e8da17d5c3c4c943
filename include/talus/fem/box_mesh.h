#pragma once

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>
#include <deal.II/distributed/tria.h>

#include <vector>

namespace Talus
{
  /**
   * The uniform mesh of a box, as a section of the parameter file describes it. Faces have the boundary ids
   * 2 d (lower) and 2 d + 1 (upper) in direction d. Throws EntryError for an empty box. Test: tests/fem/errors.cc.
   */
  template <int dim>
  class BoxMesh : public dealii::ParameterAcceptor
  {
  public:
    explicit BoxMesh(const std::string &section);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Fills an empty triangulation. */
    void create(dealii::parallel::distributed::Triangulation<dim> &triangulation) const;

    dealii::Point<dim>        lower, upper; // corners [length]
    std::vector<unsigned int> n_cells;
  };
} // namespace Talus
