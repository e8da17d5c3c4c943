#pragma once

#include <talus/boundary/friction_accounts.h>
#include <talus/boundary/held_components.h>
#include <talus/core/function.h>
#include <talus/core/reduction.h>
#include <talus/core/table.h>
#include <talus/grid/contact_surface.h>
#include <talus/grid/walls.h>

#include <memory>

namespace Talus
{
  /** A motion of a rigid body: a turn about a centre, then a displacement. */
  template <int dim>
  struct Placement
  {
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> displacement;
    dealii::Tensor<2, dim> turn; // a rotation

    dealii::Point<dim> from(const dealii::Point<dim> &X) const { return centre + displacement + turn * (X - centre); }
    dealii::Point<dim> back(const dealii::Point<dim> &x) const
    {
      return centre + transpose(turn) * (x - centre - displacement);
    }
  };

  /**
   * A rigid body in the way of the material, at rest or moved. At nodes in it the velocity relative to it may not point
   * inwards, and along its surface Coulomb friction acts: with r = v - v_b and the normal n of its surface
   * @f[ \Delta v_n = \max(-r \cdot n, 0), \qquad \Delta v_t = -\min(\mu \, \Delta v_n, |r_t|) \, r_t / |r_t| . @f]
   * Components that conditions hold stay as they are. Theory: doc/ground.md. Test: tests/boundary/obstacles.cc,
   * tests/loads (blocks on inclines).
   */
  template <int dim>
  class Obstacle : public dealii::ParameterAcceptor
  {
  public:
    using Moment = dealii::Tensor<1, dim == 2 ? 1 : 3>; // in 2D about z

    Obstacle(Parameters &parameters, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Finds its nodes. Throws EntryError for an impossible surface, or where no node lies in it. Collective. */
    void attach(const Grid<dim> &grid);

    /**
     * Changes the velocities of this rank's nodes in a step of size `dt` that ends at `time`. `walls`: where they have
     * solved for them. `is_repeated`: once more in the same step, and nothing is counted.
     */
    void apply(const double time, const double dt, const HeldComponents<dim> &held, const Walls<dim> *walls,
               Grid<dim> &grid, const bool is_repeated);

    /** How far a point lies in the obstacle at `time`; not positive outside, at most the reach [length]. */
    double depth(const dealii::Point<dim> &x, const double time) const;

    /** What nodes have not used of their normal impulses. */
    void serialize(Archive &archive, const Grid<dim> &grid);

    void add_to(Reduction &reduction)
    {
      reduction.sum(reaction);
      reduction.sum(moment);
      reduction.sum(work);
    }

    void add_to(Table &table) const;

    bool is_moved() const { return !displacement.is_zero() || !rotation.is_zero(); }

    const std::string name;

    // Of the last step: at this rank's nodes, then summed over all ranks.
    dealii::Tensor<1, dim> reaction; // of the body on the obstacle [force]
    Moment                 moment;   // of it about the centre, where that is now [force length]
    double                 work = 0; // of the obstacle on the body [energy]

  private:
    struct Touched
    {
      unsigned int           node, number; // of its normals
      dealii::Tensor<1, dim> normal;       // out of the obstacle
    };

    Placement<dim> placement(const double time) const;

    /** Finds the nodes in it, and the normals of the sides that each stands for. */
    void look_around(const Placement<dim> &now, const std::vector<unsigned int> &nodes, const Grid<dim> &grid);

    /** What a node of mass m and velocity v has to be given of velocity. */
    dealii::Tensor<1, dim> change(const Touched &touched, const double m, const dealii::Tensor<1, dim> &v,
                                  const dealii::Tensor<1, dim> &v_body, const HeldComponents<dim> &held,
                                  const double dt, const bool is_repeated);

    /** Of normal impulse J in a step: what friction may use [momentum]. */
    double usable(const Touched &touched, const double J, const double dt,
                  typename FrictionAccounts<dim>::Account &account) const;

    void count(const dealii::Tensor<1, dim> &arm, const dealii::Tensor<1, dim> &impulse,
               const dealii::Tensor<1, dim> &v, const double dt);

    std::unique_ptr<ContactSurface<dim>> surface;
    std::string                          displacement_text, rotation_text = "0";
    std::vector<double>                  centre = std::vector<double>(dim, 0.), axis = {0., 0., 1.};
    ParsedVector<dim>                    displacement;
    ParsedScalar<dim>                    rotation;
    double                               friction = 0, account_time = 0, reach = 0;
    std::vector<Touched>                 touched;
    std::vector<unsigned int>            own_nodes; // all of this rank
    FrictionAccounts<dim>                accounts;
  };
} // namespace Talus
