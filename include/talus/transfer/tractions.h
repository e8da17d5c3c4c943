#pragma once

#include <talus/core/function.h>
#include <talus/core/reduction.h>
#include <talus/core/table.h>
#include <talus/kernels/kernel.h>
#include <talus/particles/particles.h>

namespace Talus
{
  /**
   * A load on the surface of a body, the f-bar of Eq. (12): a traction, a pressure that follows the surface, or a
   * force at a point.
   *
   * The surface is a set of points, each with a share dA of the initial area and a normal N. Below a point hang n
   * layers of thickness l, and on the particle next to the middle of each layer, its host, an anchor. An anchor moves
   * with its host's deformation: with X_s - X_p from the host to the point at the start,
   * @f[ x_s = x_p + F_p (X_s - X_p), \quad da = J_p F_p^{-T} dA . @f]
   * The point's force f_s enters through its layers,
   * @f[ f_i \mathrel{+}= \sum_{k<n} f_s (\tfrac{1}{n} \phi_i + l \eta_k N \cdot \nabla\phi_i)(X_k) ,
   *     \quad \eta_k = 1 - (k + \tfrac{1}{2})/n , @f]
   * a mid-point rule for the integral of d(eta phi_i)/dN, which is phi_i at the surface, with eta falling from 1 to 0.
   * Fields at X_k, the middle of the layer, are a Taylor series about the host. Force and moment are exact wherever the
   * kernel reproduces linear fields, and no node is reached that has no mass.
   *
   * Why not the kernel at the surface: internal forces are sums over particles, which do not balance it. An even stress
   * is then wrong by up to 40 % in the rows of particles below the surface; n = 1 is hardly better, at 26 %.
   *
   * Every rank knows all anchors; what they do is computed where the host is, so that nothing but particles moves
   * between ranks. Test: tests/transfer/tractions.cc, tests/loads.
   */
  template <int dim>
  class Traction : public dealii::ParameterAcceptor
  {
  public:
    Traction(Parameters &parameters, const std::string &name, const std::vector<std::string> &body_names);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Finds points and hosts among the initial particles; EntryError for a surface that does not exist. Collective. */
    void attach(const Grid<dim> &grid, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                const Particles<dim> &particles);

    /** Adds the forces on this rank's hosts to the nodes, copies included. */
    void apply(const Particles<dim> &particles, const Kernel<dim> &kernel, const double time, Grid<dim> &grid);

    /** Sets the work once the particles have moved. */
    void finish(const Particles<dim> &particles);

    // Of the last step: on this rank's particles, then summed over all ranks.
    dealii::Tensor<1, dim> force;    // [force]
    double                 work = 0; // [energy]

  private:
    /** What a layer below a point of the surface knows. */
    struct Anchor
    {
      dealii::types::particle_index host;
      dealii::Tensor<1, dim>        offset; // X_s - X_p [length]
      dealii::Tensor<1, dim>        arm;    // what multiplies the host's gradient: l eta N + (X_k - X_p) / n [length]
      dealii::Tensor<1, dim>        area;   // dA; of a point force: unused
    };

    /** A host on this rank, and what its anchors did in the last step. */
    struct Host
    {
      unsigned int           p, begin, end; // particle, anchors
      dealii::Tensor<1, dim> force, x;      // sum f_s / n
      dealii::Tensor<2, dim> moment, F;     // sum f_s (x) arm
    };

    /** The points of the surface, or the one point of a point force, before they have hosts. */
    Surface<dim>           surface(const Grid<dim> &grid, const Body<dim> &body) const;
    void                   find_anchors(const Surface<dim> &surface, const Grid<dim> &grid, const unsigned int body,
                                        const Particles<dim> &particles);
    void                   find_local_hosts(const Particles<dim> &particles);
    dealii::Tensor<1, dim> point_force(const Anchor &anchor, const Host &host, const double time) const;

    std::string              kind, body_name, function_text;
    std::vector<std::string> faces = {"all"};
    std::vector<double>      lower, upper, position = std::vector<double>(dim, 0.);
    unsigned int             points_per_cell = 2;
    ParsedVector<dim>        function;

    unsigned int        n_layers = 1;
    std::vector<Anchor> anchors; // sorted by host
    std::vector<Host>   hosts;
    std::uint64_t       arrangement = 0; // of the particles for which the hosts were found
  };

  /** The loads of a run. */
  template <int dim>
  class Tractions
  {
  public:
    void apply(const Particles<dim> &particles, const Kernel<dim> &kernel, const double time, Grid<dim> &grid)
    {
      for (auto &load : loads)
        load->apply(particles, kernel, time, grid);
    }

    void finish(const Particles<dim> &particles)
    {
      for (auto &load : loads)
        load->finish(particles);
    }

    void add_to(Reduction &reduction)
    {
      for (auto &load : loads)
      {
        reduction.sum(load->force);
        reduction.sum(load->work);
      }
    }

    void add_to(Table &table) const
    {
      for (unsigned int l = 0; l < loads.size(); ++l)
        table.add("traction " + names[l], "force", loads[l]->force);
    }

    std::vector<std::string>                    names;
    std::vector<std::unique_ptr<Traction<dim>>> loads;
  };
} // namespace Talus
