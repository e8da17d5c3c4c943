#pragma once

#include <talus/particles/particles.h>

namespace Talus
{
  /**
   * Finds material that is there twice: bodies of which one has points in the region of another, or particles that
   * reach into it by more than a tenth of their size, lists of points that fill the same space, and points at the same
   * place, of one body or of two. `Bodies/Allow overlap` allows it. Bodies that touch do not overlap. Test:
   * tests/particles/overlaps.cc.
   */
  template <int dim>
  class Overlaps : public dealii::ParameterAcceptor
  {
  public:
    explicit Overlaps(const std::string &section = "/Bodies");

    /** Throws EntryError, on all ranks. `particles` are those that have just been created. Collective. */
    void check(const Particles<dim> &particles, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
               const Grid<dim> &grid) const;

  private:
    [[noreturn]] static void refuse(const Body<dim> &body, const std::string &message);
    static void check_lists(const Particles<dim> &particles, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                            const Grid<dim> &grid);

    bool are_allowed = false;
  };
} // namespace Talus
