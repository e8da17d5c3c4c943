#pragma once

#include <talus/core/archive.h>
#include <talus/core/reduction.h>
#include <talus/core/table.h>
#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>
#include <talus/loads/barrier.h>
#include <talus/grid/contact_surface.h>
#include <talus/materials/material.h>
#include <talus/particles/particles.h>

namespace Talus
{
  /**
   * Frictional contact of all particles with a closed surface by a barrier: a particle at the distance d from it, on
   * whichever side, bears
   * @f[ f_n = -\kappa\, b'(d)\, A_p\, n , \quad A_p = V_p^{(d-1)/d} , \qquad
   *     f_t = -\mu |f_n|\, g(|v_t|/v_s)\, v_t / |v_t| , @f]
   * which its nodes get by the kernel's weights. Steps are so small that no particle comes nearer than half of its
   * distance, and that the barrier is resolved. A particle that runs through the surface all the same ends the run.
   * Formulas: doc/contact.md. Test: tests/loads.
   */
  template <int dim>
  class Contact : public dealii::ParameterAcceptor
  {
  public:
    Contact(Parameters &parameters, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Looks at the particles of the first state; `wave_speed` is the greatest among them [length/time]. Collective. */
    void attach(const Grid<dim> &grid, const double wave_speed, const Particles<dim> &particles);

    /** Adds forces to the nodes of a step of size `dt`, copies included. */
    void apply(const Particles<dim> &particles, const Kernel<dim> &kernel, const double dt, Grid<dim> &grid);

    /** Work of the forces when the particles have moved, and what is near now. */
    void finish(const Particles<dim> &particles);

    /** Throws RunError, on all ranks, if a particle has run through the surface. Collective if one has. */
    void check(const Communicator &communicator) const;

    void add_to(Reduction &reduction)
    {
      reduction.sum(force);
      reduction.sum(work);
      reduction.sum(friction_work);
      reduction.max(inverse_step);
      reduction.max(nearness);
      reduction.any(is_broken);
    }

    /** What the next step may be; what is near is found anew. */
    void serialize(Archive &archive) { archive("contact." + name + ".inverse step", inverse_step); }

    void add_to(Table &table) const;

    const std::string name;

    // Of the last step: of this rank's particles, then of all.
    dealii::Tensor<1, dim> force;             // on the particles [force]
    double                 work          = 0; // on them [energy]
    double                 friction_work = 0; // its share of friction [energy]
    double                 inverse_step  = 0; // of the largest step that is allowed next [1/time]
    double                 nearness      = 0; // 1 less the least distance over the barrier's reach, at least 0 [1]

    double reach() const { return barrier.reach; }

  private:
    /** Finds the particles that are near, and what they allow. */
    void look_around(const Particles<dim> &particles);

    /** Of the barrier and of friction. */
    std::array<dealii::Tensor<1, dim>, 2> forces_on(const Near<dim> &near, const Particles<dim> &particles,
                                                    const double dt) const;

    std::unique_ptr<ContactSurface<dim>> surface;

    double distance = 0, pressure = 0, friction = 0, sticking_speed = 0, step_fraction = 0.5;

    bool                                               is_broken = false; // a particle has run through
    std::string                                        failure;           // of this rank: which did so where
    Barrier                                            barrier{0};
    double                                             stiffness = 0, slip_speed = 0;
    std::vector<Near<dim>>                             near;
    std::vector<dealii::Tensor<1, dim>>                x;      // of those that are near
    std::vector<std::array<dealii::Tensor<1, dim>, 2>> forces; // there
    std::uint64_t                                      arrangement = 0;
  };

  /** The contacts of a run. */
  template <int dim>
  class Contacts
  {
  public:
    void build(Parameters &parameters);

    void attach(const Grid<dim> &grid, const std::vector<std::unique_ptr<Material>> &materials,
                Particles<dim> &particles);

    void apply(const Particles<dim> &particles, const Kernel<dim> &kernel, const double dt, Grid<dim> &grid)
    {
      for (auto &contact : all)
        contact->apply(particles, kernel, dt, grid);
    }

    void finish(const Particles<dim> &particles)
    {
      for (auto &contact : all)
        contact->finish(particles);
    }

    void check(const Communicator &communicator) const
    {
      for (const auto &contact : all)
        contact->check(communicator);
    }

    void add_to(Reduction &reduction)
    {
      for (auto &contact : all)
        contact->add_to(reduction);
    }

    void add_to(Table &table) const
    {
      for (const auto &contact : all)
        contact->add_to(table);
    }

    void serialize(Archive &archive)
    {
      for (auto &contact : all)
        contact->serialize(archive);
    }

    /** 1 over the largest step that all allow [1/time]. */
    double inverse_step() const
    {
      double result = 0;
      for (const auto &contact : all)
        result = std::max(result, contact->inverse_step);
      return result;
    }

    std::vector<std::unique_ptr<Contact<dim>>> all;
  };
} // namespace Talus
