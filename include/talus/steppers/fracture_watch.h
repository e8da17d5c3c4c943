#pragma once

#include <talus/core/table.h>
#include <talus/steppers/model.h>

namespace Talus
{
  /**
   * Watches for numerical fracture: neighbours of a solid body that are drawn farther apart than the kernel can bridge
   * no longer feel each other, wherever they lie between the nodes, and the body comes apart whatever its strength. The
   * distance of neighbours is the largest principal stretch of F times the initial spacing, the reach of a kernel of
   * support R (n nodes) 2 R - 1 spacings of the grid, 1 for the linear, 2 for the quadratic, 3 for the cubic one. In
   * shear others come between: the space ahead of the particle must be emptier than that around it as well, by the mass
   * of the nodes. Water and dry sand have no neighbours to keep, and domains that follow their particles (CPDI) leave
   * no gap. Test: tests/inputs.
   */
  template <int dim>
  class FractureWatch
  {
  public:
    static constexpr const char *remedy =
      "Take a larger spacing of the grid, more particles per cell along the stretch, or the kernel CPDI, whose domains "
      "follow the particles; a body that is to break needs a material that does.";

    /** The state before the first step: spacings of neighbours. */
    void start(const Model<dim> &model);

    /** Sets `distance`. Collective. */
    void measure(const Model<dim> &model);

    /** A sentence on what has come apart, without its end, once in a run; else nothing. Collective. */
    std::string look(const Model<dim> &model);

    /** Whether it has told. */
    void serialize(Archive &archive) { archive("fracture.has told", has_told); }

    /** The greatest distance of neighbours over the kernel's reach. */
    void add_to(Table &table) const { table.add("neighbour distance", "reach", distance); }

  private:
    /** Distance of the neighbours of a particle before it was stretched: the edge of its volume then [length]. */
    double spacing(const Model<dim> &model, const unsigned int p) const;

    /** The longest of the vectors to a particle's neighbours [length]. */
    dealii::Tensor<1, dim> neighbour(const Model<dim> &model, const unsigned int p) const;

    /** Distance over reach. */
    double ratio(const Model<dim> &model, const dealii::Tensor<1, dim> &neighbour) const;

    /** Calls visitor(p) for the particles whose ratio may exceed `least`, as it is then: few. */
    template <class Visitor>
    void for_each_beyond(const Model<dim> &model, const double &least, const Visitor &visitor) const;

    /** Whether there is less mass half way to the neighbours, on both sides, than at the particle. */
    bool has_gaps(const Model<dim> &model, const unsigned int p, const dealii::Tensor<1, dim> &neighbour) const;

    bool                is_watching = false, has_told = false;
    std::vector<double> spacings;     // of each body's particles at the start, the largest [length]
    std::vector<bool>   is_solid;     // bodies
    double              reach    = 0; // [spacing of the grid]
    double              distance = 0;
  };
} // namespace Talus
