#pragma once

#include <talus/grid/nodal_array.h>

#include <array>

namespace Talus
{
  /**
   * What the nodes carry during a step, eight numbers a node side by side (one
   * cache line): the mass and two vectors. A step fills and reads them in order:
   *
   * | lanes             | after particle_to_grid | after update_velocity  |
   * |-------------------|------------------------|------------------------|
   * | 0                 | m_i [mass]             | m_i                    |
   * | 1 .. dim          | momentum m_i v_i^n     | velocity v_i^{n+1}     |
   * | dim+1 .. 2 dim    | force f_i              | v_i^{n+1} - v_i^n      |
   */
  template <int dim>
  class NodalFields : public NodalArray<8>
  {
  public:
    static constexpr unsigned int mass      = 0;
    static constexpr unsigned int momentum  = 1;
    static constexpr unsigned int velocity  = 1;
    static constexpr unsigned int force     = 1 + dim;
    static constexpr unsigned int increment = 1 + dim;

    /**
     * Factors of a node's numbers where it stands for its mirror image in some faces of the box, bit 2 d or 2 d + 1
     * those of axis d: -1 for the components along their normals.
     */
    static const double *mirror(const unsigned int faces) { return mirror_factors[faces].data(); }

    /** Counts the force among a node's numbers that are about to be mirrored; its image gets the opposite of it. */
    void count_mirrored(const double *numbers, const unsigned int faces)
    {
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if (faces >> f & 1)
          mirrored_force[f] += 2 * numbers[force + f / 2];
    }

    /** What each face bears of the last transfer to the nodes, besides its nodes: of this rank's particles [force]. */
    std::array<double, 2 * dim> mirrored_force{};

  private:
    using MirrorFactors = std::array<std::array<double, stride>, 1u << (2 * dim)>;
    static MirrorFactors       make_mirror_factors();
    static const MirrorFactors mirror_factors;
  };
} // namespace Talus
